#pragma once

#include "meshless/kernels/elementary.h"

#include <numbers>

namespace meshless::kernels {

/// Quartic spline, Zhang & Batra 2008, Eq. (6.7): with u = s / 2,
///   W(s) = G / h^dim (1 - 3/2 s^2 + s^3 - 3/16 s^4) = G / h^dim (1 - u)^3 (1 + 3 u) for s <= 2, else 0.
/// W'' is continuous everywhere. Value, slope and curvature as in kernels/gauss.h.
class Quartic {
public:
  static constexpr double support() { return 2; }

  /// 5 / 8, 5 / (4 pi), 105 / (128 pi).
  static constexpr double normalisation(int dim) {
    return dim == 1 ? .625 : (dim == 2 ? 1.25 : 105. / 128) / std::numbers::pi;
  }

  template <typename T>
  T value(const T &s_squared) const {
    const T u = .5 * square_root(s_squared);
    return (1 - u) * (1 - u) * (1 - u) * (1 + 3 * u);
  }

  template <typename T>
  T slope(const T &s_squared) const {
    const T u = .5 * square_root(s_squared);
    return -3 * (1 - u) * (1 - u);
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    const T u = .5 * square_root(s_squared);
    return -3 * (1 - u) * (1 - 3 * u);
  }
};

} // namespace meshless::kernels
