#pragma once

#include <array>
#include <string>

namespace comparisons::hard_cases {

/// Two interacting blast waves, Woodward & Colella, J. Comput. Phys. 54 (1984), section IV a: gas at rest of density 1,
/// gamma = 1.4, between reflecting walls at x = 0 and 1; pressure 1000 at x < .1, 100 at x > .9, .01 between.
struct BlastWaves {
  static constexpr double gamma = 1.4;
  static constexpr double end = .038;
  static constexpr std::size_t n_intervals = 200;
  /// Mean density of every interval.
  using Density = std::array<double, n_intervals>;

  static double pressure(double x) { return x < .1 ? 1000 : x > .9 ? 100 : .01; }

  /// At the end, by 8000 Lagrangian cells of second order (tests/hard_cases/lagrangian_gas.h), which differ from 4000
  /// by 7e-4 in the mean. No exact solution is known. Contact discontinuities do not smear there, shocks over two
  /// cells.
  static const Density &reference();
};

struct BlastWavesOutcome {
  BlastWaves::Density density{};
  double mass_error = 0;   ///< relative
  double energy_error = 0; ///< relative
};

/// @param method "sph h=1.5" (h over m / rho, the default of scenes) or 1.2, "fem P0" or P1, on n points
/// @throws what the method throws when a density or energy is not positive
BlastWavesOutcome run_blast_waves(const std::string &method, int n);

} // namespace comparisons::hard_cases
