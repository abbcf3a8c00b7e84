#pragma once

#include "seen_piece.h"

#include "meshless/domain/visibility.h"

#include <span>

namespace meshless::domain {

/// Length of the way from a point along the straight ray in `direction` to the distance `r`, its gaps outside of the
/// domain replaced by the way along the boundary, m.
///
/// @param meetings nearest first, those before `r`
/// @param outside for every interval between two of them, the first beginning at the point and the last ending at r,
///   whether it is outside of the domain
double way_around(const Visibility &visibility, const Point2 &from, const Point2 &direction, double r,
                  std::span<const SeenPiece> pieces, std::span<const Meeting> meetings,
                  const std::vector<bool> &outside);

} // namespace meshless::domain
