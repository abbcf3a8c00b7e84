#include "comparisons/problems/domain_boundary.h"

#include <vector>

namespace comparisons::problems {

meshless::domain::Boundary domain_boundary(std::span<const BoundaryPiece> pieces) {
  std::vector<meshless::domain::BoundaryPiece> translated;
  for (const auto &piece : pieces) {
    translated.push_back({piece.begin, piece.end, piece.id});
    if (piece.arc)
      translated.back().arc = {piece.arc->centre, piece.arc->counter_clockwise};
  }
  return meshless::domain::Boundary(std::move(translated));
}

} // namespace comparisons::problems
