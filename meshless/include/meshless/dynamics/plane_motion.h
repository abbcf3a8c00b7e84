#pragma once

#include "meshless/dynamics/named_field.h"
#include "meshless/effects/damping.h"
#include "meshless/elasticity/equations_of_motion.h"
#include "meshless/linear_algebra/sparse_lu.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace meshless::dynamics {

/// How the equations of motion of a plane body are stepped.
enum class TimeIntegration {
  newmark,           ///< beta = 1/4, gamma = 1/2: stable at any step for real positive eigenvalues
  central_difference ///< explicit; the mass is lumped by its row sums, velocities live half a step earlier
};

struct PlaneMotionOptions {
  TimeIntegration integration = TimeIntegration::newmark;
  std::optional<effects::Damping> damping = {}; ///< absent: nothing is computed for it
};

/// A plane body that starts at rest and takes its loads at once at t = 0; they stay.
///
/// Newmark: (M (1 + c dt / 2) + dt^2 / 4 K) a' = f - K (u + dt v + dt^2 / 4 a) - c M (v + dt / 2 a).
/// Central difference: v' = v + dt (m^-1 (f - K u) - c v), u' = u + dt v'; the first kick is for half a step.
/// K and M are not symmetric: there is no energy that the steps keep.
class PlaneMotion {
public:
  /// @throws std::invalid_argument if rows of the mass are empty (collocated conditions), or for central differences
  ///   if a row sum has not the sign of an inertia; linear_algebra::SolveError
  PlaneMotion(std::shared_ptr<const elasticity::EquationsOfMotion> equations, const PlaneMotionOptions &options);

  double time() const { return time_; }
  std::int64_t steps() const { return steps_; }
  /// Limit of central differences, 2 over the root of the spectral radius of m^-1 K by power iteration, s; infinite for
  /// Newmark.
  double stable_step() const { return stable_step_; }

  /// @throws Violation for a step above the stable one, or every 50 steps for values that are not finite
  void step(double time_step);

  /// Coefficients of displacement (m) and velocity (m/s) at one time, which for central differences is the beginning
  /// of the last step: the velocity is the mean of both sides.
  std::span<const double> displacement() const;
  std::span<const double> velocity() const;

  const elasticity::EquationsOfMotion &equations() const { return *equations_; }

  /// Everything that a step reads, by name; who writes into it calls `adopt_state`.
  State state();
  void adopt_state();

private:
  void newmark(double dt);
  void central(double dt);
  double spectral_radius();

  std::shared_ptr<const elasticity::EquationsOfMotion> equations_;
  PlaneMotionOptions options_;
  std::vector<double> u_, v_, a_, previous_u_, mean_v_, right_, scratch_;
  std::vector<double> lumped_;
  double stable_step_;
  /// Newmark's matrix, its row divisors and factors, for one time step.
  std::unique_ptr<linear_algebra::SparseRows> matrix_;
  std::vector<double> divisors_;
  std::unique_ptr<linear_algebra::SparseLu> lu_;
  double factorised_for_ = 0;
  double time_ = 0;
  std::int64_t steps_ = 0;
  std::array<double, 2> counters_{};
};

} // namespace meshless::dynamics
