#pragma once

#include "comparisons/metrics/force_balance.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comparisons::metrics {

/// Measures of the error that need no exact solution, each a fraction, by name:
/// - force_imbalance: see Equilibrium; only of methods that do not balance by their own discrete equations;
/// - traction_residual: sqrt(int |sigma n - t|^2 / int |sigma|^2) over the boundary with prescribed tractions, per
///   component: what a free face carries that it should not;
/// - stress_jump: sqrt(sum |sigma* - sigma|^2 / sum |sigma|^2) at `points`, with sigma* the continuous stress that the
///   method recovers (Zienkiewicz & Zhu 1987); only of methods that have one. Shear locking shows in it first.
using ErrorIndicators = std::map<std::string, double>;

/// @param points inside, away from the centres of cells, where the stress of elements is better than elsewhere
ErrorIndicators error_indicators(const methods::Solution &solution, const problems::PlaneStatement &statement,
                                 const Equilibrium &equilibrium, std::span<const problems::Point2> points);

/// An indicator over the relative L2 error of stress, which it should tell: 1 at best, and the same on every level if
/// it falls as that does. Nothing where the stress is not known, or exact to rounding.
/// @param errors of a cell, by name
std::optional<double> effectivity(double indicator, const std::map<std::string, double> &errors);

/// A sentence for each indicator above its limit; none if the solution may be trusted as far as they can tell.
std::vector<std::string> doubts(const ErrorIndicators &indicators);

} // namespace comparisons::metrics
