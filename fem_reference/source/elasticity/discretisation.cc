#include "discretisation.h"

#include "../stopwatch.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

namespace fem_reference::elasticity {
namespace {
/// Centre of the bounding box, and its longer side.
void set_origin(const mesh::QuadrilateralMesh &mesh, Discretisation &discretisation) {
  mesh::Point lower = mesh.vertices.front();
  mesh::Point upper = lower;
  for (const auto &vertex : mesh.vertices)
    for (std::size_t d = 0; d < 2; ++d) {
      lower[d] = std::min(lower[d], vertex[d]);
      upper[d] = std::max(upper[d], vertex[d]);
    }
  for (std::size_t d = 0; d < 2; ++d)
    discretisation.origin[d] = lower[d] + .5 * (upper[d] - lower[d]);
  discretisation.extent = std::max(upper[0] - lower[0], upper[1] - lower[1]);
}

void create_triangulation(const mesh::QuadrilateralMesh &mesh, mesh::Point origin,
                          dealii::Triangulation<2> &triangulation) {
  std::vector<dealii::Point<2>> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const auto &vertex : mesh.vertices)
    vertices.emplace_back(vertex[0] - origin[0], vertex[1] - origin[1]);
  std::vector<dealii::CellData<2>> cells(mesh.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto &v = mesh.cells[c];
    cells[c].vertices = {v[0], v[1], v[3], v[2]}; // deal.II counts lexicographically
  }
  // Nodes inside an edge need one direction for both of its cells.
  dealii::GridTools::consistently_order_cells(cells);
  triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
}

/// The side of the (perhaps rotated) deal.II cell between two vertices of the mesh.
template <typename Cell>
unsigned side_between(const Cell &cell, std::array<unsigned, 2> vertices) {
  static constexpr std::array<std::array<unsigned, 2>, 4> ends = {{{0, 2}, {1, 3}, {0, 1}, {2, 3}}};
  for (unsigned side = 0; side < 4; ++side) {
    const unsigned a = cell->vertex_index(ends[side][0]);
    const unsigned b = cell->vertex_index(ends[side][1]);
    if ((a == vertices[0] && b == vertices[1]) || (a == vertices[1] && b == vertices[0]))
      return side;
  }
  throw std::logic_error("fem_reference: a checked boundary edge is not a side of its cell");
}

void number_nodes(const dealii::Triangulation<2> &triangulation, Discretisation &discretisation) {
  const auto degree = static_cast<unsigned>(discretisation.degree);
  const dealii::FE_Q<2> fe(degree);
  // One scalar handler serves both components: unknown = 2 node + component.
  dealii::DoFHandler<2> handler(triangulation);
  handler.distribute_dofs(fe);
  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<2>(degree);

  discretisation.nodes_per_cell = fe.n_dofs_per_cell();
  discretisation.cell_nodes.resize(discretisation.n_cells * fe.n_dofs_per_cell());
  discretisation.positions.resize(handler.n_dofs());
  std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
  std::vector<dealii::Point<2>> unit_points;
  for (const unsigned k : hierarchic)
    unit_points.push_back(fe.unit_support_point(k));
  for (const auto &cell : handler.active_cell_iterators()) {
    cell->get_dof_indices(indices);
    unsigned *nodes = discretisation.cell_nodes.data() + std::size_t{cell->active_cell_index()} * indices.size();
    for (std::size_t a = 0; a < indices.size(); ++a) {
      nodes[a] = static_cast<unsigned>(indices[hierarchic[a]]);
      const auto x = unit_points[a][0];
      const auto y = unit_points[a][1];
      // Sides are straight: the mapping of any degree is the bilinear one.
      auto position = (1 - x) * ((1 - y) * cell->vertex(0) + y * cell->vertex(2)) +
                      x * ((1 - y) * cell->vertex(1) + y * cell->vertex(3));
      discretisation.positions[nodes[a]] = {position[0], position[1]};
    }
  }
}
} // namespace

Discretisation discretise(const mesh::QuadrilateralMesh &mesh, int degree, double &seconds_mesh,
                          double &seconds_numbering) {
  Stopwatch stopwatch;
  const auto sides = mesh::check(mesh);
  Discretisation discretisation;
  discretisation.degree = degree;
  discretisation.n_cells = mesh.cells.size();
  set_origin(mesh, discretisation);
  dealii::Triangulation<2> triangulation;
  create_triangulation(mesh, discretisation.origin, triangulation);
  std::vector<dealii::Triangulation<2>::cell_iterator> cells(triangulation.begin(), triangulation.end());
  for (std::size_t e = 0; e < sides.size(); ++e)
    discretisation.edges.push_back(
        {sides[e].cell, side_between(cells[sides[e].cell], mesh.boundary[e].vertices), mesh.boundary[e].id});
  seconds_mesh = stopwatch.lap();
  number_nodes(triangulation, discretisation);
  seconds_numbering = stopwatch.lap();
  return discretisation;
}
} // namespace fem_reference::elasticity
