#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// Moving least squares, Zhang & Batra 2008, section 5: the polynomial that minimises
///   sum_J W_J (p(xi_J) . a - f_J)^2 (5.3), at the point itself: Phi = P A^-1 B (5.7).
/// Its value is that of SSPH; derivatives are those of the shape functions (5.8). Equal to RKPM only if all
/// volumes (and smoothing lengths) are equal, or with `options.volumes`.
///
/// `gradient` and `differentiated_gradient` are the same here.
/// @param order m = 1 ... 4
/// @throws std::invalid_argument for another order
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_mls(int order, const kernels::Kernel &kernel,
                                              const BasisOptions &options = {});

} // namespace meshless::basis
