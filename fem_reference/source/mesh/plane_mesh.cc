#include "topology.h"

#include "fem_reference/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace fem_reference::mesh {
void check_vertices(const PlaneMesh &mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!std::isfinite(mesh.vertices[i][0]) || !std::isfinite(mesh.vertices[i][1]))
      throw InvalidInput(
          fmt::format("mesh: vertex {} at ({}, {}) is not finite", i, mesh.vertices[i][0], mesh.vertices[i][1]));

  std::vector<unsigned> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  // A grid numbered row by row is nearly sorted by (x2, x1) already.
  const auto before = [&](unsigned i, unsigned j) {
    const auto &a = mesh.vertices[i];
    const auto &b = mesh.vertices[j];
    return a[1] != b[1] ? a[1] < b[1] : (a[0] != b[0] ? a[0] < b[0] : i < j);
  };
  if (!std::is_sorted(order.begin(), order.end(), before))
    std::sort(order.begin(), order.end(), before);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (mesh.vertices[order[k - 1]] == mesh.vertices[order[k]])
      throw InvalidInput(fmt::format("mesh: vertices {} and {} coincide at ({}, {}); merge them", order[k - 1],
                                     order[k], mesh.vertices[order[k]][0], mesh.vertices[order[k]][1]));
}

namespace {
/// Twice the signed area of the triangle (previous, corner, next) over the product of its two
/// sides: the sine of the angle at the corner.
double sine_of_corner(Point previous, Point corner, Point next) {
  const Point a = {next[0] - corner[0], next[1] - corner[1]};
  const Point b = {previous[0] - corner[0], previous[1] - corner[1]};
  return (a[0] * b[1] - a[1] * b[0]) / (std::hypot(a[0], a[1]) * std::hypot(b[0], b[1]));
}

/// The Jacobian of the bilinear map is linear along both axes, so positive corners suffice. An
/// angle within 1e-6 of 0 or pi leaves too few digits in the gradients to be useful.
void check_corners(const PlaneMesh &mesh, std::size_t c) {
  constexpr double smallest_sine = 1e-6;
  const auto cell = mesh.cells[c].corners();
  const std::size_t n = cell.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto &corner = mesh.vertices[cell[k]];
    const double sine = sine_of_corner(mesh.vertices[cell[(k + n - 1) % n]], corner, mesh.vertices[cell[(k + 1) % n]]);
    if (!(sine > smallest_sine))
      throw InvalidInput(fmt::format("mesh: cell {} is inverted, degenerate or not convex at its corner {} "
                                     "(vertex {} at ({}, {})): the sine of the angle there is {:.3g}, expected > {}; "
                                     "the vertices of a cell must run counter-clockwise",
                                     c, k, cell[k], corner[0], corner[1], sine, smallest_sine));
  }
}
} // namespace

void check_cells(const PlaneMesh &mesh) {
  if (mesh.cells.empty())
    throw InvalidInput("mesh: there are no cells");

  std::vector<char> used(mesh.vertices.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto &cell = mesh.cells[c];
    if (cell.n_vertices != 3 && cell.n_vertices != 4)
      throw InvalidInput(fmt::format("mesh: cell {} has {} vertices; there are triangles (3) and quadrilaterals (4)", c,
                                     cell.n_vertices));
    if (cell.region < 0)
      throw InvalidInput(fmt::format("mesh: cell {} has the region {}; regions count from 0", c, cell.region));
    for (const unsigned v : cell.corners()) {
      if (v >= mesh.vertices.size())
        throw InvalidInput(fmt::format("mesh: cell {} refers to vertex {}, but there are only {} vertices", c, v,
                                       mesh.vertices.size()));
      used[v] = 1;
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
    throw InvalidInput(fmt::format("mesh: vertex {} belongs to no cell; remove it", unused - used.begin()));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    check_corners(mesh, c);
}

std::vector<CellSide> check(const PlaneMesh &mesh) { return checked_topology(mesh).boundary; }
} // namespace fem_reference::mesh
