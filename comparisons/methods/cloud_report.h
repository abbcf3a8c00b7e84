#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace comparisons::methods {

/// How well a level's particles suit a method's basis, and what its system will take.
struct CloudReport {
  std::int64_t order = 0; ///< of the basis
  /// Particles in whose support a particle lies.
  std::size_t fewest_neighbours = 0;
  std::size_t median_neighbours = 0;
  std::size_t most_neighbours = 0;
  /// Least distance of two particles over the smoothing length.
  double smallest_distance = 0;
  /// Least pivot of a moment matrix over its diagonal entry, 1 at best, and where.
  double pivot_ratio = 1;
  std::array<double, 2> worst_point{};
  /// Orders below the one asked for.
  std::int64_t n_orders_lowered = 0;
  /// Particles whose smoothing length was enlarged, and the largest factor.
  std::size_t n_enlarged = 0;
  double largest_enlargement = 1;
  /// Moment matrices, at the particles and around them, that are not positive definite: factorised with complete
  /// pivoting.
  std::size_t n_pivoted = 0;

  /// If rows of a few particles were assembled: entries of all rows, and seconds for the points and all rows. Else 0.
  double nonzeros = 0;
  double seconds = 0;
};

} // namespace comparisons::methods
