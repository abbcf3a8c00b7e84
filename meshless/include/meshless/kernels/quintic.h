#pragma once

#include "meshless/kernels/elementary.h"

#include <numbers>

namespace meshless::kernels {

/// Quintic spline, Liu, Liu & Lam 2003, Eq. (42):
///   W(s) = G / h^dim ((3 - s)^5 - 6 (2 - s)^5 + 15 (1 - s)^5) for s <= 3,
/// every power only where its base is positive. The fourth derivative is continuous everywhere.
/// G = 1 / 120, 7 / (478 pi), 1 / (120 pi); the paper prints 3 / (359 pi) for the last, which makes the
/// integral 1.00279. Value, slope and curvature as in kernels/gauss.h.
class Quintic {
public:
  static constexpr double support() { return 3; }

  static constexpr double normalisation(int dim) {
    return dim == 1 ? 1. / 120 : (dim == 2 ? 7. / 478 : 1. / 120) / std::numbers::pi;
  }

  // Inside s < 1 the powers are multiplied out: the slope W' / s would cancel near the centre.
  template <typename T>
  T value(const T &s_squared) const {
    const T s = square_root(s_squared);
    const T outer = fifth(T(3 - s)) - 6 * fifth(positive_part(T(2 - s)));
    return select(s < T(1), T(66 + s_squared * (s_squared * (30 - 10 * s) - 60)), outer);
  }

  template <typename T>
  T slope(const T &s_squared) const {
    const T s = square_root(s_squared);
    const T outer = -5 * (fourth(T(3 - s)) - 6 * fourth(positive_part(T(2 - s))));
    return select(s < T(1), T(s_squared * (120 - 50 * s) - 120), over_distance(outer, s));
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    const T s = square_root(s_squared);
    const T outer = 20 * (cube(T(3 - s)) - 6 * cube(positive_part(T(2 - s))));
    return select(s < T(1), T(s_squared * (360 - 200 * s) - 120), outer);
  }

private:
  template <typename T>
  static T cube(const T &x) {
    return x * x * x;
  }
  template <typename T>
  static T fourth(const T &x) {
    return x * x * (x * x);
  }
  template <typename T>
  static T fifth(const T &x) {
    return x * x * (x * x) * x;
  }
};

} // namespace meshless::kernels
