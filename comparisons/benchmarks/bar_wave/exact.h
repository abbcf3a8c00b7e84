#pragma once

namespace comparisons::benchmarks::bar_wave {

/// The pulse and its reflections in a bar that is free at both ends but for the pulse: with g(t) = -stress for
/// 0 < t < duration,
///   sigma = sum_n [ g(t - (2 n L + L - x) / c) - g(t - (2 n L + L + x) / c) ],
///   rho c v = sum_n [ g(t - (2 n L + L - x) / c) + g(t - (2 n L + L + x) / c) ].
struct PulseSolution {
  double length = 0;     ///< L, m
  double wave_speed = 0; ///< c, m/s
  double impedance = 0;  ///< rho c, kg/(m^2 s)
  double stress = 0;     ///< Pa, the pressure at x = L
  double duration = 0;   ///< s

  double load(double t) const { return t > 0 && t < duration ? -stress : 0; }
  /// Mean of the load from one time to another.
  double mean_load(double from, double to) const;
  double stress_at(double x, double t) const;
  double velocity_at(double x, double t) const;
  /// Work of the pulse: stress^2 duration / (rho c) until the first wave returns, J/m^2.
  double work() const { return stress * stress * duration / impedance; }
};

} // namespace comparisons::benchmarks::bar_wave
