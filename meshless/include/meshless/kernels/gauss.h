#pragma once

#include "meshless/kernels/normalisation.h"
#include "meshless/linear_algebra/pack.h"

namespace meshless::kernels {

/// Gauss function with a free cut-off, Batra & Zhang 2008, Eq. (3.15):
///   W(s) = G / (h sqrt(pi))^dim (e^(-s^2) - e^(-rho^2)) for s = |x - xi| / h <= rho, else 0.
/// Continuous at the edge; its slope jumps there by 2 rho e^(-rho^2).
///
/// All kernels give dimensionless values without the factor G / h^dim, as functions of s^2:
/// `value` is W, `slope` is W'(s) / s, which stays finite at s = 0 (0 for a kernel with a kink there),
/// `curvature` is W''(s). They hold inside the support only; the caller masks what lies outside.
/// T is double or a SIMD pack. `normalisation(dim)` / h^dim times W has the integral 1.
class Gauss {
public:
  /// @param cut_off rho > 0, in units of h
  explicit Gauss(double cut_off)
      : cut_off_(cut_off), edge_(std::exp(-cut_off * cut_off)),
        normalisations_(normalisations([this](double s_squared) { return value(s_squared); }, cut_off)) {}

  double support() const { return cut_off_; }
  double normalisation(int dim) const { return normalisations_[static_cast<std::size_t>(dim - 1)]; }

  template <typename T>
  T value(const T &s_squared) const {
    return linear_algebra::exponential(-s_squared) - edge_;
  }

  template <typename T>
  T slope(const T &s_squared) const {
    return -2 * linear_algebra::exponential(-s_squared);
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    return (4 * s_squared - 2) * linear_algebra::exponential(-s_squared);
  }

private:
  double cut_off_;
  double edge_;
  Normalisations normalisations_;
};

} // namespace meshless::kernels
