#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fem_reference::rod {

/// A bar for waves: linear elements between the vertices, one-dimensional Hooke's law.
struct WaveBar {
  std::vector<double> vertices; ///< m, increasing
  double youngs_modulus = 1;    ///< Pa
  double density = 1;           ///< kg/m^3
  /// Mean of the stress at the right end between two times, Pa; empty: free. The left end is free.
  std::function<double(double from, double to)> right_stress;
  /// Artificial viscosity: the stress b c D rho v,x in an element of the length D.
  std::optional<double> viscosity;
  /// Force per mass and velocity, 1/s.
  std::optional<double> damping;
};

/// Explicit finite elements with lumped mass and central differences from rest:
///   v(n+1/2) = v(n-1/2) + dt M^-1 (f - K u(n) - C v(n-1/2)),  u(n+1) = u(n) + dt v(n+1/2),
/// f the mean of the load over the time that the kick stands for. At c dt = D the vertices' displacements are those of
/// the wave equation exactly.
///
/// Mesh, numbering, stiffness and the mass lumped by the Gauss-Lobatto rule are deal.II's (FE_Q, FEValues), taken once
/// into arrays from the left to the right, on which the steps work.
class ExplicitBar {
public:
  /// @throws InvalidInput for fewer than two vertices or constants out of range
  explicit ExplicitBar(WaveBar bar);

  double time() const { return time_; }
  std::int64_t steps() const { return steps_; }
  double wave_speed() const { return wave_speed_; }
  double spacing() const { return spacing_; }

  /// By the highest frequency of any element alone, 2 c / D, which bounds those of the bar (Irons & Treharne 1971):
  /// D / c without viscosity and damping, s.
  double stable_step() const;

  /// @throws std::runtime_error for a step above the stable one; every 50 steps for values that are not finite
  void step(double time_step);

  std::span<const double> displacement() const { return displacement_; }
  /// E u,x of each element, Pa.
  std::vector<double> stress() const;
  /// Places of `stress`, m.
  const std::vector<double> &middles() const { return middles_; }
  double energy() const;
  double work() const { return work_; }

  /// Everything that a step reads, by name; who writes into it calls `adopt_state`.
  std::vector<std::pair<std::string, std::span<double>>> state();
  void adopt_state();

private:
  WaveBar bar_;
  double wave_speed_;
  double spacing_;
  std::vector<double> stiffness_; ///< E / D of each element, Pa/m
  std::vector<double> middles_;
  std::vector<double> mass_, inverse_mass_, displacement_, velocity_, force_;
  double time_ = 0;
  std::int64_t steps_ = 0;
  double work_ = 0;
  std::array<double, 3> counters_{};
};

} // namespace fem_reference::rod
