#pragma once

#include "comparisons/methods/solution.h"
#include "comparisons/problems/boundary_quadrature.h"
#include "comparisons/problems/plane_problem.h"

#include <array>
#include <map>
#include <optional>

namespace comparisons::metrics {

/// The force of all supports on the body, N per m of thickness, from the stress inside it; component k is
///   int_u sigma_kj n_j = int (sigma_kj w,j - b_k w) - int_t t_k w,
/// over the domain and over the boundary where the traction t_k is prescribed. The weight w is 1 where displacement u_k
/// is prescribed and falls to 0 where the distance r from there is largest: w = 1 - S(r / max r) with
/// S(s) = s^3 (10 - 15 s + 6 s^2) and r = (sum d^-2)^(-1/2) over the boundary pieces at the distances d, a distance
/// without kinks, of which a quadrature would see little (after Biswas & Shapiro 2004).
///
/// An integral of the stress over the supports themselves sees it where it is worst, and not at all at corners where it
/// is singular. Of this one the error is int (sigma_h - sigma)_kj w,j: never more than the L2 error of stress times
/// the norm of the gradient of w, whatever the domain (Babuska & Miller 1984: extraction).
/// @param quadrature over the domain
/// @returns nothing for a component of the displacement that is prescribed nowhere
std::array<std::optional<double>, 2> support_force(const methods::Solution &solution,
                                                   const problems::PlaneStatement &statement,
                                                   const std::map<int, problems::BoundaryQuadrature> &boundary,
                                                   const problems::Quadrature &quadrature);

} // namespace comparisons::metrics
