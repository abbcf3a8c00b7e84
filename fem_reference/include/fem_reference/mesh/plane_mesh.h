#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace fem_reference::mesh {
/// Position in metres.
using Point = std::array<double, 2>;

/// A triangle or a quadrilateral by its corners, counter-clockwise.
struct Cell {
  std::array<unsigned, 4> vertices{};
  unsigned n_vertices = 4; ///< 3 or 4; a triangle's fourth entry is not read
  int region = 0;          ///< index of its material

  std::span<const unsigned> corners() const { return {vertices.data(), n_vertices}; }
  std::span<unsigned> corners() { return {vertices.data(), n_vertices}; }
};

/// A side of a cell that lies on the boundary, in either direction, with its boundary id (>= 0). With
/// an arc_centre it is the shorter arc of the circle around that point.
struct BoundaryEdge {
  std::array<unsigned, 2> vertices{};
  int id = 0;
  std::optional<Point> arc_centre = {};
};

/// An edge between two cells that is the shorter arc around `centre`, for instance of a round interface.
struct InteriorArc {
  std::array<unsigned, 2> vertices{};
  Point centre{};
};

/// An edge, inside or on the boundary, that is the parabola x(t), t in [0, 1], through its first vertex (t = 0),
/// `midpoint` (t = 1/2) and its second vertex: the geometry of second-order mesh files.
struct CurvedEdge {
  std::array<unsigned, 2> vertices{};
  Point midpoint{};
};

/// Plain mesh of triangles and quadrilaterals, in any mixture. Nothing is checked on construction;
/// `check` does it, and the solver calls it.
///
/// Edges are straight unless an arc or a parabola is given for them. Elements of degree p take their nodes on
/// an edge from that curve; nodes inside a cell follow by transfinite interpolation of its sides. Elements
/// of degree 1 see the vertices alone.
struct PlaneMesh {
  std::vector<Point> vertices;
  std::vector<Cell> cells;
  /// Every boundary edge exactly once.
  std::vector<BoundaryEdge> boundary;
  std::vector<CurvedEdge> curved_edges = {};
  std::vector<InteriorArc> interior_arcs = {};
};

/// Where a boundary edge sits: the cell and the cell's own side k, from its corner k to k + 1.
struct CellSide {
  unsigned cell;
  unsigned side;
};

/// Check the mesh completely, but for cells that only a curved side inverts: those the solver finds.
/// Refused (InvalidInput, naming the item by index): no cells, cells that are neither triangles nor
/// quadrilaterals, negative regions, vertex indices out of range, vertices that are not finite, coincide or
/// belong to no cell, cells whose corners are inverted, degenerate or not convex, edges of more than two cells
/// or of two cells with opposite orientation, boundary edges that are missing, listed twice, or not on the
/// boundary, arcs whose ends are not on one circle or lie opposite each other, curves that are given
/// twice or for no edge.
/// Returns for each entry of `mesh.boundary` the cell it belongs to.
std::vector<CellSide> check(const PlaneMesh &mesh);

/// Each quadrilateral becomes four and each triangle four similar ones; arcs stay arcs of the same circle and
/// parabolas are halved, so that the domain stays the same. Regions and boundary ids are inherited. The new
/// edges inside a cell are straight. Throws InvalidInput for an invalid mesh.
PlaneMesh refine(const PlaneMesh &mesh);

/// Each quadrilateral cut into two triangles along the diagonal from its first to its third vertex.
/// A cell with a curved side may need the other one; the solver refuses triangles that are inverted.
PlaneMesh split_into_triangles(const PlaneMesh &mesh);
} // namespace fem_reference::mesh
