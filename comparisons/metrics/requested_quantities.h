#pragma once

#include "comparisons/methods/solution.h"
#include "comparisons/metrics/force_balance.h"
#include "comparisons/problems/plane_problem.h"

#include <map>
#include <string>

namespace comparisons::metrics {

/// The quantities that a problem asks for, by name, each divided by its scale; with a reference also "<name>_error",
/// relative to it.
///
/// Reactions are those of `equilibrium`; the strain energy is the method's own if it has one, else half the integral of
/// stress times strain over the quadrature; the largest von Mises stress is that of the quadrature's points.
std::map<std::string, double> requested_quantities(const methods::Solution &solution,
                                                   const problems::PlaneProblem &problem,
                                                   const problems::Quadrature &quadrature,
                                                   const Equilibrium &equilibrium);

/// Von Mises stress, with the normal stress out of the plane that plane strain has.
double von_mises(const problems::Stress2 &stress, const problems::Material &material);

} // namespace comparisons::metrics
