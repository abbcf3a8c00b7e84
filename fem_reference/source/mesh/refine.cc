#include "topology.h"

namespace fem_reference::mesh {
namespace {
/// Numbers of the new vertices: those of the mesh, one on each edge, one in each quadrilateral.
class Refinement {
public:
  explicit Refinement(const PlaneMesh &mesh) : mesh_(mesh), topology_(checked_topology(mesh)) {
    fine_.vertices = mesh.vertices;
    for (const auto &edge : topology_.edges) {
      const auto &a = mesh.vertices[edge.lower];
      const auto &b = mesh.vertices[edge.upper];
      fine_.vertices.push_back(edge.curve == Topology::straight
                                   ? Point{a[0] + .5 * (b[0] - a[0]), a[1] + .5 * (b[1] - a[1])}
                                   : topology_.curves[static_cast<std::size_t>(edge.curve)].at(.5));
    }
  }

  PlaneMesh run() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      if (mesh_.cells[c].n_vertices == 3)
        divide_triangle(c);
      else
        divide_quadrilateral(c);
    for (std::size_t e = 0; e < mesh_.boundary.size(); ++e) {
      const auto &edge = mesh_.boundary[e];
      const unsigned middle = middle_of(4 * std::size_t{topology_.boundary[e].cell} + topology_.boundary[e].side);
      for (const unsigned end : edge.vertices)
        fine_.boundary.push_back({{end, middle}, edge.id, edge.arc_centre});
    }
    divide_curves();
    return std::move(fine_);
  }

private:
  unsigned middle_of(std::size_t side) const {
    return static_cast<unsigned>(mesh_.vertices.size()) + topology_.edge_of_side[side];
  }

  void divide_triangle(std::size_t c) {
    const auto &cell = mesh_.cells[c];
    const std::array<unsigned, 3> m = {middle_of(4 * c), middle_of(4 * c + 1), middle_of(4 * c + 2)};
    for (unsigned k = 0; k < 3; ++k)
      fine_.cells.push_back({{cell.vertices[k], m[k], m[(k + 2) % 3]}, 3, cell.region});
    fine_.cells.push_back({{m[0], m[1], m[2]}, 3, cell.region});
  }

  void divide_quadrilateral(std::size_t c) {
    const auto &cell = mesh_.cells[c];
    std::array<Point, 4> corners;
    std::array<Curve, 4> curves;
    std::array<const Curve *, 4> sides{};
    std::array<unsigned, 4> m{};
    for (unsigned k = 0; k < 4; ++k) {
      corners[k] = mesh_.vertices[cell.vertices[k]];
      m[k] = middle_of(4 * c + k);
      const auto &edge = topology_.edges[topology_.edge_of_side[4 * c + k]];
      if (edge.curve == Topology::straight)
        continue;
      const auto &curve = topology_.curves[static_cast<std::size_t>(edge.curve)];
      curves[k] = edge.lower == cell.vertices[k] ? curve : curve.reversed();
      sides[k] = &curves[k];
    }
    const auto centre = static_cast<unsigned>(fine_.vertices.size());
    fine_.vertices.push_back(blend(corners, sides, {.5, .5}));
    for (unsigned k = 0; k < 4; ++k)
      fine_.cells.push_back({{cell.vertices[k], m[k], centre, m[(k + 3) % 4]}, 4, cell.region});
  }

  void divide_curves() {
    std::vector<char> on_boundary(topology_.edges.size(), 0);
    for (const auto &side : topology_.boundary)
      on_boundary[topology_.edge_of_side[4 * std::size_t{side.cell} + side.side]] = 1;
    for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
      const auto &edge = topology_.edges[e];
      if (edge.curve == Topology::straight)
        continue;
      const auto &curve = topology_.curves[static_cast<std::size_t>(edge.curve)];
      const auto middle = static_cast<unsigned>(mesh_.vertices.size() + e);
      if (curve.kind == Curve::Kind::parabola) {
        fine_.curved_edges.push_back({{edge.lower, middle}, curve.at(.25)});
        fine_.curved_edges.push_back({{middle, edge.upper}, curve.at(.75)});
      } else if (on_boundary[e] == 0)
        for (const unsigned end : {edge.lower, edge.upper})
          fine_.interior_arcs.push_back({{end, middle}, curve.control});
    }
  }

  const PlaneMesh &mesh_;
  Topology topology_;
  PlaneMesh fine_;
};
} // namespace

PlaneMesh refine(const PlaneMesh &mesh) { return Refinement(mesh).run(); }

PlaneMesh split_into_triangles(const PlaneMesh &mesh) {
  PlaneMesh result = mesh;
  result.cells.clear();
  for (const auto &cell : mesh.cells) {
    const auto &v = cell.vertices;
    result.cells.push_back({{v[0], v[1], v[2]}, 3, cell.region});
    if (cell.n_vertices == 4)
      result.cells.push_back({{v[0], v[2], v[3]}, 3, cell.region});
  }
  return result;
}
} // namespace fem_reference::mesh
