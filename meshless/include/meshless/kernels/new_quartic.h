#pragma once

#include "meshless/kernels/elementary.h"

#include <numbers>

namespace meshless::kernels {

/// The new quartic of Liu, Liu & Lam 2003, Eq. (43):
///   W(s) = G / h^dim (2/3 - 9/8 s^2 + 19/24 s^3 - 5/32 s^4)
///        = G / h^dim (2 - s)^2 (1/6 + s/6 - 5 s^2 / 32) for s <= 2, else 0.
/// Against the paper's words it is negative for 1.6957 < s < 2 and rises from s = 1.8 on; W'' = -1/4 at
/// the edge. Value, slope and curvature as in kernels/gauss.h.
class NewQuartic {
public:
  static constexpr double support() { return 2; }

  /// 1, 15 / (7 pi), 315 / (208 pi).
  static constexpr double normalisation(int dim) {
    return dim == 1 ? 1 : (dim == 2 ? 15. / 7 : 315. / 208) / std::numbers::pi;
  }

  template <typename T>
  T value(const T &s_squared) const {
    const T s = square_root(s_squared);
    return (2 - s) * (2 - s) * ((1 + s) / 6 - .15625 * s_squared);
  }

  template <typename T>
  T slope(const T &s_squared) const {
    const T s = square_root(s_squared);
    return -(2 - s) * (1.125 - .625 * s);
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    const T s = square_root(s_squared);
    return s * (4.75 - 1.875 * s) - 2.25;
  }
};

} // namespace meshless::kernels
