#pragma once

#include "meshless/kernels/elementary.h"
#include "meshless/linear_algebra/pack.h"

#include <variant>

namespace meshless::hydrodynamics {

namespace internal {
inline double at_least(double x, double bound) { return x > bound ? x : bound; }
inline linear_algebra::Pack at_least(const linear_algebra::Pack &x, double bound) {
  return max(x, linear_algebra::Pack(bound));
}
} // namespace internal

/// Ideal gas: p = (gamma - 1) rho e, c^2 = gamma p / rho. T is double or a SIMD pack.
struct IdealGas {
  double gamma = 1.4;

  template <typename T>
  T pressure(const T &density, const T &energy) const {
    return (gamma - 1) * density * energy;
  }

  /// dp/drho + p / rho^2 dp/de, m^2 / s^2
  template <typename T>
  T sound_speed_squared(const T &, const T &energy) const {
    return gamma * (gamma - 1) * energy;
  }
};

/// Detonation products by Jones, Wilkins and Lee (Liu, Liu & Lam 2003, section 4.2): with eta = rho / rho0
///   p = A (1 - omega eta / R1) e^(-R1 / eta) + B (1 - omega eta / R2) e^(-R2 / eta) + omega rho e.
/// The defaults are those of TNT.
struct Jwl {
  double A = 3.712e11;           ///< Pa
  double B = 3.231e9;            ///< Pa
  double R1 = 4.15;              ///< -
  double R2 = 0.95;              ///< -
  double omega = 0.30;           ///< -
  double initial_density = 1630; ///< rho0, kg/m^3

  template <typename T>
  T pressure(const T &density, const T &energy) const {
    const T eta = density / initial_density;
    return A * (1 - omega / R1 * eta) * decay(R1, eta) + B * (1 - omega / R2 * eta) * decay(R2, eta) +
           omega * density * energy;
  }

  template <typename T>
  T sound_speed_squared(const T &density, const T &energy) const {
    const T eta = density / initial_density;
    const T slope = (A * decay(R1, eta) * ((1 - omega / R1 * eta) * R1 / (eta * eta) - omega / R1) +
                     B * decay(R2, eta) * ((1 - omega / R2 * eta) * R2 / (eta * eta) - omega / R2)) /
                        initial_density +
                    omega * energy;
    return slope + omega * pressure(density, energy) / density;
  }

private:
  /// e^(-R / eta), 0 where it would underflow.
  template <typename T>
  static T decay(double R, const T &eta) {
    return linear_algebra::exponential(internal::at_least(T(-R / eta), -690));
  }
};

using EquationOfState = std::variant<IdealGas, Jwl>;

} // namespace meshless::hydrodynamics
