#pragma once

#include "meshless/kernels/elementary.h"

#include <numbers>

namespace meshless::kernels {

/// Quadratic kernel, Zhang & Batra 2008, Eq. (6.5): W(s) = G / h^dim (1 - s + s^2 / 4) for s <= 2, else 0.
/// It has a kink at its centre, where W' = 0 is agreed; W' is continuous at the edge.
/// Value, slope and curvature as in kernels/gauss.h.
class Quadratic {
public:
  static constexpr double support() { return 2; }

  /// 3 / 4, 3 / (2 pi), 15 / (16 pi).
  static constexpr double normalisation(int dim) {
    return dim == 1 ? .75 : (dim == 2 ? 1.5 : .9375) / std::numbers::pi;
  }

  template <typename T>
  T value(const T &s_squared) const {
    const T factor = 1 - .5 * square_root(s_squared);
    return factor * factor;
  }

  template <typename T>
  T slope(const T &s_squared) const {
    const T s = square_root(s_squared);
    return over_distance(T(.5 * s - 1), s);
  }

  template <typename T>
  T curvature(const T &) const {
    return T(.5);
  }
};

} // namespace meshless::kernels
