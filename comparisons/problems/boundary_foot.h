#pragma once

#include "comparisons/problems/plane_problem.h"

namespace comparisons::problems {

/// Foot of the perpendicular from a point to a piece, within it: the point of the piece nearest to it.
Point2 nearest_on(const BoundaryPiece &piece, const Point2 &x);

} // namespace comparisons::problems
