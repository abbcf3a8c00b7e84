#pragma once

#include <optional>

namespace comparisons::benchmarks::shock_tube {

/// A state of an ideal gas. Density 0 is a vacuum.
struct GasState {
  double density = 0;  ///< kg/m^3
  double velocity = 0; ///< m/s
  double pressure = 0; ///< Pa
};

/// Exact solution of the Riemann problem of an ideal gas: two states apart at x = 0, t = 0 (Toro, Riemann Solvers and
/// Numerical Methods for Fluid Dynamics, chapter 4). It depends on x / t alone: a shock or rarefaction, a contact
/// discontinuity, a shock or rarefaction. A vacuum may be on one side, or appear between two rarefactions.
class RiemannSolution {
public:
  /// @throws std::invalid_argument for gamma <= 1, a negative density or pressure, or values that are not finite
  RiemannSolution(const GasState &left, const GasState &right, double gamma);

  /// The state at x / t = `speed`, m/s.
  GasState at(double speed) const;

  /// Pressure and velocity between the waves; both absent if a vacuum is there.
  std::optional<double> star_pressure() const { return star_pressure_; }
  std::optional<double> star_velocity() const { return star_velocity_; }

  /// Speeds of the left and right wave: of a shock twice the same, of a rarefaction head and tail. The head is the
  /// outer one.
  struct Wave {
    bool shock = false;
    double head = 0;
    double tail = 0;
    double density = 0; ///< between this wave and the contact, kg/m^3; 0 if that is a vacuum
  };
  const Wave &left_wave() const { return left_wave_; }
  const Wave &right_wave() const { return right_wave_; }
  double gamma() const { return gamma_; }

private:
  double sound_speed(const GasState &state) const;
  /// Change of velocity over the wave that joins `state` with the pressure p, and its derivative.
  double jump(double p, const GasState &state, double &slope) const;
  double find_star_pressure() const;
  /// The wave on one side; sign -1 left, 1 right.
  Wave wave(const GasState &state, double sign) const;
  GasState inside_fan(const GasState &state, double sign, double speed) const;
  GasState side(const GasState &state, const Wave &wave, double sign, double speed) const;

  GasState left_, right_;
  double gamma_;
  std::optional<double> star_pressure_, star_velocity_;
  Wave left_wave_, right_wave_;
};

} // namespace comparisons::benchmarks::shock_tube
