#pragma once

#include "../parallel/bands.h"
#include "fem_reference/mesh/plane_mesh.h"
#include "reference_element.h"

#include <cstddef>
#include <span>
#include <vector>

namespace fem_reference::elasticity {
/// d x_i / d xi_k at a point of a cell.
struct Jacobian {
  double j11 = 0, j12 = 0, j21 = 0, j22 = 0;

  double determinant() const { return j11 * j22 - j12 * j21; }
};

/// Nodes of a continuous space of elements Qp and Pp on a mesh, as plain arrays. Positions are relative to `origin`.
struct Discretisation {
  /// A side of a cell on the boundary; see ReferenceElement::side.
  struct Edge {
    unsigned cell;
    unsigned side;
    int id;
  };

  explicit Discretisation(int degree) : elements{ReferenceElement(3, degree), ReferenceElement(4, degree)} {}

  std::size_t n_cells = 0;
  mesh::Point origin{};
  double extent = 0;                        ///< longer side of the bounding box
  std::array<ReferenceElement, 2> elements; ///< triangle, quadrilateral
  /// Nodes of cell c, in the order of its element and with positive Jacobian: cell_nodes[cell_start[c]] ...
  std::vector<unsigned> cell_start;
  std::vector<unsigned> cell_nodes;
  std::vector<unsigned char> n_vertices; ///< of each cell
  std::vector<unsigned char> curved;     ///< of each cell: whether it has a curved side
  std::vector<int> regions;              ///< of each cell
  std::vector<mesh::Point> positions;
  std::vector<Edge> edges;

  int degree() const { return elements[0].degree(); }
  std::size_t n_nodes() const { return positions.size(); }
  const ReferenceElement &element_of(std::size_t cell) const { return elements[n_vertices[cell] - 3U]; }
  std::span<const unsigned> nodes_of(std::size_t cell) const {
    return {cell_nodes.data() + cell_start[cell], cell_start[cell + 1] - cell_start[cell]};
  }
  /// Node k of a side of a cell, counter-clockwise.
  unsigned node_of_side(const Edge &edge, unsigned k) const {
    return cell_nodes[cell_start[edge.cell] + element_of(edge.cell).side(edge.side)[k]];
  }
  /// At the point where the shape functions of the cell have these derivatives along xi_1 and xi_2.
  Jacobian jacobian(std::size_t cell, const double *gradient_1, const double *gradient_2) const {
    Jacobian j;
    const auto nodes = nodes_of(cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto &x = positions[nodes[a]];
      j.j11 += x[0] * gradient_1[a];
      j.j12 += x[0] * gradient_2[a];
      j.j21 += x[1] * gradient_1[a];
      j.j22 += x[1] * gradient_2[a];
    }
    return j;
  }
  /// The node's position in the caller's coordinates.
  mesh::Point original_position(std::size_t node) const {
    return {origin[0] + positions[node][0], origin[1] + positions[node][1]};
  }
};

/// The cells with `n_vertices` vertices that have a node in the band, ascending.
std::vector<std::size_t> cells_touching(const parallel::Band &band, const Discretisation &discretisation,
                                        unsigned n_vertices);

/// Checks a mesh and numbers its nodes, in the order of the cells. The seconds spent on checks and
/// numbering are written to the two last arguments.
Discretisation discretise(const mesh::PlaneMesh &mesh, int degree, double &seconds_mesh, double &seconds_numbering);
} // namespace fem_reference::elasticity
