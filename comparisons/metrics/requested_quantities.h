#pragma once

#include "comparisons/methods/solution.h"
#include "comparisons/metrics/force_balance.h"
#include "comparisons/problems/plane_problem.h"

#include <map>
#include <string>

namespace comparisons::metrics {

/// Adds the quantities that a problem asks for, by name, and for each with a reference `<name>_error`, the magnitude of
/// the relative difference (of the difference itself, if the reference is 0).
///
/// Stress is the solution's own; if it has a field "recovered_stress", `<name>_recovered` is that one's, with its own
/// error. Reactions are those of `equilibrium`. The strain energy is the solution's own
/// (Solution::own_strain_energy), or half the integral of sigma : C^-1 : sigma by the quadrature of the error norms.
///
/// @throws std::runtime_error naming the quantity if its value is not finite
void add_requested_quantities(const methods::Solution &solution, const problems::PlaneProblem &problem,
                              const problems::Quadrature &quadrature, const Equilibrium &equilibrium,
                              std::map<std::string, double> &quantities);

} // namespace comparisons::metrics
