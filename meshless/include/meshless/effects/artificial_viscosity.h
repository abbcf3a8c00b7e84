#pragma once

#include "meshless/kernels/elementary.h"

namespace meshless::effects {

/// Artificial viscosity of gases, Monaghan & Gingold 1983, as in Liu, Liu & Lam 2003, section 4.1: a pair that
/// approaches has the viscous pressure
///   Pi_ij = (-alpha c mu + beta mu^2) / rho,  mu = h v_ij x_ij / (x_ij^2 + epsilon h^2),
/// with the means c, rho, h of the two; a pair that separates has none.
struct MonaghanViscosity {
  double linear = 1;       ///< alpha
  double quadratic = 1;    ///< beta
  double softening = 0.01; ///< epsilon, against the pole at x_ij = 0

  /// Pi_ij in Pa m^6 / kg^2. T is double or a SIMD pack.
  /// @param dx, dv differences x_i - x_j, v_i - v_j
  template <typename T>
  T pressure(const T &dx, const T &dv, const T &h, const T &sound_speed, const T &density) const {
    const T approach = dx * dv;
    const T mu = h * approach / (dx * dx + softening * h * h);
    return kernels::select(approach < T(0), T(mu * (quadratic * mu - linear * sound_speed) / density), T(0));
  }
};

/// Artificial viscosity of elastic bars: the stress b c D rho v_x with the wave speed c and the particle spacing D, for
/// both signs of the rate. One that acts in compression alone leaves the tensile front ringing.
struct LinearViscosity {
  double linear = 0.05; ///< b

  /// b c D in m^2 / s: what multiplies the strain rate's derivative in the acceleration.
  double diffusivity(double wave_speed, double spacing) const { return linear * wave_speed * spacing; }
};

} // namespace meshless::effects
