#include "fem_reference/mesh/quadrilateral_mesh.h"

#include "fem_reference/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace fem_reference::mesh {
namespace {
void check_vertices(const QuadrilateralMesh &mesh) {
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

/// Twice the signed area of the triangle (previous, corner, next) over the product of its two
/// sides: the sine of the angle at the corner.
double sine_of_corner(Point previous, Point corner, Point next) {
  const Point a = {next[0] - corner[0], next[1] - corner[1]};
  const Point b = {previous[0] - corner[0], previous[1] - corner[1]};
  return (a[0] * b[1] - a[1] * b[0]) / (std::hypot(a[0], a[1]) * std::hypot(b[0], b[1]));
}

void check_cells(const QuadrilateralMesh &mesh) {
  if (mesh.cells.empty())
    throw InvalidInput("mesh: there are no cells");

  std::vector<char> used(mesh.vertices.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const unsigned v : mesh.cells[c]) {
      if (v >= mesh.vertices.size())
        throw InvalidInput(fmt::format("mesh: cell {} refers to vertex {}, but there are only {} vertices", c, v,
                                       mesh.vertices.size()));
      used[v] = 1;
    }

  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
    throw InvalidInput(fmt::format("mesh: vertex {} belongs to no cell; remove it", unused - used.begin()));

  // The Jacobian of the bilinear map is linear along both axes, so positive corners suffice. An
  // angle within 1e-6 of 0 or pi leaves too few digits in the gradients to be useful.
  constexpr double smallest_sine = 1e-6;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (unsigned k = 0; k < 4; ++k) {
      const auto &cell = mesh.cells[c];
      const double sine =
          sine_of_corner(mesh.vertices[cell[(k + 3) % 4]], mesh.vertices[cell[k]], mesh.vertices[cell[(k + 1) % 4]]);
      if (!(sine > smallest_sine))
        throw InvalidInput(fmt::format("mesh: cell {} is inverted, degenerate or not convex at its corner {} "
                                       "(vertex {} at ({}, {})): the sine of the angle there is {:.3g}, expected > {}; "
                                       "the vertices of a cell must run counter-clockwise",
                                       c, k, cell[k], mesh.vertices[cell[k]][0], mesh.vertices[cell[k]][1], sine,
                                       smallest_sine));
    }
}

/// All sides of all cells, grouped by their lower vertex.
class SideTable {
public:
  struct Side {
    unsigned upper;
    unsigned cell;
    unsigned side;
    bool forward; // from the lower to the higher vertex
  };

  explicit SideTable(const QuadrilateralMesh &mesh)
      : start_(mesh.vertices.size() + 1, 0), sides_(4 * mesh.cells.size()) {
    for (const auto &cell : mesh.cells)
      for (unsigned k = 0; k < 4; ++k)
        ++start_[std::min(cell[k], cell[(k + 1) % 4]) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<unsigned> next(start_.begin(), start_.end() - 1);
    for (unsigned c = 0; c < mesh.cells.size(); ++c)
      for (unsigned k = 0; k < 4; ++k) {
        const unsigned from = mesh.cells[c][k];
        const unsigned to = mesh.cells[c][(k + 1) % 4];
        sides_[next[std::min(from, to)]++] = {std::max(from, to), c, k, from < to};
      }
    for (std::size_t v = 0; v + 1 < start_.size(); ++v)
      std::sort(sides_.begin() + start_[v], sides_.begin() + start_[v + 1],
                [](auto &a, auto &b) { return a.upper != b.upper ? a.upper < b.upper : a.cell < b.cell; });
  }

  std::size_t n_sides() const { return sides_.size(); }

  /// The sides between two vertices: none, one (boundary) or two (interior) in a valid mesh.
  std::span<const Side> between(unsigned lower, unsigned upper) const {
    const auto *begin = sides_.data() + start_[lower];
    const auto *end = sides_.data() + start_[lower + 1];
    while (begin != end && begin->upper < upper)
      ++begin;
    const auto *last = begin;
    while (last != end && last->upper == upper)
      ++last;
    return {begin, last};
  }

  /// Call `function(lower, upper, sides)` for every edge.
  template <typename Function>
  void for_each_edge(const Function &function) const {
    for (unsigned v = 0; v + 1 < start_.size(); ++v)
      for (unsigned k = start_[v]; k < start_[v + 1];) {
        const auto sides = between(v, sides_[k].upper);
        function(v, sides_[k].upper, sides);
        k += static_cast<unsigned>(sides.size());
      }
  }

private:
  std::vector<unsigned> start_;
  std::vector<Side> sides_;
};

void check_edges(const SideTable &table) {
  table.for_each_edge([](unsigned lower, unsigned upper, std::span<const SideTable::Side> sides) {
    if (sides.size() > 2)
      throw InvalidInput(fmt::format("mesh: the edge between vertices {} and {} belongs to {} cells ({}, {}, {}, ...); "
                                     "at most 2 are possible",
                                     lower, upper, sides.size(), sides[0].cell, sides[1].cell, sides[2].cell));
    if (sides.size() == 2 && sides[0].forward == sides[1].forward)
      throw InvalidInput(
          fmt::format("mesh: cells {} and {} lie on the same side of their common edge ({}, {}): they overlap",
                      sides[0].cell, sides[1].cell, lower, upper));
  });
}

/// Locate the listed boundary edges; refuse what is listed twice, inside, or missing.
std::vector<CellSide> locate_boundary(const QuadrilateralMesh &mesh, const SideTable &table) {
  std::vector<CellSide> location;
  location.reserve(mesh.boundary.size());
  std::vector<char> listed(4 * mesh.cells.size(), 0);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e) {
    const auto [a, b] = mesh.boundary[e].vertices;
    const auto describe = [&] {
      return fmt::format("mesh: boundary edge {} (vertices {} and {}, id {})", e, a, b, mesh.boundary[e].id);
    };
    if (mesh.boundary[e].id < 0)
      throw InvalidInput(describe() + " has a negative id");
    if (std::max(a, b) >= mesh.vertices.size())
      throw InvalidInput(describe() +
                         fmt::format(" refers to a vertex that does not exist; there are {}", mesh.vertices.size()));
    const auto sides = table.between(std::min(a, b), std::max(a, b));
    if (sides.empty())
      throw InvalidInput(describe() + " is not a side of any cell");
    if (sides.size() == 2)
      throw InvalidInput(describe() +
                         fmt::format(" lies inside, between cells {} and {}", sides[0].cell, sides[1].cell));
    auto &mark = listed[4 * sides[0].cell + sides[0].side];
    if (mark != 0)
      throw InvalidInput(describe() + " is listed twice");
    mark = 1;
    location.push_back({sides[0].cell, sides[0].side});
  }

  table.for_each_edge([&](unsigned lower, unsigned upper, std::span<const SideTable::Side> sides) {
    if (sides.size() == 1 && listed[4 * sides[0].cell + sides[0].side] == 0)
      throw InvalidInput(fmt::format("mesh: the boundary edge between vertices {} and {} (cell {}) has no "
                                     "boundary id; list it in `boundary`",
                                     lower, upper, sides[0].cell));
  });
  return location;
}
} // namespace

std::vector<CellSide> check(const QuadrilateralMesh &mesh) {
  check_vertices(mesh);
  check_cells(mesh);
  const SideTable table(mesh);
  check_edges(table);
  return locate_boundary(mesh, table);
}

namespace {
/// Cells and boundary of a grid of vertices numbered row by row.
QuadrilateralMesh grid_topology(unsigned vertices_x, unsigned vertices_y) {
  if (vertices_x < 2 || vertices_y < 2)
    throw InvalidInput(fmt::format("rectangle: {} x {} vertices; at least 2 x 2 are needed", vertices_x, vertices_y));
  QuadrilateralMesh mesh;
  const auto vertex = [vertices_x](unsigned i, unsigned j) { return j * vertices_x + i; };
  mesh.cells.reserve(std::size_t{vertices_x - 1} * (vertices_y - 1));
  for (unsigned j = 0; j + 1 < vertices_y; ++j)
    for (unsigned i = 0; i + 1 < vertices_x; ++i)
      mesh.cells.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
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
} // namespace

QuadrilateralMesh rectangle(Point lower, Point upper, unsigned vertices_x, unsigned vertices_y) {
  if (!(upper[0] > lower[0]) || !(upper[1] > lower[1]))
    throw InvalidInput(fmt::format("rectangle: the upper corner ({}, {}) must lie above and to the right "
                                   "of the lower corner ({}, {})",
                                   upper[0], upper[1], lower[0], lower[1]));
  QuadrilateralMesh mesh = grid_topology(vertices_x, vertices_y);
  mesh.vertices.reserve(std::size_t{vertices_x} * vertices_y);
  for (unsigned j = 0; j < vertices_y; ++j)
    for (unsigned i = 0; i < vertices_x; ++i)
      mesh.vertices.push_back({std::lerp(lower[0], upper[0], static_cast<double>(i) / (vertices_x - 1)),
                               std::lerp(lower[1], upper[1], static_cast<double>(j) / (vertices_y - 1))});
  return mesh;
}

QuadrilateralMesh rectangle(std::span<const Point> vertices, unsigned vertices_x, unsigned vertices_y) {
  QuadrilateralMesh mesh = grid_topology(vertices_x, vertices_y);
  if (vertices.size() != std::size_t{vertices_x} * vertices_y)
    throw InvalidInput(fmt::format("rectangle: {} vertex positions were given for a grid of {} x {}", vertices.size(),
                                   vertices_x, vertices_y));
  mesh.vertices.assign(vertices.begin(), vertices.end());
  check_vertices(mesh);
  check_cells(mesh);
  return mesh;
}
} // namespace fem_reference::mesh
