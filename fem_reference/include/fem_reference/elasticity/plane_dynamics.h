#pragma once

#include "fem_reference/elasticity/plane_elasticity.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fem_reference::elasticity {
/// How inertia is integrated.
enum class Mass {
  consistent, ///< M(a, b) = integral of rho N_a N_b, exactly
  /// Diagonal: on quadrilaterals by the Gauss-Lobatto rule with the nodes as points, on triangles the diagonal of the
  /// consistent matrix scaled to the mass of the cell (Hinton, Rock & Zienkiewicz 1976).
  lumped
};

/// Find u with rho u,tt + rate rho u,t - div sigma(u) = b. Prescribed displacements are zero and stay so; loads are
/// those of t = 0 and stay so. Supports that leave rigid motions free are allowed.
struct PlaneDynamicsOptions {
  int degree = 2;
  Mass mass = Mass::consistent;
  /// By region, kg/m^3.
  std::vector<double> densities;
};

/// Lowest solutions of K x = omega^2 M x.
struct PlaneModes {
  /// omega^2, 1/s^2, ascending; of rigid motions zero to rounding, of either sign.
  std::vector<double> squares;
  std::size_t n_dofs = 0; ///< prescribed ones included
  std::size_t nonzeros = 0;
  Seconds seconds;
};

/// Lanczos iteration (ARPACK) on (K + s M)^-1 M, with s small against the first elastic frequency of a body of this
/// size: the shifted matrix is positive definite for free bodies too.
///
/// Throws InvalidInput for an invalid problem, a prescribed displacement that is not zero, or more modes than unknowns
/// allow; SolveFailure if the iteration does not converge.
PlaneModes natural_frequencies(const PlaneProblem &problem, const PlaneDynamicsOptions &options, unsigned n_modes);

/// How time is stepped.
enum class TimeIntegration {
  newmark,           ///< beta = 1/4, gamma = 1/2 (mean acceleration): stable at any step
  central_difference ///< explicit with lumped mass; velocities live half a step earlier
};

/// A plane body that starts at rest and takes its loads at once at t = 0.
///
/// Newmark: (M + dt^2 / 4 K) a' = f - K (u + dt v + dt^2 / 4 a), with damping rate c: M (1 + c dt / 2), - c M (v + dt /
/// 2 a). Central difference: v' = v + dt (M^-1 (f - K u) - c v), u' = u + dt v'; the first kick is for half a step.
/// Without damping both keep an energy to rounding, Newmark 1/2 v M v + 1/2 u K u - f u, the other
/// 1/2 v' M v' + 1/2 u K u' - f (u + u') / 2 + dt^2 / 8 f M^-1 f, where the last term is of the start: the work is that
/// at the time of v'.
class PlaneMotion {
public:
  /// @param damping rate in 1/s; 0: none is computed
  /// Throws as `natural_frequencies`, and InvalidInput for central differences with consistent mass.
  PlaneMotion(const PlaneProblem &problem, const PlaneDynamicsOptions &options, TimeIntegration integration,
              double damping = 0);
  ~PlaneMotion();
  PlaneMotion(PlaneMotion &&) noexcept;
  PlaneMotion &operator=(PlaneMotion &&) noexcept;

  double time() const;
  std::int64_t steps() const;
  /// 2 / omega of the highest frequency, by power iteration on M^-1 K: the limit of central differences.
  double stable_step() const;
  /// Throws InvalidInput for a step above the stable one with central differences, SolveFailure for values that are not
  /// finite.
  void step(double time_step);

  double kinetic_energy() const; ///< J/m; see above
  double strain_energy() const;  ///< J/m
  double work() const;           ///< of the loads, J/m
  /// Displacement in m, as PlaneSolution::displacement.
  void displacement(std::span<const Point> points, std::span<Vector> values) const;

  std::size_t n_dofs() const;
  std::size_t nonzeros() const;
  Seconds seconds() const; ///< of the preparation

  /// Everything that a step reads, by name; who writes into it calls `adopt_state`.
  std::vector<std::pair<std::string, std::span<double>>> state();
  void adopt_state();

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};
} // namespace fem_reference::elasticity
