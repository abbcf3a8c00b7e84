#include "meshless/cloud_generation/generator.h"

#include "meshless/cloud_generation/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace meshless::cloud_generation {

namespace {

/// A move along the first of two equal pieces that has its lower end first, whatever region it is seen from.
Point2 moved_along(const domain::BoundaryPiece &piece, const Point2 &x, double distance) {
  const double length = piece.length();
  const double sign = piece.begin < piece.end ? 1 : -1;
  // The ends are corners, or carry a particle that may come nearer too.
  const double t = piece.nearest(x);
  const double room = 0.45 * std::min(t, 1 - t) * length;
  return piece.point(t + sign * std::clamp(distance, -room, room) / length);
}

/// Halves the move until the particle keeps a quarter of its spacing from the boundary.
Point2 moved_inside(const domain::Boundary &boundary, const Point2 &x, Point2 move, double spacing) {
  // What was nearer before may stay as near.
  const double least = std::min(0.25 * spacing, 0.9 * boundary.distance(x));
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Point2 there{x[0] + move[0], x[1] + move[1]};
    if (boundary.contains(there) && boundary.distance(there) >= least)
      return there;
    move = {0.5 * move[0], 0.5 * move[1]};
  }
  return x;
}

} // namespace

void jitter(std::span<const domain::Boundary> boundaries, std::span<const double> spacing, std::span<const int> regions,
            double amount, std::uint64_t seed, std::span<Point2> positions) {
  if (!(amount >= 0) || amount >= 0.5)
    throw std::invalid_argument(fmt::format("a jitter of {} spacings; allowed is [0, 0.5)", amount));
  if (spacing.size() != positions.size() || (!regions.empty() && regions.size() != positions.size()))
    throw std::invalid_argument(
        fmt::format("{} particles, {} spacings and {} regions", positions.size(), spacing.size(), regions.size()));
  Random random(seed);
  // Numbers are drawn once for a place, so that both particles of an interface move alike.
  std::map<Point2, Point2> moves;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Point2 &x = positions[i];
    const auto r = regions.empty() ? std::size_t{0} : static_cast<std::size_t>(regions[i]);
    if (r >= boundaries.size())
      throw std::invalid_argument(fmt::format("particle {} is in region {}; there are {}", i, r, boundaries.size()));
    const auto pieces = boundaries[r].pieces_at(x);
    const Point2 drawn{random.symmetric() * amount, random.symmetric() * amount};
    if (pieces.size() > 1)
      continue;
    if (pieces.empty()) {
      x = moved_inside(boundaries[r], x, {drawn[0] * spacing[i], drawn[1] * spacing[i]}, spacing[i]);
      continue;
    }
    const auto [move, first] = moves.try_emplace(x, Point2{drawn[0] * spacing[i], 0});
    x = moved_along(boundaries[r].pieces()[pieces[0]], x, move->second[0]);
  }
}

} // namespace meshless::cloud_generation
