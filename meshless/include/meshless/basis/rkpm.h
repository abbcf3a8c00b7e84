#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// Reproducing kernel particle method, Zhang & Batra 2008, section 4: the kernel is corrected by a polynomial,
///   phi_J = b . p(xi_J - x) W_J V_J,  M b = p(0) (4.10),  W_J = G / h_J^dim W(|xi_J - x| / h_J),
/// which is the SSPH shape function with volumes. Derivatives are those of the corrected kernel with respect to the
/// evaluation point, coefficients b(x) included (4.12), (4.13): exact for polynomials of degree <= m,
/// unlike those with frozen coefficients (basis/frozen_rkpm.h).
///
/// `gradient` and `differentiated_gradient` are the same here.
/// @param order m = 1 ... 4
/// @param options.volumes has no meaning: the volumes always count
/// @throws std::invalid_argument for another order
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_rkpm(int order, const kernels::Kernel &kernel,
                                               const BasisOptions &options = {});

} // namespace meshless::basis
