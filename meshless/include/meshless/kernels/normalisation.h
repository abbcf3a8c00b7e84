#pragma once

#include "meshless/linear_algebra/gauss_legendre.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace meshless::kernels {

/// Factors that make the integral of a kernel 1, for one, two and three dimensions, in units of 1 / h^dim.
using Normalisations = std::array<double, 3>;

/// Content of the unit sphere's surface: 2, 2 pi, 4 pi.
inline double sphere_surface(int dim) {
  constexpr double surface[] = {2, 2 * std::numbers::pi, 4 * std::numbers::pi};
  return surface[dim - 1];
}

/// Factors of a kernel that is smooth inside its support, by Gauss quadrature.
///
/// 40 points integrate e^(-s^2) times a polynomial over a panel of length 4 to rounding; the relative
/// error is below 1e-14 as long as the kernel does not change its sign.
/// @param value W as a function of s^2
/// @param length over which W varies: panels are no longer than four times that
template <typename Value>
Normalisations normalisations(const Value &value, double support, double length = 1) {
  const auto &gauss = linear_algebra::cached_gauss_legendre(40);
  const int n_panels = 1 + static_cast<int>(support / (4 * length));
  const double panel = support / n_panels;
  Normalisations integrals{};
  for (int i = 0; i < n_panels; ++i)
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
      const double s = panel * (i + gauss.points[q]);
      double term = gauss.weights[q] * panel * value(s * s);
      for (double &integral : integrals) {
        integral += term;
        term *= s;
      }
    }
  Normalisations result{};
  for (int dim = 1; dim <= 3; ++dim)
    result[static_cast<std::size_t>(dim - 1)] =
        1 / (sphere_surface(dim) * integrals[static_cast<std::size_t>(dim - 1)]);
  return result;
}

} // namespace meshless::kernels
