#pragma once

#include "meshless/domain/boundary.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace meshless::cloud_generation {

using Point2 = cloud::Point<2>;

/// Wanted distance of neighbours at points, m, > 0.
using SpacingField = std::function<void(std::span<const Point2>, std::span<double>)>;

/// What a cloud is made from.
struct CloudRequest {
  /// One boundary a region. Regions share the pieces between them: the same ends, opposite directions.
  std::vector<domain::Boundary> regions;
  SpacingField spacing;
  std::uint64_t seed = 0;
  /// The number of all particles, counting those on an interface once for each of its regions. The spacing is
  /// scaled by one factor until it fits; without it the spacing is taken as it is.
  std::optional<std::size_t> n_particles = {};
  /// By boundary id: the number of particles on every curve of that id, its ends included. A curve is an arc, or
  /// straight pieces of one id that follow each other without a corner.
  std::map<int, std::size_t> n_on_curves = {};
};

/// A cloud of particles, region by region; in each those of the boundary come first.
struct GeneratedCloud {
  std::vector<Point2> positions;
  /// Mean distance of the 4 nearest particles of the same region that are not behind its boundary, m.
  std::vector<double> spacing;
  /// Region of every particle. A particle on an interface stands once for each region, at the same place.
  std::vector<int> regions;
  /// The factor that the spacing was scaled by; 1 without a number of particles.
  double scale = 1;
};

/// A graded, relaxed cloud of particles.
///
/// Ends of arcs and corners (where pieces of different ids or more than two pieces meet, or the direction turns
/// by more than 20 degrees) carry a particle. Along a curve the particles are equally far apart in the integral
/// of 1 / s. Inside, the expected number of particles in an area is that of a hexagonal pattern,
///   n = integral 2 / (sqrt(3) s^2) dA;
/// they start at a seeded place in each n-th part of the area along Hilbert's curve, and repel each other and
/// the boundary until they lie evenly. Every particle is on the boundary, to rounding, or strictly inside.
///
/// The cost is O(N log N). The same request gives the same cloud on every machine, up to rounding.
///
/// @throws std::invalid_argument for no region, a spacing that is not finite and positive (with the point), a number
///   of particles that the boundary alone exceeds, an id in n_on_curves that no piece has, or more than 1e7 particles
GeneratedCloud generate(const CloudRequest &request);

/// Moves every particle by up to `amount` times its spacing in each direction: inside at random, along its piece
/// on the boundary, not at all at corners. A particle that would come nearer to the boundary than a quarter of
/// its spacing moves less. The two particles of an interface stay together.
/// @param amount in [0, 0.5)
/// @throws std::invalid_argument for sizes that differ, a region that does not exist, or an amount out of range
void jitter(std::span<const domain::Boundary> boundaries, std::span<const double> spacing, std::span<const int> regions,
            double amount, std::uint64_t seed, std::span<Point2> positions);

/// Mean distance of the 4 nearest particles of the same region that are not behind its boundary, m: a measure of
/// the local spacing that works on anisotropic clouds and beside thin slots.
/// @param regions of every particle; empty: all in the first
std::vector<double> local_spacing(std::span<const domain::Boundary> boundaries, std::span<const Point2> positions,
                                  std::span<const int> regions = {});

} // namespace meshless::cloud_generation
