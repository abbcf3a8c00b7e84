#pragma once

#include <array>
#include <cstddef>

namespace comparisons::methods {

/// How well a level's particles suit a method's basis, and what its system will take.
struct CloudReport {
  /// Particles in whose support a particle lies.
  std::size_t fewest_neighbours = 0;
  std::size_t median_neighbours = 0;
  std::size_t most_neighbours = 0;
  /// Least distance of two particles over the smoothing length.
  double smallest_distance = 0;
  /// Least pivot of a moment matrix over its diagonal entry, 1 at best, and where.
  double pivot_ratio = 1;
  std::array<double, 2> worst_point{};
  /// Particles whose smoothing length was enlarged, and the largest factor.
  std::size_t n_enlarged = 0;
  double largest_enlargement = 1;

  /// If rows of a few particles were assembled: entries of all rows, and seconds for the points and all rows. Else 0.
  double nonzeros = 0;
  double seconds = 0;
};

} // namespace comparisons::methods
