#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// Modified smoothed particle hydrodynamics, Zhang & Batra 2008, section 2: the Taylor series up to order m projected
/// on the kernel and its derivatives up to order m, M = {W, W,k, W,kl}:
///   T = K Q, T_I = sum_J f_J M_I V_J, K_IL = sum_J M_I P_L V_J (2.10)-(2.12),
/// not symmetric; factorised with complete pivoting. Value and all derivatives are found directly.
///
/// @param order m = 1 or 2; orders 3 and 4 would need third derivatives of the kernel
/// @throws std::invalid_argument for another order; for order 2 and a kernel whose second derivative is zero
///   (linear): the last rows of K vanish
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_msph(int order, const kernels::Kernel &kernel,
                                               const BasisOptions &options = {});

} // namespace meshless::basis
