#pragma once

#include "meshless/hydrodynamics/equation_of_state.h"

#include <vector>

namespace comparisons::benchmarks::detonation {

/// Density (kg/m^3), velocity (m/s), pressure (Pa).
struct State {
  double density = 0;
  double velocity = 0;
  double pressure = 0;
};

/// An explosive at rest without pressure, and its products.
struct Explosive {
  meshless::hydrodynamics::Jwl products;
  double density = 0; ///< rho0, kg/m^3
  double energy = 0;  ///< e0, J/kg
};

/// The state behind a detonation by the hypothesis of Chapman and Jouguet: with u = D (1 - rho0 / rho),
///   p = rho0 D u,  e = e0 + p / 2 (1 / rho0 - 1 / rho),  c(rho, e) = D - u;
/// it is the slowest speed for which the Rayleigh line meets the Hugoniot curve.
struct ChapmanJouguet {
  double speed = 0; ///< D, m/s
  State state;
  double energy = 0; ///< J/kg
};

/// @throws std::invalid_argument if there is no such state between rho0 and three times it
ChapmanJouguet chapman_jouguet(const Explosive &explosive);

enum class LeftEnd { wall, free };

/// The wave of Taylor behind a plane detonation that starts at x = 0, t = 0: on the isentrope of the Chapman-Jouguet
/// state x / t = u + c and du = c drho / rho; to u = 0 at a wall, from where on nothing changes, or to p = 0 at a free
/// end.
class TaylorWave {
public:
  TaylorWave(const Explosive &explosive, LeftEnd end);

  /// The state at x / t = `speed`, m/s.
  State at(double speed) const;

  const ChapmanJouguet &front() const { return front_; }
  /// Behind a wall's wave: pressure at u = 0, and x / t where it ends.
  double plateau_pressure() const { return table_.back().state.pressure; }
  double plateau_speed() const { return table_.back().speed; }

private:
  struct Entry {
    double speed;
    State state;
  };

  Explosive explosive_;
  LeftEnd end_;
  ChapmanJouguet front_;
  std::vector<Entry> table_; ///< from the front on; speeds fall
};

} // namespace comparisons::benchmarks::detonation
