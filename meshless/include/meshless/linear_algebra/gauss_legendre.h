#pragma once

#include <vector>

namespace meshless::linear_algebra {

/// Gauss-Legendre rule on [0, 1].
struct GaussRule {
  std::vector<double> points;
  std::vector<double> weights;
};

/// n points, exact for polynomials of degree 2 n - 1; nodes by Newton's method on the Legendre
/// polynomial, to rounding.
/// @throws std::invalid_argument if n < 1
GaussRule gauss_legendre(int n);

/// The same, computed once for each n and thread.
const GaussRule &cached_gauss_legendre(int n);

} // namespace meshless::linear_algebra
