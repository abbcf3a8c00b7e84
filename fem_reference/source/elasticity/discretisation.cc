#include "discretisation.h"

#include "../mesh/topology.h"
#include "../stopwatch.h"

#include <algorithm>
#include <limits>

namespace fem_reference::elasticity {
namespace {
using mesh::Curve;
using mesh::Point;
using mesh::Topology;

/// Centre of the bounding box, and its longer side.
void set_origin(const mesh::PlaneMesh &mesh, Discretisation &discretisation) {
  Point lower = mesh.vertices.front();
  Point upper = lower;
  for (const auto &vertex : mesh.vertices)
    for (std::size_t d = 0; d < 2; ++d) {
      lower[d] = std::min(lower[d], vertex[d]);
      upper[d] = std::max(upper[d], vertex[d]);
    }
  for (std::size_t d = 0; d < 2; ++d)
    discretisation.origin[d] = lower[d] + .5 * (upper[d] - lower[d]);
  discretisation.extent = std::max(upper[0] - lower[0], upper[1] - lower[1]);
}

/// Numbers the nodes as the cells meet them and places them on the geometry.
class Numbering {
public:
  Numbering(const mesh::PlaneMesh &mesh, const Topology &topology, Discretisation &discretisation)
      : mesh_(mesh), topology_(topology), result_(discretisation), node_of_vertex_(mesh.vertices.size(), unknown),
        first_node_of_edge_(topology.edges.size(), unknown) {
    if (result_.degree() > 1) // else edges have no nodes to be placed
      for (const auto &curve : topology.curves)
        curves_.push_back(curve.relative_to(result_.origin));
  }

  void run() {
    result_.cell_start.push_back(0);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      add_cell(c);
  }

private:
  static constexpr unsigned unknown = std::numeric_limits<unsigned>::max();

  unsigned add_node(Point position) {
    result_.positions.push_back(position);
    return static_cast<unsigned>(result_.positions.size() - 1);
  }

  Point shifted(unsigned vertex) const {
    return {mesh_.vertices[vertex][0] - result_.origin[0], mesh_.vertices[vertex][1] - result_.origin[1]};
  }

  const Curve *curve_of(const Topology::Edge &edge) const {
    return edge.curve == Topology::straight || curves_.empty() ? nullptr
                                                               : &curves_[static_cast<std::size_t>(edge.curve)];
  }

  /// The nodes inside an edge run from its lower to its upper vertex.
  unsigned first_node_of(unsigned e) {
    auto &first = first_node_of_edge_[e];
    if (first != unknown)
      return first;
    first = static_cast<unsigned>(result_.positions.size());
    const auto &edge = topology_.edges[e];
    const auto *curve = curve_of(edge);
    const Point a = shifted(edge.lower);
    const Point b = shifted(edge.upper);
    const auto &line = result_.elements[0].line();
    for (int k = 1; k < line.degree(); ++k) {
      const double t = line.node(k);
      add_node(curve != nullptr ? curve->at(t) : Point{(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]});
    }
    return first;
  }

  void add_cell(std::size_t c) {
    const auto &cell = mesh_.cells[c];
    const auto corners = cell.corners();
    const auto &element = result_.elements[cell.n_vertices - 3];
    const auto p = static_cast<unsigned>(element.degree());
    result_.n_vertices.push_back(static_cast<unsigned char>(cell.n_vertices));
    result_.regions.push_back(cell.region);
    const std::size_t start = result_.cell_nodes.size();
    result_.cell_nodes.resize(start + element.n_nodes());
    result_.cell_start.push_back(static_cast<unsigned>(result_.cell_nodes.size()));
    unsigned *nodes = result_.cell_nodes.data() + start;

    std::array<Point, 4> positions;
    for (unsigned k = 0; k < corners.size(); ++k) {
      positions[k] = shifted(corners[k]);
      auto &node = node_of_vertex_[corners[k]];
      if (node == unknown)
        node = add_node(positions[k]);
      nodes[element.corner(k)] = node;
    }
    std::array<Curve, 4> curves;
    std::array<const Curve *, 4> sides{};
    bool curved = false;
    for (unsigned k = 0; k < corners.size(); ++k) {
      const unsigned e = topology_.edge_of_side[4 * c + k];
      const auto &edge = topology_.edges[e];
      const bool forward = edge.lower == corners[k];
      const unsigned first = first_node_of(e);
      for (unsigned l = 1; l < p; ++l)
        nodes[element.side(k)[l]] = first + (forward ? l - 1 : p - 1 - l);
      if (const auto *curve = curve_of(edge); curve != nullptr) {
        curves[k] = forward ? *curve : curve->reversed();
        sides[k] = &curves[k];
        curved = true;
      }
    }
    result_.curved.push_back(curved ? 1 : 0);
    const std::span<const Point> corner_positions(positions.data(), corners.size());
    for (const unsigned a : element.inside())
      nodes[a] = add_node(mesh::blend(corner_positions, sides, element.nodes()[a]));
  }

  const mesh::PlaneMesh &mesh_;
  const Topology &topology_;
  Discretisation &result_;
  std::vector<Curve> curves_; // relative to the origin
  std::vector<unsigned> node_of_vertex_;
  std::vector<unsigned> first_node_of_edge_;
};
} // namespace

std::vector<std::size_t> cells_touching(const parallel::Band &band, const Discretisation &discretisation,
                                        unsigned n_vertices) {
  std::vector<std::size_t> cells;
  for (std::size_t c = 0; c < discretisation.n_cells; ++c)
    if (discretisation.n_vertices[c] == n_vertices && band.touches(discretisation.nodes_of(c)))
      cells.push_back(c);
  return cells;
}

Discretisation discretise(const mesh::PlaneMesh &mesh, int degree, double &seconds_mesh, double &seconds_numbering) {
  Stopwatch stopwatch;
  const auto topology = mesh::checked_topology(mesh);
  seconds_mesh = stopwatch.lap();
  Discretisation discretisation(degree);
  discretisation.n_cells = mesh.cells.size();
  set_origin(mesh, discretisation);
  Numbering(mesh, topology, discretisation).run();
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    discretisation.edges.push_back({topology.boundary[e].cell, topology.boundary[e].side, mesh.boundary[e].id});
  seconds_numbering = stopwatch.lap();
  return discretisation;
}
} // namespace fem_reference::elasticity
