#pragma once

#include "meshless/elasticity/equations_of_motion.h"
#include "meshless/elasticity/particle_solution.h"
#include "meshless/elasticity/strong_form/corner_rules.h"

#include <memory>
#include <vector>

namespace meshless::elasticity::strong_form {

/// Solves the problem by collocation, Batra & Zhang 2008, section 3.1: the equations of equilibrium
/// (3.8) at interior particles, prescribed displacement (3.13) or traction (3.14) at boundary
/// particles, two conditions at corners (see corner_rules.h). In the paper's (3.14), row 2, the
/// last entry must read (1 - nu0)/2 n1 K2J + n2 K3J: n2, not nu0 n2.
///
/// Rows are divided by their largest entry: unscaled, a sparse LU can return a small residual with
/// a wrong stress.
///
/// @param corner_rules for the particles at these corners; others follow the default rule
/// @throws basis::SingularMomentMatrix, linear_algebra::SolveError, std::invalid_argument (ill-posed
///   problem, a corner rule that cannot be met or has no particle, a basis of order 1)
ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis,
                       const std::vector<CornerRule> &corner_rules, const linear_algebra::SolverRequest &solver = {});

/// The same rows as equations of motion: inside sigma_ij,j = rho a_i - b_i, so that the mass is -rho phi_J there and
/// empty on boundaries. A body without supports is allowed.
/// @param densities of the regions, kg/m^3
EquationsOfMotion equations_of_motion(const PlaneProblem &problem, std::span<const double> densities,
                                      std::shared_ptr<const cloud::Particles<2>> particles,
                                      std::shared_ptr<const basis::ShapeFunctions<2>> basis,
                                      const std::vector<CornerRule> &corner_rules = {});

} // namespace meshless::elasticity::strong_form
