#pragma once

#include "meshless/kernels/normalisation.h"
#include "meshless/linear_algebra/pack.h"

namespace meshless::kernels {

/// Super Gauss function, Zhang & Batra 2008, Eq. (6.9):
///   W(s) = G / (h sqrt(pi))^dim (5/2 - s^2) e^(-s^2).
/// The paper gives it no cut-off; here it ends at a free one, where it jumps. It is negative for
/// s^2 > 5/2, so that moment matrices can be indefinite. Value, slope and curvature as in kernels/gauss.h.
class SuperGauss {
public:
  /// @param cut_off rho > 0, in units of h
  explicit SuperGauss(double cut_off)
      : cut_off_(cut_off),
        normalisations_(normalisations([this](double s_squared) { return value(s_squared); }, cut_off)) {}

  double support() const { return cut_off_; }
  double normalisation(int dim) const { return normalisations_[static_cast<std::size_t>(dim - 1)]; }

  template <typename T>
  T value(const T &s_squared) const {
    return (2.5 - s_squared) * linear_algebra::exponential(-s_squared);
  }

  template <typename T>
  T slope(const T &s_squared) const {
    return (2 * s_squared - 7) * linear_algebra::exponential(-s_squared);
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    return (-7 + (20 - 4 * s_squared) * s_squared) * linear_algebra::exponential(-s_squared);
  }

private:
  double cut_off_;
  Normalisations normalisations_;
};

} // namespace meshless::kernels
