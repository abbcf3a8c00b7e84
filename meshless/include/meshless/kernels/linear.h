#pragma once

#include "meshless/kernels/elementary.h"

#include <numbers>

namespace meshless::kernels {

/// Linear kernel, Zhang & Batra 2008, Eq. (6.4): W(s) = G / h^dim (2 - s) / 4 for s <= 2, else 0.
/// It has a kink at its centre, where W' = 0 is agreed, and no second derivative elsewhere.
/// Value, slope and curvature as in kernels/gauss.h.
class Linear {
public:
  static constexpr double support() { return 2; }

  /// 1, 3 / (2 pi), 3 / (4 pi).
  static constexpr double normalisation(int dim) { return dim == 1 ? 1 : (dim == 2 ? 1.5 : .75) / std::numbers::pi; }

  template <typename T>
  T value(const T &s_squared) const {
    return .25 * (2 - square_root(s_squared));
  }

  template <typename T>
  T slope(const T &s_squared) const {
    return over_distance(T(-.25), square_root(s_squared));
  }

  template <typename T>
  T curvature(const T &) const {
    return T(0);
  }
};

} // namespace meshless::kernels
