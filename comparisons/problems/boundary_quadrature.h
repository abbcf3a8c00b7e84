#pragma once

#include "comparisons/problems/plane_problem.h"

#include <map>
#include <vector>

namespace comparisons::problems {

/// Points, outward unit normals and weights (m) over all pieces of one boundary id.
struct BoundaryQuadrature {
  std::vector<Point2> points;
  std::vector<Vector2> normals;
  std::vector<double> weights;
};

/// Gauss points on the outer boundary of a statement, by id: lines and arcs exactly as they are, every id in at least
/// this many parts of five points in proportion to length. Interfaces are left out.
std::map<int, BoundaryQuadrature> boundary_quadrature(const PlaneStatement &statement, double least_parts = 96);

} // namespace comparisons::problems
