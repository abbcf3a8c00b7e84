#pragma once

#include "comparisons/problems/plane_problem.h"

#include <map>
#include <utility>

namespace comparisons::geometry {

/// The curved edges of a mesh, arcs and parabolas, by their vertices in ascending order.
class EdgeCurves {
public:
  explicit EdgeCurves(const problems::Mesh &mesh);

  /// Point at the parameter t in [0, 1] from `a` to `b`, by arc length on arcs, on the straight line if the edge is
  /// none of the curved ones.
  problems::Point2 point(const problems::Mesh &mesh, unsigned a, unsigned b, double t) const;
  /// True if the edge is an arc or a parabola.
  bool is_curved(unsigned a, unsigned b) const;

private:
  using Key = std::pair<unsigned, unsigned>;
  std::map<Key, problems::Point2> centres_;
  std::map<Key, problems::Point2> midpoints_;
};

/// Each triangle and quadrilateral in four; edges are halved on their curves, so that the domain stays the same.
problems::Mesh refine(const problems::Mesh &mesh);

/// n x n Gauss points a cell (collapsed into triangles). A cell with curved edges is mapped by its corners and the
/// middles of its edges: exact for parabolas; on arcs of angle a the error of the area is about a^5 r^2 / 960.
problems::Quadrature cell_quadrature(const problems::Mesh &mesh, int n);

/// Mean length of the edges at every vertex, m.
std::vector<double> vertex_spacing(const problems::Mesh &mesh);

/// Which cells are in one piece with each other: the number of the component of every cell, and how many there are.
std::pair<std::vector<int>, int> components(const problems::Mesh &mesh);

} // namespace comparisons::geometry
