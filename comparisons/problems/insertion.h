#pragma once

#include "comparisons/problems/plane_problem.h"

#include <cstddef>

namespace comparisons::problems {

// Points added to a discretisation where they are wanted, the rest of it as it is: what Zhang & Batra 2008, Table 7,
// calls the addition of nodes or particles.

/// Adds about `n` particles: midpoints of neighbours, those nearest to `place` first, with half their spacing. None
/// comes nearer to another particle than 0.45 of the spacing, or to the boundary than a quarter of it; there may be
/// fewer than `n` if no more fit.
Cloud with_points_near(const Point2 &place, std::size_t n, Cloud cloud, const PlaneStatement &statement);

/// Adds about `n` vertices: in the cells nearest to `place` a copy of half the size around the centre, joined to the
/// cell's sides by quadrilaterals, so that no other cell is touched and no node hangs.
Mesh with_points_near(const Point2 &place, std::size_t n, Mesh mesh);

} // namespace comparisons::problems
