#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/elasticity/surroundings.h"

#include <cstddef>

namespace meshless::elasticity {

/// Figures that tell whether a cloud suits a basis.
struct CloudQuality {
  /// Particles in whose support a particle lies, itself included, as far as it sees them.
  std::size_t fewest_neighbours = 0;
  std::size_t median_neighbours = 0;
  std::size_t most_neighbours = 0;
  std::size_t fewest_at = 0; ///< particle

  /// Least distance of two particles of a region over the smoothing length of the first.
  double smallest_distance = 0;
  std::size_t closest = 0; ///< particle

  /// Least pivot ratio of a moment matrix (basis::Regularity): at a particle or at one of sixteen points
  /// around it, halfway to the edge of its subdomain and on it.
  double smallest_pivot_ratio = 1;
  std::size_t worst = 0; ///< particle
  Point2 worst_point{};
  /// Of those moment matrices: not positive definite, and factorised with complete pivoting.
  std::size_t n_indefinite = 0;
};

/// @param reach radius of the subdomains in units of h; 0: only the particles themselves are looked at
CloudQuality cloud_quality(const Surroundings &surroundings, const cloud::Particles<2> &particles,
                           const basis::ShapeFunctions<2> &basis, double reach);

/// Moment matrices with a smaller pivot ratio count as poor: 1e-3 for order 1 to 1e-6 for order 4. On relaxed graded
/// clouds the least is 5e-2 for order 2 and 7e-6 for order 4 with h equal to the spacing (4e-4 with 1.3 spacings).
/// Where it is poor a neighbour that matters lies at the very edge of its support, and a little beside the basis does
/// not exist.
double poor_pivot_ratio(int order);

/// A cloud with some smoothing lengths enlarged.
struct Enlargement {
  cloud::Particles<2> particles;
  std::size_t n_enlarged = 0;
  double largest_factor = 1;
};

/// Enlarges smoothing lengths where a moment matrix is poor, at a particle or in its subdomain: of the
/// particles at the outskirts of that point's neighbourhood, 5 % at a time, until it is not. Gives up, and leaves
/// the refusal to the solver, where twice the length does not help.
/// @param reach radius of the subdomains in units of h
Enlargement enlarge_where_poor(const Surroundings &surroundings, const cloud::Particles<2> &particles,
                               const basis::ShapeFunctions<2> &basis, double reach);

} // namespace meshless::elasticity
