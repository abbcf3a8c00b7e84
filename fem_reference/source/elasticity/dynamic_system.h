#pragma once

#include "boundary_conditions.h"
#include "discretisation.h"
#include "fem_reference/elasticity/plane_dynamics.h"

#include "../linear_algebra/direct_solvers.h"

#include <memory>
#include <vector>

namespace fem_reference::elasticity {
/// Matrices of the equations of motion. Rows and columns of prescribed unknowns are empty but for the diagonal: without
/// a force they stay zero.
struct DynamicSystem {
  /// Throws InvalidInput; see natural_frequencies.
  DynamicSystem(const PlaneProblem &problem, const PlaneDynamicsOptions &options);

  /// mass_factor M + stiffness_factor K, factorised. Throws SolveFailure.
  std::unique_ptr<linear_algebra::DirectSolver> factorise(double mass_factor, double stiffness_factor) const;

  Seconds seconds;
  Discretisation discretisation;
  EssentialData essential;
  linear_algebra::BlockMatrix stiffness;
  linear_algebra::BlockMatrix mass;
  std::vector<double> diagonal_mass; ///< by unknown, lumped only; of prescribed unknowns 0
  std::vector<double> force;         ///< 0 for prescribed unknowns
  double wave_speed = 0;             ///< the fastest sqrt((lambda + 2 mu) / rho), m/s
};
} // namespace fem_reference::elasticity
