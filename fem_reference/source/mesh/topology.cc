#include "topology.h"

#include "fem_reference/errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <fmt/format.h>

namespace fem_reference::mesh {
namespace {
/// All sides of all cells, grouped by their lower vertex.
class SideTable {
public:
  struct Side {
    unsigned upper;
    unsigned cell;
    unsigned side;
    bool forward; // from the lower to the higher vertex
  };

  explicit SideTable(const PlaneMesh &mesh) : start_(mesh.vertices.size() + 1, 0) {
    const auto for_each_side = [&](const auto &function) {
      for (unsigned c = 0; c < mesh.cells.size(); ++c) {
        const auto corners = mesh.cells[c].corners();
        for (unsigned k = 0; k < corners.size(); ++k)
          function(c, k, corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
      }
    };
    for_each_side([&](unsigned, unsigned, unsigned from, unsigned to) { ++start_[std::min(from, to) + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    sides_.resize(start_.back());
    std::vector<unsigned> next(start_.begin(), start_.end() - 1);
    for_each_side([&](unsigned c, unsigned k, unsigned from, unsigned to) {
      sides_[next[std::min(from, to)]++] = {std::max(from, to), c, k, from < to};
    });
    for (std::size_t v = 0; v + 1 < start_.size(); ++v)
      std::sort(sides_.begin() + start_[v], sides_.begin() + start_[v + 1],
                [](auto &a, auto &b) { return a.upper != b.upper ? a.upper < b.upper : a.cell < b.cell; });
  }

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

void check_edge(unsigned lower, unsigned upper, std::span<const SideTable::Side> sides) {
  if (sides.size() > 2)
    throw InvalidInput(fmt::format("mesh: the edge between vertices {} and {} belongs to {} cells ({}, {}, {}, ...); "
                                   "at most 2 are possible",
                                   lower, upper, sides.size(), sides[0].cell, sides[1].cell, sides[2].cell));
  if (sides.size() == 2 && sides[0].forward == sides[1].forward)
    throw InvalidInput(fmt::format("mesh: cells {} and {} lie on the same side of their common edge ({}, {}): they "
                                   "overlap",
                                   sides[0].cell, sides[1].cell, lower, upper));
}

/// The sides of the cells between two vertices that the caller names; refuses vertices without an edge.
std::span<const SideTable::Side> sides_of(const PlaneMesh &mesh, const SideTable &table,
                                          std::array<unsigned, 2> vertices, const std::string &what) {
  const auto [lower, upper] = std::minmax(vertices[0], vertices[1]);
  if (upper >= mesh.vertices.size())
    throw InvalidInput(
        fmt::format("mesh: {} refers to a vertex that does not exist; there are {}", what, mesh.vertices.size()));
  const auto sides = table.between(lower, upper);
  if (sides.empty())
    throw InvalidInput(fmt::format("mesh: {} is not a side of any cell", what));
  return sides;
}

std::string describe(const BoundaryEdge &edge, std::size_t e) {
  return fmt::format("boundary edge {} (vertices {} and {}, id {})", e, edge.vertices[0], edge.vertices[1], edge.id);
}

/// Locate the listed boundary edges; refuse what is listed twice, inside, or missing.
std::vector<CellSide> locate_boundary(const PlaneMesh &mesh, const SideTable &table) {
  std::vector<CellSide> location;
  location.reserve(mesh.boundary.size());
  std::vector<char> listed(4 * mesh.cells.size(), 0);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e) {
    const auto what = describe(mesh.boundary[e], e);
    if (mesh.boundary[e].id < 0)
      throw InvalidInput(fmt::format("mesh: {} has a negative id", what));
    const auto sides = sides_of(mesh, table, mesh.boundary[e].vertices, what);
    if (sides.size() == 2)
      throw InvalidInput(
          fmt::format("mesh: {} lies inside, between cells {} and {}", what, sides[0].cell, sides[1].cell));
    auto &mark = listed[4 * sides[0].cell + sides[0].side];
    if (mark != 0)
      throw InvalidInput(fmt::format("mesh: {} is listed twice", what));
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

void check_arc(const Curve &arc, const std::string &what) {
  const Point from = {arc.begin[0] - arc.control[0], arc.begin[1] - arc.control[1]};
  const Point to = {arc.end[0] - arc.control[0], arc.end[1] - arc.control[1]};
  const double radius_0 = std::hypot(from[0], from[1]);
  const double radius_1 = std::hypot(to[0], to[1]);
  // Mesh files print seven digits or more.
  constexpr double tolerance = 1e-6;
  if (!(std::min(radius_0, radius_1) > 0) || !(std::abs(radius_0 - radius_1) <= tolerance * radius_1))
    throw InvalidInput(fmt::format("mesh: the ends of {} are {} m and {} m away from its centre ({}, {}); an arc needs "
                                   "one radius, positive and finite",
                                   what, radius_0, radius_1, arc.control[0], arc.control[1]));
  const double angle = std::atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
  if (std::abs(angle) > std::numbers::pi - tolerance)
    throw InvalidInput(fmt::format("mesh: the ends of {} lie opposite each other as seen from its centre ({}, {}), so "
                                   "that neither arc is the shorter one; split the edge",
                                   what, arc.control[0], arc.control[1]));
}

/// Gives edges their curves.
class CurveList {
public:
  CurveList(const PlaneMesh &mesh, const SideTable &table, Topology &topology)
      : mesh_(mesh), table_(table), topology_(topology) {}

  void add(std::array<unsigned, 2> vertices, Curve::Kind kind, Point control, bool must_be_inside,
           const std::string &what) {
    const auto sides = sides_of(mesh_, table_, vertices, what);
    if (must_be_inside && sides.size() == 1)
      throw InvalidInput(fmt::format("mesh: {} lies on the boundary; give the centre to its boundary edge", what));
    auto &edge = topology_.edges[topology_.edge_of_side[4 * sides[0].cell + sides[0].side]];
    if (edge.curve != Topology::straight)
      throw InvalidInput(fmt::format("mesh: {} is curved already; give one arc or one midpoint to an edge", what));
    if (!std::isfinite(control[0]) || !std::isfinite(control[1]))
      throw InvalidInput(fmt::format("mesh: the {} of {} is ({}, {}), which is not finite",
                                     kind == Curve::Kind::arc ? "centre" : "midpoint", what, control[0], control[1]));
    const Curve curve = {kind, mesh_.vertices[edge.lower], mesh_.vertices[edge.upper], control};
    if (kind == Curve::Kind::arc)
      check_arc(curve, what);
    edge.curve = static_cast<int>(topology_.curves.size());
    topology_.curves.push_back(curve);
  }

private:
  const PlaneMesh &mesh_;
  const SideTable &table_;
  Topology &topology_;
};

void add_curves(const PlaneMesh &mesh, const SideTable &table, Topology &topology) {
  CurveList list(mesh, table, topology);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    if (const auto &edge = mesh.boundary[e]; edge.arc_centre)
      list.add(edge.vertices, Curve::Kind::arc, *edge.arc_centre, false, describe(edge, e));
  for (std::size_t e = 0; e < mesh.interior_arcs.size(); ++e) {
    const auto &[vertices, centre] = mesh.interior_arcs[e];
    list.add(vertices, Curve::Kind::arc, centre, true,
             fmt::format("interior arc {} (vertices {} and {})", e, vertices[0], vertices[1]));
  }
  for (std::size_t e = 0; e < mesh.curved_edges.size(); ++e) {
    const auto &[vertices, midpoint] = mesh.curved_edges[e];
    list.add(vertices, Curve::Kind::parabola, midpoint, false,
             fmt::format("curved edge {} (vertices {} and {})", e, vertices[0], vertices[1]));
  }
}
} // namespace

Topology checked_topology(const PlaneMesh &mesh) {
  check_vertices(mesh);
  check_cells(mesh);
  const SideTable table(mesh);
  Topology topology;
  topology.edge_of_side.resize(4 * mesh.cells.size());
  table.for_each_edge([&](unsigned lower, unsigned upper, std::span<const SideTable::Side> sides) {
    check_edge(lower, upper, sides);
    for (const auto &side : sides)
      topology.edge_of_side[4 * std::size_t{side.cell} + side.side] = static_cast<unsigned>(topology.edges.size());
    topology.edges.push_back({lower, upper});
  });
  topology.boundary = locate_boundary(mesh, table);
  add_curves(mesh, table, topology);
  return topology;
}
} // namespace fem_reference::mesh
