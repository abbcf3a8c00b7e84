#include "comparisons/geometry/plane_geometry.h"

#include "comparisons/geometry/boundary_loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace comparisons::geometry {

namespace {

using problems::Point2;

constexpr int no_region = -1;

std::string at(const Point2 &p) { return fmt::format("({:.6g}, {:.6g})", p[0], p[1]); }

double cross(const Point2 &a, const Point2 &b, const Point2 &c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Findings of one kind: the first few in words, the rest counted.
class Few {
public:
  void add(std::string text) {
    if (texts_.size() < 4)
      texts_.push_back(std::move(text));
    ++n_;
  }
  std::size_t size() const { return n_; }
  std::string text() const {
    const std::string list = fmt::format("{}", fmt::join(texts_, "; "));
    return n_ > texts_.size() ? fmt::format("{}; and {} more", list, n_ - texts_.size()) : list;
  }

private:
  std::vector<std::string> texts_;
  std::size_t n_ = 0;
};

/// An edge between two vertices with what lies at it.
struct MeshEdge {
  std::vector<std::pair<unsigned, unsigned>> sides; ///< cell, side
  std::optional<std::uint32_t> midnode;
  std::set<int> groups; ///< of its line elements
};

class Builder {
public:
  Builder(const MeshFile &file, const WantedGroups &wanted, scene::Diagnostics &diagnostics)
      : file_(file), wanted_(wanted), diagnostics_(diagnostics) {}

  std::optional<PlaneGeometry> build() {
    // Each step needs what the one before it has found good.
    const auto steps = {&Builder::check_kinds, &Builder::check_plane,       &Builder::take_cells,
                        &Builder::check_nodes, &Builder::orient_cells,      &Builder::take_regions,
                        &Builder::take_edges,  &Builder::take_boundary_ids, &Builder::make_boundaries};
    for (const auto step : steps) {
      (this->*step)();
      if (failed_)
        return std::nullopt;
    }
    return std::move(result_);
  }

private:
  void error(std::string message, std::string suggestion = {}) {
    failed_ = true;
    diagnostics_.error({.file = file_.path.string()}, {}, std::move(message), std::move(suggestion));
  }
  void warning(std::string message, std::string suggestion = {}) {
    diagnostics_.warning({.file = file_.path.string()}, {}, std::move(message), std::move(suggestion));
  }

  const Entity &entity(const Element &element) const {
    return file_.entities[static_cast<std::size_t>(element.entity)];
  }
  std::uint32_t node(const Element &element, int k) const {
    return file_.element_nodes[element.first_node + static_cast<std::uint64_t>(k)];
  }
  const Point2 &corner(const problems::Mesh::Cell &cell, unsigned k) const {
    return result_.mesh.vertices[cell.vertices[k % cell.n_vertices]];
  }
  Point2 centre(const problems::Mesh::Cell &cell) const {
    Point2 sum{};
    for (unsigned k = 0; k < cell.n_vertices; ++k)
      for (std::size_t d = 0; d < 2; ++d)
        sum[d] += corner(cell, k)[d] / cell.n_vertices;
    return sum;
  }
  /// "cell 7 at (1, 2)", by its number in the file.
  std::string name_of(std::size_t cell) const {
    return fmt::format("cell {} at {}", cell_elements_[cell]->tag, at(centre(result_.mesh.cells[cell])));
  }

  void check_kinds() {
    Few unsupported;
    std::size_t n_cells = 0;
    for (const auto &element : file_.elements) {
      const int dimension = entity(element).dimension;
      if (dimension == 3)
        return error(fmt::format("a 3D mesh: element {} is a {}", element.tag, name_of_type(element.type)),
                     "mesh the plane drawing with Mesh, 2D");
      n_cells += dimension == 2 ? 1 : 0;
      const bool known = dimension == 1 ? element.type == 1 || element.type == 8
                                        : element.type == 2 || element.type == 3 || element.type == 9 ||
                                              element.type == 10 || element.type == 16;
      if (!known)
        unsupported.add(fmt::format("element {} is a {}", element.tag, name_of_type(element.type)));
    }
    if (n_cells == 0)
      return error("the mesh has no cells (triangles or quadrilaterals)",
                   "mesh the drawing with Mesh, 2D, and give a name to its surface (Physical Surface)");
    if (unsupported.size() > 0)
      return error(fmt::format("cells of a kind that is not taken: {}; allowed are triangles and quadrilaterals of "
                               "first or second order",
                               unsupported.text()),
                   "set Mesh.ElementOrder = 2 or 1");
    if (file_.groups.empty())
      error("the mesh has no physical groups, so there is nothing to give conditions to",
            "name curves and surfaces in the drawing: Physical Curve(\"clamp\") = {1}; Physical Surface(\"steel\") = "
            "{1};");
  }

  void check_plane() {
    std::set<std::uint32_t> used;
    for (const auto &element : file_.elements)
      if (entity(element).dimension == 2)
        for (int k = 0; k < element.n_nodes; ++k)
          used.insert(node(element, k));
    std::array<double, 3> lower = file_.nodes[*used.begin()];
    std::array<double, 3> upper = lower;
    for (const auto i : used)
      for (std::size_t d = 0; d < 3; ++d) {
        if (!std::isfinite(file_.nodes[i][d]))
          return error(fmt::format("node {} has a coordinate that is not finite", file_.node_tags[i]));
        lower[d] = std::min(lower[d], file_.nodes[i][d]);
        upper[d] = std::max(upper[d], file_.nodes[i][d]);
      }
    result_.lower = {lower[0], lower[1]};
    result_.upper = {upper[0], upper[1]};
    if (upper[2] - lower[2] > 1e-9 * result_.extent())
      error(fmt::format("a 3D mesh: z runs from {:.6g} to {:.6g} m; a plane domain has the same z throughout", lower[2],
                        upper[2]),
            "draw in the plane z = 0");
  }

  void take_cells() {
    for (const auto &element : file_.elements) {
      if (entity(element).dimension != 2)
        continue;
      problems::Mesh::Cell cell;
      cell.n_vertices = element.type == 2 || element.type == 9 ? 3 : 4;
      cell.vertices = {};
      for (unsigned k = 0; k < cell.n_vertices; ++k)
        cell.vertices[k] = vertex(node(element, static_cast<int>(k)));
      result_.second_order = result_.second_order || element.type > 3;
      result_.mesh.cells.push_back(cell);
      cell_elements_.push_back(&element);
    }
  }

  unsigned vertex(std::uint32_t node) {
    const auto [found, is_new] = vertex_of_node_.emplace(node, static_cast<unsigned>(result_.mesh.vertices.size()));
    if (is_new) {
      result_.mesh.vertices.push_back({file_.nodes[node][0], file_.nodes[node][1]});
      node_of_vertex_.push_back(node);
    }
    return found->second;
  }

  /// Vertices closer than 1e-9 of the domain are one node written twice: the mesh is torn there.
  void check_nodes() {
    const double cell_size = 1e-9 * result_.extent();
    const auto &vertices = result_.mesh.vertices;
    std::vector<unsigned> order(vertices.size());
    for (unsigned i = 0; i < order.size(); ++i)
      order[i] = i;
    std::ranges::sort(order, {}, [&](unsigned i) { return vertices[i]; });
    Few duplicates;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        const Point2 &a = vertices[order[i]];
        const Point2 &b = vertices[order[j]];
        if (b[0] - a[0] > cell_size)
          break;
        if (std::abs(b[1] - a[1]) <= cell_size)
          duplicates.add(fmt::format("nodes {} and {} at {}", file_.node_tags[node_of_vertex_[order[i]]],
                                     file_.node_tags[node_of_vertex_[order[j]]], at(a)));
      }
    if (duplicates.size() > 0)
      error("duplicate nodes: " + duplicates.text(),
            "in Gmsh: Coherence; in the drawing, or Mesh, Remove duplicate nodes");
  }

  /// Smallest and largest cross product at a corner, over the square of the longest side.
  std::pair<double, double> corner_range(const problems::Mesh::Cell &cell) const {
    double longest = 0;
    double least = 1e300;
    double most = -1e300;
    for (unsigned k = 0; k < cell.n_vertices; ++k) {
      const Point2 &a = corner(cell, k);
      const Point2 &b = corner(cell, k + 1);
      longest = std::max(longest, (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
      const double product = cross(a, b, corner(cell, k + 2));
      least = std::min(least, product);
      most = std::max(most, product);
    }
    return longest > 0 ? std::pair(least / longest, most / longest) : std::pair(0.0, 0.0);
  }

  void orient_cells() {
    // A surface of the drawing may be clockwise as a whole: its curves are then listed the other way round.
    constexpr double flat = 1e-9;
    std::map<int, std::array<std::size_t, 2>> counts; // by entity: counter-clockwise, clockwise
    Few degenerate;
    Few concave;
    auto &cells = result_.mesh.cells;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto [least, most] = corner_range(cells[c]);
      if (most < flat && least > -flat)
        degenerate.add(name_of(c));
      else if (least < flat && most > -flat)
        concave.add(name_of(c) + (std::abs(least) < flat || std::abs(most) < flat ? " (a corner of 180 degrees)" : ""));
      else
        ++counts[cell_elements_[c]->entity][most < 0 ? 1 : 0];
    }
    Few inverted;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto &[left, right] = counts[cell_elements_[c]->entity];
      const bool turn = right > left;
      const bool clockwise = corner_range(cells[c]).second < flat;
      if (clockwise != turn && left > 0 && right > 0)
        inverted.add(name_of(c));
      if (turn)
        std::reverse(cells[c].vertices.begin(), cells[c].vertices.begin() + cells[c].n_vertices);
    }
    if (degenerate.size() > 0)
      error("degenerate cells without area: " + degenerate.text(), "mesh the drawing again");
    if (concave.size() > 0)
      error("cells that are not convex: " + concave.text(), "mesh the drawing again");
    if (inverted.size() > 0 && !failed_)
      error("inverted cells (clockwise among counter-clockwise ones): " + inverted.text(), "mesh the drawing again");
    for (const auto &cell : cells)
      for (unsigned k = 1; k + 1 < cell.n_vertices; ++k)
        result_.area += 0.5 * cross(corner(cell, 0), corner(cell, k), corner(cell, k + 1));
  }

  void take_regions() {
    if (wanted_.regions.empty()) {
      result_.region_names = {""};
      return;
    }
    result_.region_names = wanted_.regions;
    std::map<std::string, std::size_t> without;
    Few twice;
    for (std::size_t c = 0; c < result_.mesh.cells.size(); ++c) {
      int &region = result_.mesh.cells[c].region;
      region = no_region;
      std::string groups;
      for (const int g : entity(*cell_elements_[c]).groups) {
        const auto &name = file_.groups[static_cast<std::size_t>(g)].name;
        groups += (groups.empty() ? "" : ", ") + name;
        const auto found = std::ranges::find(wanted_.regions, name);
        if (found == wanted_.regions.end())
          continue;
        if (region != no_region)
          twice.add(fmt::format("{} is in '{}' and '{}'", name_of(c), wanted_.regions[static_cast<std::size_t>(region)],
                                name));
        region = static_cast<int>(found - wanted_.regions.begin());
      }
      if (region == no_region)
        ++without[groups];
    }
    if (twice.size() > 0)
      error("regions overlap: " + twice.text(), "give each surface to one group with a material");
    for (const auto &[groups, n] : without)
      error(groups.empty() ? fmt::format("{} cells belong to no physical group", n)
                           : fmt::format("{} cells of the region '{}' have no material", n, groups),
            groups.empty() ? "add their surface to a Physical Surface"
                           : "add [[material]] with region = \"" + groups + "\"");
  }

  void take_edges() {
    auto &cells = result_.mesh.cells;
    Few many;
    for (unsigned c = 0; c < cells.size(); ++c) {
      const Element &element = *cell_elements_[c];
      const unsigned n = cells[c].n_vertices;
      for (unsigned k = 0; k < n; ++k) {
        auto &edge = edges_[key(cells[c].vertices[k], cells[c].vertices[(k + 1) % n])];
        for (const auto &[other, side] : edge.sides)
          if (cells[other].vertices[side] == cells[c].vertices[k])
            many.add(fmt::format("{} and {} lie on top of each other", name_of(other), name_of(c)));
        edge.sides.emplace_back(c, k);
        if (edge.sides.size() == 3)
          many.add(fmt::format("an edge of more than two cells at {}", at(corner(cells[c], k))));
        // The file's order of nodes, not that of the cell, which may have been turned around.
        if (element.n_nodes > static_cast<int>(n)) {
          const auto a = vertex_of_node_.at(node(element, static_cast<int>(k)));
          const auto b = vertex_of_node_.at(node(element, static_cast<int>((k + 1) % n)));
          edges_[key(a, b)].midnode = node(element, static_cast<int>(n + k));
        }
      }
    }
    if (many.size() > 0)
      return error("cells overlap: " + many.text(), "save the mesh of one drawing only, without duplicates");
    take_lines();
  }

  void take_lines() {
    std::map<int, std::size_t> stray;
    for (const auto &element : file_.elements) {
      if (entity(element).dimension != 1 || entity(element).groups.empty())
        continue;
      const auto a = vertex_of_node_.find(node(element, 0));
      const auto b = vertex_of_node_.find(node(element, 1));
      const auto edge = a == vertex_of_node_.end() || b == vertex_of_node_.end()
                            ? edges_.end()
                            : edges_.find(key(a->second, b->second));
      for (const int group : entity(element).groups)
        if (edge != edges_.end())
          edge->second.groups.insert(group);
        else
          ++stray[group];
    }
    for (const auto &[group, n] : stray) {
      const auto &name = file_.groups[static_cast<std::size_t>(group)].name;
      const std::string text = fmt::format("{} lines of the group '{}' are no sides of cells", n, name);
      if (std::ranges::find(wanted_.boundaries, name) != wanted_.boundaries.end())
        error(text, "mesh the surface together with its curves");
      else
        warning(text + "; they are ignored");
    }
  }

  /// The id of an edge: the wanted group, else the first; no value for a free edge.
  std::optional<int> group_of(const MeshEdge &edge, Few &overlaps) const {
    std::optional<int> wanted;
    std::optional<int> other;
    for (const int group : edge.groups) {
      const auto &name = file_.groups[static_cast<std::size_t>(group)].name;
      if (std::ranges::find(wanted_.boundaries, name) == wanted_.boundaries.end()) {
        if (!other)
          other = group;
        continue;
      }
      const auto &[cell, side] = edge.sides.front();
      if (wanted)
        overlaps.add(fmt::format("'{}' and '{}' share the edge at {}",
                                 file_.groups[static_cast<std::size_t>(*wanted)].name, name,
                                 at(corner(result_.mesh.cells[cell], side))));
      wanted = group;
    }
    return wanted ? wanted : other;
  }

  int id_of(const std::string &name) {
    auto &names = result_.boundary_names;
    const auto found = std::ranges::find(names, name);
    if (found != names.end())
      return static_cast<int>(found - names.begin());
    names.push_back(name);
    return static_cast<int>(names.size()) - 1;
  }

  void take_boundary_ids() {
    for (const auto &group : file_.groups) // every group has its id, in the order of the file
      if (group.dimension == 1)
        id_of(group.name);
    Few overlaps;
    Few inside;
    Few places;
    double free_length = 0;
    std::vector<unsigned> free_edges;
    for (auto &[vertices, edge] : edges_) {
      const auto group = group_of(edge, overlaps);
      const Point2 &a = result_.mesh.vertices[vertices.first];
      const Point2 &b = result_.mesh.vertices[vertices.second];
      const bool boundary = edge.sides.size() == 1;
      if (!boundary) {
        if (group && std::ranges::find(wanted_.boundaries, name_of_group(*group)) != wanted_.boundaries.end())
          inside.add(fmt::format("'{}' at {}", name_of_group(*group), at({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])})));
        continue;
      }
      if (!group) {
        places.add(fmt::format("from {} to {}", at(a), at(b)));
        free_length += std::hypot(b[0] - a[0], b[1] - a[1]);
      }
      result_.mesh.boundary.push_back({{vertices.first, vertices.second}, group ? id_of(name_of_group(*group)) : -2});
    }
    if (overlaps.size() > 0)
      error("groups with conditions overlap: " + overlaps.text(), "give each curve to one group with a condition");
    if (inside.size() > 0)
      error("a group with a condition lies inside the domain: " + inside.text(),
            "conditions are for the boundary; loads inside are body forces");
    if (places.size() == 0)
      return;
    const int id = id_of(free_boundary);
    for (auto &edge : result_.mesh.boundary)
      if (edge.id == -2)
        edge.id = id;
    warning(
        fmt::format("{} boundary edges ({:.4g} m) belong to no physical group and are taken as free of traction: {}",
                    places.size(), free_length, places.text()),
        "add their curves to a Physical Curve");
  }

  const std::string &name_of_group(int group) const { return file_.groups[static_cast<std::size_t>(group)].name; }

  /// Position of an edge's middle node if it is off the straight line.
  std::optional<Point2> midpoint(const std::pair<unsigned, unsigned> &vertices, const MeshEdge &edge) const {
    if (!edge.midnode)
      return {};
    const Point2 &a = result_.mesh.vertices[vertices.first];
    const Point2 &b = result_.mesh.vertices[vertices.second];
    const Point2 m{file_.nodes[*edge.midnode][0], file_.nodes[*edge.midnode][1]};
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    const bool straight = std::hypot(m[0] - 0.5 * (a[0] + b[0]), m[1] - 0.5 * (a[1] + b[1])) < 1e-9 * length;
    return straight ? std::nullopt : std::optional(m);
  }

  void make_boundaries() {
    std::map<std::pair<unsigned, unsigned>, int> ids;
    for (const auto &edge : result_.mesh.boundary)
      ids[{edge.vertices[0], edge.vertices[1]}] = edge.id;
    const auto &cells = result_.mesh.cells;
    std::vector<std::vector<RegionEdge>> edges(result_.region_names.size());
    for (const auto &[vertices, edge] : edges_) {
      const auto middle = midpoint(vertices, edge);
      for (std::size_t s = 0; s < edge.sides.size(); ++s) {
        const auto &[c, k] = edge.sides[s];
        const int neighbour = edge.sides.size() == 1 ? no_region : cells[edge.sides[1 - s].first].region;
        if (neighbour == cells[c].region)
          continue;
        RegionEdge side{
            cells[c].vertices[k], cells[c].vertices[(k + 1) % cells[c].n_vertices], middle, 0, neighbour, ""};
        side.id = neighbour == no_region ? ids.at(vertices) : problems::interface_id;
        side.name =
            neighbour == no_region
                ? result_.boundary_names[static_cast<std::size_t>(side.id)]
                : fmt::format("interface of {}", fmt::join(interface_names(cells[c].region, neighbour), " and "));
        edges[static_cast<std::size_t>(cells[c].region)].push_back(std::move(side));
      }
    }
    std::map<std::pair<unsigned, unsigned>, Point2> circles;
    std::vector<StraightApproximation> approximations;
    for (const auto &of_region : edges)
      add_region(of_region, circles, approximations);
    if (failed_)
      return;
    keep_curves(circles);
    tell(approximations);
  }

  std::vector<std::string> interface_names(int a, int b) const {
    return {result_.region_names[static_cast<std::size_t>(std::min(a, b))],
            result_.region_names[static_cast<std::size_t>(std::max(a, b))]};
  }

  void add_region(const std::vector<RegionEdge> &edges, std::map<std::pair<unsigned, unsigned>, Point2> &circles,
                  std::vector<StraightApproximation> &approximations) {
    auto loops = make_loops(edges);
    if (loops.touching_vertex)
      return error(fmt::format("the domain touches itself in the single point {}",
                               at(result_.mesh.vertices[*loops.touching_vertex])),
                   "join the parts along an edge, or part them");
    auto &pieces = result_.boundaries.emplace_back();
    for (auto &loop : loops.loops) {
      find_circles(loop, result_.mesh.vertices);
      for (const auto &edge : loop)
        if (edge.circle_centre && edge.neighbour == no_region)
          circles[key(edge.begin, edge.end)] = *edge.circle_centre;
      find_approximations(loop, result_.mesh.vertices, approximations);
      const auto some = make_pieces(loop, result_.mesh.vertices);
      pieces.insert(pieces.end(), some.begin(), some.end());
    }
  }

  /// Arcs of boundary edges that are arcs, parabolas of all others that are curved.
  void keep_curves(const std::map<std::pair<unsigned, unsigned>, Point2> &circles) {
    for (auto &edge : result_.mesh.boundary)
      if (const auto found = circles.find({edge.vertices[0], edge.vertices[1]}); found != circles.end())
        edge.arc_centre = found->second;
    for (const auto &[vertices, edge] : edges_)
      if (const auto middle = midpoint(vertices, edge); middle && !circles.contains(vertices))
        result_.mesh.curved_edges.push_back({{vertices.first, vertices.second}, *middle});
  }

  void tell(const std::vector<StraightApproximation> &approximations) {
    for (const auto &found : approximations)
      if (found.n_pieces >= 3)
        warning(
            fmt::format("boundary \"{}\" is approximated by {} straight pieces that turn by up to {:.2g} degrees; all "
                        "methods solve for this polygon",
                        found.name, found.n_pieces, found.largest_turn * 180 / std::numbers::pi),
            "if it is meant to be round, mesh with Mesh.ElementOrder = 2");
  }

  static std::pair<unsigned, unsigned> key(unsigned a, unsigned b) { return std::minmax(a, b); }

  const MeshFile &file_;
  const WantedGroups &wanted_;
  scene::Diagnostics &diagnostics_;
  bool failed_ = false;
  PlaneGeometry result_;
  std::vector<const Element *> cell_elements_;
  std::map<std::uint32_t, unsigned> vertex_of_node_;
  std::vector<std::uint32_t> node_of_vertex_;
  std::map<std::pair<unsigned, unsigned>, MeshEdge> edges_;
};

} // namespace

double PlaneGeometry::extent() const { return std::hypot(upper[0] - lower[0], upper[1] - lower[1]); }

double PlaneGeometry::mean_spacing() const {
  // Two triangles take the place of a square.
  double squares = 0;
  for (const auto &cell : mesh.cells)
    squares += cell.n_vertices == 4 ? 1 : 0.5;
  return std::sqrt(area / squares);
}

std::optional<PlaneGeometry> make_geometry(const MeshFile &file, const WantedGroups &wanted,
                                           scene::Diagnostics &diagnostics) {
  return Builder(file, wanted, diagnostics).build();
}

std::vector<std::string> group_names(const MeshFile &file, int dimension) {
  std::vector<std::string> names;
  for (const auto &group : file.groups)
    if (group.dimension == dimension)
      names.push_back(group.name);
  return names;
}

} // namespace comparisons::geometry
