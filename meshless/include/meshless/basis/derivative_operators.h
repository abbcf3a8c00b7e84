#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <optional>
#include <vector>

namespace meshless::basis {

/// Value and derivatives at all particles as matrices that act on the values of all particles: row i belongs to
/// particle i. Absent is what was not wanted.
template <int dim>
struct DerivativeOperators {
  std::optional<linear_algebra::SparseRows> value;
  std::vector<linear_algebra::SparseRows> gradient; ///< k = 0 .. dim - 1, 1/m
  std::vector<linear_algebra::SparseRows> hessian;  ///< 11, 12, .., 22, .., 1/m^2
  double smallest_pivot_ratio = 1;
  std::size_t n_indefinite = 0; ///< particles whose moment matrix was not positive definite
};

/// The operators of a basis: its shape functions at the particles, and where the method is defined on
/// particles only (`ShapeFunctions::operator_rule`) what it makes of them: first derivatives of
/// f - f(x_i), second derivatives by applying the first twice, D_kl = (D_k D_l + D_l D_k) / 2.
/// @param wanted value, gradient, hessian; `differentiated_gradient` is not available
/// @throws SingularMomentMatrix where the basis does not exist
template <int dim>
DerivativeOperators<dim> make_derivative_operators(const ShapeFunctions<dim> &basis,
                                                   const cloud::Particles<dim> &particles, const Wanted &wanted);

} // namespace meshless::basis
