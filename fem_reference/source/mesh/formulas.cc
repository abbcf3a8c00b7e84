#include "fem_reference/mesh/formulas.h"

#include "topology.h"

#include "fem_reference/errors.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace fem_reference::mesh {
namespace {
/// Quadrilaterals of a grid of vertices numbered row by row.
void add_grid_cells(unsigned vertices_x, unsigned vertices_y, PlaneMesh &mesh) {
  mesh.cells.reserve(std::size_t{vertices_x - 1} * (vertices_y - 1));
  for (unsigned j = 0; j + 1 < vertices_y; ++j)
    for (unsigned i = 0; i + 1 < vertices_x; ++i) {
      const unsigned v = j * vertices_x + i;
      mesh.cells.push_back({{v, v + 1, v + vertices_x + 1, v + vertices_x}});
    }
}

PlaneMesh rectangle_topology(unsigned vertices_x, unsigned vertices_y) {
  if (vertices_x < 2 || vertices_y < 2)
    throw InvalidInput(fmt::format("rectangle: {} x {} vertices; at least 2 x 2 are needed", vertices_x, vertices_y));
  PlaneMesh mesh;
  add_grid_cells(vertices_x, vertices_y, mesh);
  const auto vertex = [vertices_x](unsigned i, unsigned j) { return j * vertices_x + i; };
  const unsigned right = vertices_x - 1;
  const unsigned top = vertices_y - 1;
  for (unsigned j = 0; j < top; ++j) {
    mesh.boundary.push_back({{vertex(0, j), vertex(0, j + 1)}, 0});
    mesh.boundary.push_back({{vertex(right, j), vertex(right, j + 1)}, 1});
  }
  for (unsigned i = 0; i < right; ++i) {
    mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, 2});
    mesh.boundary.push_back({{vertex(i, top), vertex(i + 1, top)}, 3});
  }
  return mesh;
}

/// cos and sin without rounding on the axes, so that ends of a quarter lie on them.
Point direction(double angle) {
  if (angle == .5 * std::numbers::pi)
    return {0, 1};
  return {std::cos(angle), std::sin(angle)};
}
} // namespace

PlaneMesh rectangle(Point lower, Point upper, unsigned vertices_x, unsigned vertices_y) {
  if (!(upper[0] > lower[0]) || !(upper[1] > lower[1]))
    throw InvalidInput(fmt::format("rectangle: the upper corner ({}, {}) must lie above and to the right "
                                   "of the lower corner ({}, {})",
                                   upper[0], upper[1], lower[0], lower[1]));
  PlaneMesh mesh = rectangle_topology(vertices_x, vertices_y);
  mesh.vertices.reserve(std::size_t{vertices_x} * vertices_y);
  for (unsigned j = 0; j < vertices_y; ++j)
    for (unsigned i = 0; i < vertices_x; ++i)
      mesh.vertices.push_back({std::lerp(lower[0], upper[0], static_cast<double>(i) / (vertices_x - 1)),
                               std::lerp(lower[1], upper[1], static_cast<double>(j) / (vertices_y - 1))});
  return mesh;
}

PlaneMesh rectangle(std::span<const Point> vertices, unsigned vertices_x, unsigned vertices_y) {
  PlaneMesh mesh = rectangle_topology(vertices_x, vertices_y);
  if (vertices.size() != std::size_t{vertices_x} * vertices_y)
    throw InvalidInput(fmt::format("rectangle: {} vertex positions were given for a grid of {} x {}", vertices.size(),
                                   vertices_x, vertices_y));
  mesh.vertices.assign(vertices.begin(), vertices.end());
  check_vertices(mesh);
  check_cells(mesh);
  return mesh;
}

PlaneMesh quarter_plate_with_hole(double radius, double half_width, unsigned n_around, unsigned n_outwards,
                                  double grading) {
  if (!(radius > 0) || !(half_width > radius) || !std::isfinite(half_width))
    throw InvalidInput(fmt::format("quarter_plate_with_hole: radius {} m and half width {} m; expected 0 < radius < "
                                   "half width",
                                   radius, half_width));
  if (n_around < 1 || n_outwards < 1)
    throw InvalidInput(
        fmt::format("quarter_plate_with_hole: {} x {} cells a block; at least 1 x 1 is needed", n_around, n_outwards));
  if (!(grading > 0) || !std::isfinite(grading))
    throw InvalidInput(fmt::format("quarter_plate_with_hole: the grading is {}, expected a finite value > 0", grading));
  const unsigned n = 2 * n_around;
  PlaneMesh mesh;
  // Rows run from the top (clockwise) to the right, so that outwards is counter-clockwise of along.
  add_grid_cells(n + 1, n_outwards + 1, mesh);
  for (unsigned j = 0; j <= n_outwards; ++j) {
    const double s = static_cast<double>(j) / n_outwards;
    const double rho = grading == 1 ? s : std::expm1(s * std::log(grading)) / (grading - 1);
    for (unsigned i = 0; i <= n; ++i) {
      const unsigned k = n - i;
      const Point unit = direction(k == n ? .5 * std::numbers::pi : .5 * std::numbers::pi * k / n);
      const double fraction = static_cast<double>(k <= n_around ? k : n - k) / n_around;
      const double along = .5 * half_width * (fraction + std::tan(.25 * std::numbers::pi * fraction));
      const Point side = k <= n_around ? Point{half_width, along} : Point{along, half_width};
      mesh.vertices.push_back({std::lerp(radius * unit[0], side[0], rho), std::lerp(radius * unit[1], side[1], rho)});
    }
  }
  const auto vertex = [n](unsigned i, unsigned j) { return j * (n + 1) + i; };
  for (unsigned j = 0; j < n_outwards; ++j) {
    mesh.boundary.push_back({{vertex(0, j), vertex(0, j + 1)}, 0});
    mesh.boundary.push_back({{vertex(n, j), vertex(n, j + 1)}, 1});
  }
  for (unsigned i = 0; i < n; ++i) {
    mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, 4, Point{0, 0}});
    mesh.boundary.push_back({{vertex(i, n_outwards), vertex(i + 1, n_outwards)}, i < n_around ? 3 : 2});
  }
  return mesh;
}

PlaneMesh ring_sector(double inner_radius, std::span<const RingLayer> layers, unsigned n_around, double angle) {
  if (!(angle > 0) || !(angle < 2 * std::numbers::pi) || n_around < 1 || !(angle / n_around < 3.14))
    throw InvalidInput(
        fmt::format("ring_sector: {} cells over an angle of {}; expected an angle between 0 and 2 pi, and "
                    "less than half a turn a cell",
                    n_around, angle));
  if (layers.empty())
    throw InvalidInput("ring_sector: there are no layers");
  std::vector<double> radii = {inner_radius};
  std::vector<unsigned> region_from; // of the row of cells above each radius
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const double from = radii.back();
    const double to = layers[l].outer_radius;
    if (!(from > 0) || !(to > from) || !std::isfinite(to) || layers[l].n_cells < 1)
      throw InvalidInput(fmt::format("ring_sector: layer {} goes from radius {} to {} in {} cells; expected growing "
                                     "positive radii and at least one cell",
                                     l, from, to, layers[l].n_cells));
    for (unsigned j = 1; j <= layers[l].n_cells; ++j) {
      radii.push_back(std::lerp(from, to, static_cast<double>(j) / layers[l].n_cells));
      region_from.push_back(static_cast<unsigned>(l));
    }
  }
  const auto n_outwards = static_cast<unsigned>(radii.size() - 1);
  const unsigned columns = n_outwards + 1;
  PlaneMesh mesh;
  add_grid_cells(columns, n_around + 1, mesh); // outwards first: counter-clockwise
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    mesh.cells[c].region = static_cast<int>(region_from[c % n_outwards]);
  for (unsigned i = 0; i <= n_around; ++i) {
    const Point unit = direction(i == n_around ? angle : angle * i / n_around);
    for (const double r : radii)
      mesh.vertices.push_back({r * unit[0], r * unit[1]});
  }
  for (unsigned i = 0; i < n_around; ++i)
    for (unsigned j = 0; j < columns; ++j) {
      const std::array<unsigned, 2> ends = {i * columns + j, (i + 1) * columns + j};
      if (j == 0 || j == n_outwards)
        mesh.boundary.push_back({ends, j == 0 ? 0 : 1, Point{0, 0}});
      else
        mesh.interior_arcs.push_back({ends, {0, 0}});
    }
  for (unsigned j = 0; j < n_outwards; ++j) {
    mesh.boundary.push_back({{j, j + 1}, 2});
    mesh.boundary.push_back({{n_around * columns + j, n_around * columns + j + 1}, 3});
  }
  return mesh;
}
} // namespace fem_reference::mesh
