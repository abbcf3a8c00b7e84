#pragma once

#include "meshless/kernels/elementary.h"

#include <numbers>

namespace meshless::kernels {

/// Cubic B-spline, Zhang & Batra 2008, Eq. (6.6):
///   W(s) = G / h^dim (1 - 3/2 s^2 + 3/4 s^3) for s < 1, G / h^dim (2 - s)^3 / 4 for 1 <= s <= 2, else 0.
/// Liu, Liu & Lam 2003, Eq. (41), is 2/3 of it; its printed (2 - S)^2 is a misprint for (2 - S)^3.
/// W'' is continuous everywhere. Value, slope and curvature as in kernels/gauss.h.
class CubicSpline {
public:
  static constexpr double support() { return 2; }

  /// 2 / 3, 10 / (7 pi), 1 / pi.
  static constexpr double normalisation(int dim) {
    return dim == 1 ? 2. / 3 : (dim == 2 ? 10. / 7 : 1) / std::numbers::pi;
  }

  template <typename T>
  T value(const T &s_squared) const {
    const T s = square_root(s_squared);
    const T outer = 2 - s;
    return select(s < T(1), T(1 + s_squared * (.75 * s - 1.5)), T(.25 * outer * outer * outer));
  }

  template <typename T>
  T slope(const T &s_squared) const {
    const T s = square_root(s_squared);
    const T outer = 2 - s;
    return select(s < T(1), T(2.25 * s - 3), over_distance(T(-.75 * outer * outer), s));
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    const T s = square_root(s_squared);
    return select(s < T(1), T(4.5 * s - 3), T(1.5 * (2 - s)));
  }
};

} // namespace meshless::kernels
