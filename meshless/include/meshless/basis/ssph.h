#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// Symmetric smoothed particle hydrodynamics basis, Batra & Zhang 2008, section 2:
/// with p(xi - x) the monomials of degree <= m scaled by h and W_J = W(|xi_J - x| / h_J),
///   C = sum_J p_J p_J^T W_J (2.8),  K_IJ = (C^-1 p_J W_J)_I (2.11),
/// row 1 of K gives the function, the following rows its first derivatives and, times the
/// factorials of the Taylor series, its second derivatives, without differentiating anything
/// (2.15). The smoothing length of particle J belongs to its kernel.
///
/// The derivative of the shape function itself (weak2, (3.25)): with g = C^-1 e_1,
///   phi_J,k = K_(k)J + g . p_J W_J,k - (C^-1 C_k g) . p_J W_J,  C_k = sum_J p_J p_J^T W_J,k,
/// where K_(k) is the row of the direct first derivative: it is what remains of the terms from
/// dp/dx, as e_1^T (C^-1 N_k + N_k^T C^-1) - e_1^T C^-1 N_k with p,k = -N_k p.
///
/// With `options.volumes` W_J is V_J G / h_J^dim W, as in Zhang & Batra 2008, (3.3): m / rho and the normalised
/// kernel. On irregular clouds that is another basis.
///
/// One point a SIMD lane; only the distinct moments are summed; the moment matrix is factorised
/// as L D L^T without pivoting (it is symmetric and, for a positive kernel, positive definite), for a kernel
/// with negative values where needed by LU with complete pivoting.
///
/// @param order m = 1 ... 4
/// @throws std::invalid_argument for another order
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_ssph(int order, const kernels::Kernel &kernel,
                                               const BasisOptions &options = {});

} // namespace meshless::basis
