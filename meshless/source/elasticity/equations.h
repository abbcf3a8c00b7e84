#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/elasticity/plane_problem.h"

#include <array>

namespace meshless::elasticity {

/// Coefficients of u1 and u2 of candidate j in the equations of the strong form at point p of a batch.

/// sigma_ij,j, component i: Batra & Zhang 2008, (3.8).
inline std::array<double, 2> equilibrium(const Material &d, const basis::ShapeFunctionValues<2> &values, std::size_t j,
                                         std::size_t p, int component) {
  const double xx = values.hessian(0, j)[p];
  const double xy = values.hessian(1, j)[p];
  const double yy = values.hessian(2, j)[p];
  const double mixed = (d.coupling() + d.shear()) * xy;
  if (component == 0)
    return {d.axial() * xx + d.shear() * yy, mixed};
  return {mixed, d.shear() * xx + d.axial() * yy};
}

/// sigma_ij n_j, component i: (3.14) with n2 in place of nu0 n2 in the last entry of its row 2.
inline std::array<double, 2> traction(const Material &d, const basis::ShapeFunctionValues<2> &values, std::size_t j,
                                      std::size_t p, int component, const Vector2 &normal) {
  const double x = values.gradient(0, j)[p];
  const double y = values.gradient(1, j)[p];
  const auto [n1, n2] = normal;
  if (component == 0)
    return {d.axial() * x * n1 + d.shear() * y * n2, d.coupling() * y * n1 + d.shear() * x * n2};
  return {d.shear() * y * n1 + d.coupling() * x * n2, d.shear() * x * n1 + d.axial() * y * n2};
}

} // namespace meshless::elasticity
