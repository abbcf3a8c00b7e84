#pragma once

#include <array>
#include <span>
#include <vector>

namespace fem_reference::mesh {
/// Position in metres.
using Point = std::array<double, 2>;

/// Plain mesh of quadrilaterals with straight sides. Nothing is checked on construction; `check`
/// does it, and the solver calls it.
struct QuadrilateralMesh {
  /// A side of a cell that lies on the boundary, in either direction, with its boundary id (>= 0).
  struct BoundaryEdge {
    std::array<unsigned, 2> vertices;
    int id;
  };

  std::vector<Point> vertices;
  /// Four vertex indices a cell, counter-clockwise.
  std::vector<std::array<unsigned, 4>> cells;
  /// Every boundary edge exactly once.
  std::vector<BoundaryEdge> boundary;
};

/// Where a boundary edge sits: the cell and the cell's own side k, from its vertex k to k + 1.
struct CellSide {
  unsigned cell;
  unsigned side;
};

/// Check the mesh completely.
/// Refused (InvalidInput, naming the item by index): no cells, vertex indices out of range, vertices
/// that are not finite, coincide or belong to no cell, cells that are inverted, degenerate or not
/// convex (Jacobian not positive at a corner), edges of more than two cells or of two cells with
/// opposite orientation, boundary edges that are missing, listed twice, or not on the boundary.
/// Returns for each entry of `mesh.boundary` the cell it belongs to.
std::vector<CellSide> check(const QuadrilateralMesh &mesh);

/// Rectangle with a uniform grid of vertices_x x vertices_y vertices (both >= 2), numbered
/// row by row from the lower left corner; cells likewise.
/// Boundary ids: 0 left, 1 right, 2 bottom, 3 top.
QuadrilateralMesh rectangle(Point lower, Point upper, unsigned vertices_x, unsigned vertices_y);

/// The same topology with given vertex positions (vertices_x * vertices_y of them, row by row), for
/// example a grid with moved interior vertices. Refuses inverted cells, by index.
QuadrilateralMesh rectangle(std::span<const Point> vertices, unsigned vertices_x, unsigned vertices_y);
} // namespace fem_reference::mesh
