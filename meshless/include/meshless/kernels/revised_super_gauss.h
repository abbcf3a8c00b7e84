#pragma once

#include "meshless/kernels/normalisation.h"
#include "meshless/linear_algebra/pack.h"

namespace meshless::kernels {

/// Revised super Gauss function, Zhang & Batra 2008, Eqs. (6.10) and (6.17):
///   W(s) = G / (h sqrt(pi))^dim (rho^2 - s^2) e^(-a s^2) for s <= rho, else 0.
/// The paper has rho = 2; it recommends a = 1.6. Its G = 2/7 (dim = 1, a = 1) is the value for the
/// infinite line; on [-2, 2] it is .28536. Value, slope and curvature as in kernels/gauss.h.
class RevisedSuperGauss {
public:
  /// @param cut_off rho > 0, in units of h
  /// @param decay the parameter a > 0
  RevisedSuperGauss(double cut_off, double decay)
      : cut_off_(cut_off), decay_(decay),
        normalisations_(
            normalisations([this](double s_squared) { return value(s_squared); }, cut_off, 1 / std::sqrt(decay))) {}

  double support() const { return cut_off_; }
  double normalisation(int dim) const { return normalisations_[static_cast<std::size_t>(dim - 1)]; }

  template <typename T>
  T value(const T &s_squared) const {
    return (cut_off_ * cut_off_ - s_squared) * linear_algebra::exponential(-decay_ * s_squared);
  }

  template <typename T>
  T slope(const T &s_squared) const {
    return -2 * (1 + decay_ * (cut_off_ * cut_off_ - s_squared)) * linear_algebra::exponential(-decay_ * s_squared);
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    const T bracket = 1 + decay_ * (cut_off_ * cut_off_ - s_squared);
    return (4 * decay_ * s_squared * (1 + bracket) - 2 * bracket) * linear_algebra::exponential(-decay_ * s_squared);
  }

private:
  double cut_off_;
  double decay_;
  Normalisations normalisations_;
};

} // namespace meshless::kernels
