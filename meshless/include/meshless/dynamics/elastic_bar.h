#pragma once

#include "meshless/dynamics/named_field.h"
#include "meshless/effects/artificial_viscosity.h"
#include "meshless/effects/damping.h"
#include "meshless/effects/usage.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace meshless::dynamics {

/// Rows that give the first and second derivative at every particle of a line.
struct LineOperators {
  linear_algebra::SparseRows first;  ///< 1/m
  linear_algebra::SparseRows second; ///< 1/m^2
};

/// Where the derivatives of a bar are evaluated.
enum class KernelPositions {
  reference, ///< at the particles' places at t = 0, once
  current    ///< where the particles are, anew every step
};

struct BarOptions {
  std::vector<double> positions; ///< m, increasing, ends included
  double youngs_modulus = 1;     ///< E, Pa
  double density = 1;            ///< kg/m^3
  /// The operators for particles at these places.
  std::function<LineOperators(std::span<const double>)> operators;
  KernelPositions kernel_positions = KernelPositions::reference;
  /// Stress at the left and right end as functions of time, Pa; empty: free.
  std::function<double(double)> left_stress, right_stress;
  std::optional<effects::LinearViscosity> viscosity;
  std::optional<effects::Damping> damping;
};

/// Waves in a linear elastic bar by collocation, Zhang & Batra 2008, section 6.4: rho u'' = E u,xx at the inner
/// particles by stored derivative rows, E u,x = given stress at the two ends (6.30), central differences in time from
/// rest:
///   v(n+1/2) = v(n-1/2) + dt (c^2 D2 u + b c D D2 v - r v),  u(n+1) = u(n) + dt v(n+1/2).
///
/// The rows lie in diagonals, so that a step runs along SIMD lanes. D2 is not symmetric: it can have eigenvalues that
/// grow at any time step, which shows as energy beyond the work of the ends.
class ElasticBar {
public:
  /// @throws std::invalid_argument for fewer than five particles, or constants out of range
  explicit ElasticBar(const BarOptions &options);
  ~ElasticBar();
  ElasticBar(ElasticBar &&) noexcept;

  std::int64_t n_particles() const;
  double time() const;
  std::int64_t steps() const;
  double wave_speed() const;
  /// Smallest distance of neighbours, m.
  double spacing() const;

  /// The largest stable step, s: with the largest eigenvalue w^2 of -c^2 D2 (ends free) by power iteration the root of
  ///   dt^2 w^2 + 2 dt (r + b D w^2 / c) = 4.
  double stable_step() const;

  /// The fastest growth that no time step prevents, 1/s: the largest |Im sqrt(-lambda)| of the eigenvalues of c^2 D2
  /// with free ends, on the first 100 particles or fewer (a dense eigenvalue problem). Without viscosity and damping.
  double growth_rate() const;

  /// One step.
  /// @throws Violation for a step above the stable one; every 200 steps for values that are not finite or an energy
  ///   above 1.5 times the work that the ends have put in
  void step(double time_step);

  /// As that of every 200 steps, now.
  void check() const;

  std::span<const double> displacement() const;
  std::span<const double> velocity() const; ///< half a step before
  /// E D1 u, Pa; the viscous part is not in it.
  std::vector<double> stress() const;
  /// Kinetic (half a step before) and strain energy, J/m^2.
  double energy() const;
  /// Of the stresses at the ends since t = 0, J/m^2.
  double work() const;

  State state();
  void adopt_state();
  std::vector<effects::Usage> usage() const;
  std::size_t bytes() const;
  /// Stored entries of the operators.
  std::int64_t nonzeros() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace meshless::dynamics
