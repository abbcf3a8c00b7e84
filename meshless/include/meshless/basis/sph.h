#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// Original smoothed particle hydrodynamics (Asprone, Auricchio & Reali 2010, section 3.1):
///   f(x) = sum_J f_J W_J V_J (4), its derivatives those of W_J by x (8), W_J = G / h_J^dim W(|xi_J - x| / h_J).
/// It reproduces nothing near a boundary or on irregular particles, not even constants.
///
/// Its operators at particles follow the paper: first derivatives of f - f(x_i) (11), second ones by
/// applying them twice (12), symmetrised in two and three dimensions.
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_sph(const kernels::Kernel &kernel, const BasisOptions &options = {});

} // namespace meshless::basis
