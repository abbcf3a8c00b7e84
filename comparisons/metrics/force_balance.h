#pragma once

#include "comparisons/methods/solution.h"
#include "comparisons/problems/plane_problem.h"

#include <array>
#include <map>
#include <optional>

namespace comparisons::metrics {

/// Forces on a body and what they leave over.
struct Equilibrium {
  using Force = std::array<double, 2>;
  /// By boundary id, N per m of thickness: the reaction in components whose displacement is prescribed, the applied
  /// traction in the others.
  std::map<int, Force> boundary;
  Force body{};
  /// |sum of all forces| over the integral of the magnitude of what is applied (of sigma n over the boundary if nothing
  /// is).
  double imbalance = 0;
  /// The same with the supports' forces of the method's own equations, stress and penalty; of weak forms. It is what
  /// their test functions leave, which do not sum to one.
  std::optional<double> discrete_imbalance;
};

/// Forces of a solution: by its own discrete equations if it has them (methods::ForceBalance), else loads are integrals
/// of the prescribed traction and body force, and the sum of the supports' forces comes from the stress inside the body
/// (support_force): it is the reaction of a boundary that alone prescribes a component. What each of several boundaries
/// bears, and all if there is no quadrature, are integrals of the stress over the boundary.
///
/// The test functions of the meshless weak forms do not sum to one, so nothing balances their forces but convergence:
/// the imbalance is an error measure that needs no exact solution.
/// @param quadrature over the domain
Equilibrium equilibrium(const methods::Solution &solution, const problems::PlaneStatement &statement,
                        const problems::Quadrature &quadrature);

} // namespace comparisons::metrics
