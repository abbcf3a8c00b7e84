#pragma once

#include "curve.h"
#include "fem_reference/mesh/plane_mesh.h"

#include <vector>

namespace fem_reference::mesh {
/// The edges of a checked mesh.
struct Topology {
  static constexpr int straight = -1;

  struct Edge {
    unsigned lower; ///< vertices, lower < upper
    unsigned upper;
    int curve = straight; ///< index in `curves`, which run from the lower vertex to the upper
  };

  std::vector<Edge> edges;
  /// Edge of side k of cell c at 4 c + k.
  std::vector<unsigned> edge_of_side;
  std::vector<Curve> curves;
  std::vector<CellSide> boundary; ///< as `check` returns it
};

/// As `check`, which see.
Topology checked_topology(const PlaneMesh &mesh);

/// The part of the check that does not look at edges.
void check_vertices(const PlaneMesh &mesh);
void check_cells(const PlaneMesh &mesh);

/// Point (s, t) of the unit square or, for a triangle, of the reference triangle (0, 0), (1, 0), (0, 1), mapped by
/// transfinite interpolation of the sides: the cell's corners, and the curve of side k from corner k to
/// k + 1, null where it is straight.
Point blend(std::span<const Point> corners, std::span<const Curve *const> sides, Point xi);
} // namespace fem_reference::mesh
