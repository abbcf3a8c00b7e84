#pragma once

#include "comparisons/methods/solution.h"
#include "comparisons/problems/plane_problem.h"

#include <map>
#include <string>

namespace comparisons::metrics {

/// Errors of a solution against the exact one, all methods on the same points:
/// - displacement_l2_relative: ||u_h - u|| / ||u|| in L2;
/// - displacement_log10_l2: its decimal logarithm;
/// - displacement_log10_E: decimal logarithm of | ||u_h|| - ||u|| | / ||u||, Batra & Zhang 2008 (4.4). It
///   is a difference of norms, not a norm of the difference, and can be small for a wrong solution;
/// - displacement_max_relative: largest |u_h - u| over largest |u| at the quadrature points;
/// - stress_l2_relative: the same for stress, sigma_12 counted twice (tensor norm);
/// - energy_relative: error in the energy norm over the energy norm of the solution;
/// - and what the problem asks for of one component (PlaneProblem::component_errors), such as u2_max_relative.
///
/// @throws std::runtime_error if the solution is not finite at some point
std::map<std::string, double> error_norms(const methods::Solution &solution, const problems::PlaneProblem &problem,
                                          const problems::Quadrature &quadrature);

} // namespace comparisons::metrics
