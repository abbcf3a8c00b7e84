#pragma once

#include "meshless/linear_algebra/pack.h"

namespace meshless::kernels {

/// Gauss function with a free cut-off, Batra & Zhang 2008, Eq. (3.15):
///   W(s) = G / (h sqrt(pi))^dim (e^(-s^2) - e^(-rho^2)) for s = |x - xi| / h <= rho, else 0.
/// Continuous at the edge; its slope jumps there by 2 rho e^(-rho^2).
///
/// All kernels give dimensionless values without the factor G / h^dim, as functions of s^2 (no
/// square root): `value` is W, `slope` is W'(s) / s, which stays finite at s = 0. Both hold inside
/// the support only; the caller masks what lies outside. T is double or a SIMD pack.
class Gauss {
public:
  /// @param cut_off rho > 0, in units of h
  explicit Gauss(double cut_off) : cut_off_(cut_off), edge_(std::exp(-cut_off * cut_off)) {}

  double support() const { return cut_off_; }

  template <typename T>
  T value(const T &s_squared) const
  {
    return linear_algebra::exponential(-s_squared) - edge_;
  }

  template <typename T>
  T slope(const T &s_squared) const
  {
    return -2 * linear_algebra::exponential(-s_squared);
  }

private:
  double cut_off_;
  double edge_;
};

} // namespace meshless::kernels
