#pragma once

#include "meshless/kernels/elementary.h"

#include <numbers>

namespace meshless::kernels {

/// Dome-shaped quadratic, Liu, Liu & Lam 2003, section 3.3.1: W(s) = G / h^dim (1 - s^2) for s <= 1, else 0.
/// Its slope jumps at the edge. Value, slope and curvature as in kernels/gauss.h.
class Dome {
public:
  static constexpr double support() { return 1; }

  /// 3 / 4, 2 / pi, 15 / (8 pi); the paper gives the first only.
  static constexpr double normalisation(int dim) { return dim == 1 ? .75 : (dim == 2 ? 2 : 1.875) / std::numbers::pi; }

  template <typename T>
  T value(const T &s_squared) const {
    return 1 - s_squared;
  }

  template <typename T>
  T slope(const T &) const {
    return T(-2);
  }

  template <typename T>
  T curvature(const T &) const {
    return T(-2);
  }
};

} // namespace meshless::kernels
