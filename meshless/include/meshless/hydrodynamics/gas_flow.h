#pragma once

#include "meshless/dynamics/named_field.h"
#include "meshless/effects/artificial_viscosity.h"
#include "meshless/effects/heat_conduction.h"
#include "meshless/effects/programmed_burn.h"
#include "meshless/effects/usage.h"
#include "meshless/hydrodynamics/equation_of_state.h"
#include "meshless/kernels/kernel_table.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace meshless::hydrodynamics {

/// How the density follows the particles.
enum class DensityRule {
  summation, ///< rho_i = sum_j m_j W_ij
  continuity ///< d rho_i / dt = rho_i sum_j (m_j / rho_j) (v_i - v_j) W'_ij
};

/// Where the rates come from that carry velocity and energy to the middle of a step.
enum class Predictor {
  last_step, ///< those of the step before: one evaluation a step
  midpoint   ///< evaluated at the start of the step: two evaluations a step
};

/// What stands at an end of the line of particles.
enum class End {
  free,  ///< nothing
  mirror ///< a wall that reflects: images of the particles stand behind it
};

/// A line of gas particles at t = 0, ordered by position; all spans have one value a particle.
struct GasParticles {
  std::vector<double> mass;     ///< kg/m^2
  std::vector<double> position; ///< m, increasing
  std::vector<double> velocity; ///< m/s
  std::vector<double> density;  ///< kg/m^3; only the start of an iteration with DensityRule::summation
  std::vector<double> energy;   ///< internal energy per mass, J/kg
};

struct GasOptions {
  kernels::Kernel kernel;
  EquationOfState equation_of_state;
  DensityRule density = DensityRule::summation;
  Predictor predictor = Predictor::last_step;
  /// Adaptive smoothing length h = smoothing m / rho; else h is fixed.
  bool adaptive = true;
  double smoothing = 1.5;
  /// h of all particles if it is fixed, m.
  double fixed_length = 0;
  std::array<End, 2> ends{End::free, End::free};
  /// Places of the walls, m; read where an end is a mirror.
  std::array<double, 2> walls{0, 0};
  // Effects beside the gas's pressure; what is absent has neither array nor code in the loops.
  std::optional<effects::MonaghanViscosity> viscosity = {};
  std::optional<effects::HeatConduction> conduction = {};
  std::optional<effects::ProgrammedBurn> burn = {};
};

/// Smoothed particle hydrodynamics of a gas on a line, Liu, Liu & Lam 2003, section 4:
///   dv_i/dt = -sum_j m_j (p_i / rho_i^2 + p_j / rho_j^2 + Pi_ij) W'_ij,
/// W at the mean of the two smoothing lengths; with DensityRule::continuity (p_i + p_j) / (rho_i rho_j) + Pi_ij.
///
/// A step drifts half, kicks, and drifts half; the internal energy receives the work of each pair's force along the
/// mean of the velocities before and after the kick. So mass, momentum and total energy stay as they are to rounding,
/// whatever the time step; that they do says nothing about stability.
///
/// Particles stay ordered, so that the neighbours of a particle are a range of indices and pairs (i, i + k) of a fixed
/// k are contiguous: all loops over pairs run along SIMD lanes, each pair once.
class GasFlow {
public:
  /// @throws std::invalid_argument for arrays that do not fit, positions that do not increase, values out of range
  GasFlow(const GasParticles &particles, const GasOptions &options);
  ~GasFlow();
  GasFlow(GasFlow &&) noexcept;

  std::int64_t n_particles() const;
  double time() const;
  std::int64_t steps() const;

  /// The largest stable step by the signal speed (Monaghan 1992): min h / (c + 0.6 (alpha c + beta max |mu|)), s; mu by
  /// the next particles.
  double stable_step() const;

  /// One step.
  /// @throws dynamics::Violation for a step above the stable one, for values that are not finite, a density or energy
  ///   that is not positive, particles that cross
  void step(double time_step);

  /// Density (by DensityRule::summation of the present positions) and pressure; what a step reads stays as it is.
  struct Snapshot {
    std::vector<double> density;  ///< kg/m^3
    std::vector<double> pressure; ///< Pa
  };
  Snapshot snapshot();

  std::span<const double> mass() const;
  std::span<const double> position() const;
  std::span<const double> velocity() const;
  std::span<const double> energy() const;
  std::span<const double> density() const; ///< of the middle of the last step, or its end by DensityRule::continuity
  std::span<const double> smoothing_length() const;

  double total_momentum() const;
  /// sum |m v|
  double momentum_scale() const;
  /// Kinetic and internal, J/m^2.
  double total_energy() const;

  /// Everything that a step reads. Who writes into it calls `adopt_state` afterwards.
  dynamics::State state();
  void adopt_state();
  /// What each effect that is present costs.
  std::vector<effects::Usage> usage() const;
  /// Bytes of all arrays.
  std::size_t bytes() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace meshless::hydrodynamics
