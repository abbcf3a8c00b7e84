#pragma once

#include "fem_reference/mesh/quadrilateral_mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace fem_reference::elasticity {
/// Nodes of a continuous Qp space on a mesh, as plain arrays. Positions are relative to `origin`.
struct Discretisation {
  /// A side of a cell on the boundary: 0 left, 1 right (xi_1 = 0, 1), 2 bottom, 3 top (xi_2 = 0, 1).
  struct Edge {
    unsigned cell;
    unsigned side;
    int id;
  };

  int degree = 0;
  std::size_t n_cells = 0;
  unsigned nodes_per_cell = 0;
  mesh::Point origin{};
  double extent = 0; ///< longer side of the bounding box
  /// nodes_per_cell nodes a cell, lexicographic (xi_1 fastest), with positive Jacobian.
  std::vector<unsigned> cell_nodes;
  std::vector<mesh::Point> positions;
  std::vector<Edge> edges;

  std::size_t n_nodes() const { return positions.size(); }
  std::span<const unsigned> nodes_of(std::size_t cell) const {
    return {cell_nodes.data() + cell * nodes_per_cell, nodes_per_cell};
  }
  /// Local number of node k = 0 ... degree of a side, in the direction of growing xi.
  unsigned node_of_side(unsigned side, unsigned k) const {
    const auto p = static_cast<unsigned>(degree);
    const unsigned n = p + 1;
    switch (side) {
    case 0:
      return k * n;
    case 1:
      return k * n + p;
    case 2:
      return k;
    default:
      return p * n + k;
    }
  }
  /// The node's position in the caller's coordinates.
  mesh::Point original_position(std::size_t node) const {
    return {origin[0] + positions[node][0], origin[1] + positions[node][1]};
  }
};

/// A checked mesh as a deal.II triangulation with numbered Qp nodes. The seconds spent on mesh and
/// numbering are written to the two last arguments.
Discretisation discretise(const mesh::QuadrilateralMesh &mesh, int degree, double &seconds_mesh,
                          double &seconds_numbering);
} // namespace fem_reference::elasticity
