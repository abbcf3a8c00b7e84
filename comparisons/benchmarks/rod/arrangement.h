#pragma once

#include "comparisons/scene/vocabulary.h"

#include "meshless/cloud/particles.h"

#include <cstdint>
#include <string>
#include <vector>

namespace comparisons::benchmarks::rod {

/// Two ends and something between them.
inline constexpr int least_particles = 3;

/// Places of particles or vertices of a rod from 0 to `length`, both ends included.
struct Arrangement {
  double length = 1; ///< m
  int n = 2;
  /// Largest random move of an interior place, in spacings d = length / (n - 1).
  double perturbation = 0;
  std::uint64_t seed = 0;

  double spacing() const { return length / (n - 1); }
  /// Increasing, m. A seed has one sequence of random numbers, the same for every n, so that the levels of one seed are
  /// alike near the left end and slopes scatter less.
  std::vector<double> places() const;
};

/// What stands for the integral's dx at a particle.
enum class Volumes {
  equal,   ///< d everywhere, the ends included: what reproduces the paper
  voronoi, ///< half the distance between the two neighbours; at an end half a cell
};

/// Particles with h = `smoothing_length` times the mean spacing and volumes.
meshless::cloud::Particles<1> make_particles(const std::vector<double> &places, double smoothing_length,
                                             Volumes volumes);

/// Number of places of a level, one count or a spacing.
int count_of(const scene::Level &level, double length);

/// Keys `length` and `perturbation`, and with `seeds` also `seeds`.
std::vector<scene::Declaration> arrangement_keys(bool seeds);

/// Findings about the level: fewer than `least` places, more than `most`, and about seeds that change nothing.
void check_arrangement(const scene::CheckContext &context, int least, int most, scene::Diagnostics &diagnostics);

/// Arrangements to solve and average: one, or `seeds` if the places are perturbed.
/// @param seed of the study; arrangement k has seed + k
std::vector<Arrangement> arrangements(const scene::Parameters &problem, const scene::Level &level, std::int64_t seed);

} // namespace comparisons::benchmarks::rod
