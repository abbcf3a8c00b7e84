#pragma once

#include "meshless/cloud_generation/generator.h"

namespace meshless::cloud_generation {

/// Outward normals of the boundary at particles on it, so that what lies behind it does not count as near.
class Wall {
public:
  /// Particles that are not on the boundary have no normal, and see everything.
  Wall(const domain::Boundary &boundary, std::span<const Point2> particles);

  /// True if `x` lies behind the boundary as seen from particle i: more than 30 degrees outwards of every piece
  /// there. Less is what neighbours on the edge of a hole have.
  bool hides(std::size_t i, const Point2 &particle, const Point2 &x) const {
    if (counts_[i] == 0)
      return false;
    const double dx = x[0] - particle[0];
    const double dy = x[1] - particle[1];
    const double quarter = 0.25 * (dx * dx + dy * dy);
    for (int k = 0; k < counts_[i]; ++k) {
      const Point2 &n = normals_[i][static_cast<std::size_t>(k)];
      const double outwards = dx * n[0] + dy * n[1];
      if (outwards <= 0 || outwards * outwards <= quarter)
        return false;
    }
    return true;
  }

  bool on_boundary(std::size_t i) const { return counts_[i] > 0; }

private:
  std::vector<std::array<Point2, 2>> normals_;
  std::vector<int> counts_;
};

} // namespace meshless::cloud_generation
