#include "wall.h"

#include <algorithm>

namespace meshless::cloud_generation {

Wall::Wall(const domain::Boundary &boundary, std::span<const Point2> particles)
    : normals_(particles.size()), counts_(particles.size()) {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto pieces = boundary.pieces_at(particles[i]);
    counts_[i] = static_cast<int>(std::min<std::size_t>(2, pieces.size()));
    for (std::size_t k = 0; k < std::min<std::size_t>(2, pieces.size()); ++k) {
      const auto &piece = boundary.pieces()[pieces[k]];
      normals_[i][k] = piece.normal(piece.nearest(particles[i]));
    }
  }
}

} // namespace meshless::cloud_generation
