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

  /// Least pivot ratio of a moment matrix (basis::Regularity): at a particle or at one of eight points around it on the
  /// edge of its subdomain.
  double smallest_pivot_ratio = 1;
  std::size_t worst = 0; ///< particle
  Point2 worst_point{};
};

/// @param reach radius of the subdomains in units of h; 0: only the particles themselves are looked at
CloudQuality cloud_quality(const Surroundings &surroundings, const cloud::Particles<2> &particles,
                           const basis::ShapeFunctions<2> &basis, double reach);

/// Moment matrices with a smaller pivot ratio count as poor. On jittered and graded clouds with the usual supports the
/// least is 1e-3 for order 2 and 1e-5 for order 4; half the digits of a double are lost at 1e-8.
inline constexpr double poor_pivot_ratio = 1e-7;

/// A cloud with some smoothing lengths enlarged.
struct Enlargement {
  cloud::Particles<2> particles;
  std::size_t n_enlarged = 0;
  double largest_factor = 1;
};

/// Enlarges smoothing lengths where a moment matrix is poor, at a particle or on the edge of its subdomain: of
/// the particles at the outskirts of that point's neighbourhood, 5 % at a time, until it is not. Gives up, and leaves
/// the refusal to the solver, where twice the length does not help.
/// @param reach radius of the subdomains in units of h
Enlargement enlarge_where_poor(const Surroundings &surroundings, const cloud::Particles<2> &particles,
                               const basis::ShapeFunctions<2> &basis, double reach);

} // namespace meshless::elasticity
