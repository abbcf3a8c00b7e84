#include "boundary_conditions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
/// Nodes on the edges of one id, each once, sorted.
std::vector<unsigned> nodes_of_id(const Discretisation &discretisation, int id) {
  std::vector<unsigned> nodes;
  for (const auto &edge : discretisation.edges)
    if (edge.id == id)
      for (unsigned k = 0; k <= static_cast<unsigned>(discretisation.degree()); ++k)
        nodes.push_back(discretisation.node_of_side(edge, k));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void prescribe(int id, const BoundaryCondition &condition, const Discretisation &discretisation, EssentialData &data) {
  const auto nodes = nodes_of_id(discretisation, id);
  std::vector<Point> points;
  points.reserve(nodes.size());
  for (const unsigned node : nodes)
    points.push_back(discretisation.original_position(node));
  std::vector<Vector> values(nodes.size(), Vector{});
  condition.displacement(points, values);

  double largest = 0;
  for (const auto &value : values)
    largest = std::max({largest, std::abs(value[0]), std::abs(value[1])});
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (unsigned d = 0; d < 2; ++d) {
      if (condition.kind[d] != ConditionKind::displacement)
        continue;
      const double value = values[k][d];
      if (!std::isfinite(value))
        throw InvalidInput(fmt::format("boundary id {}: the prescribed displacement u{} at ({}, {}) is {}", id, d + 1,
                                       points[k][0], points[k][1], value));
      const std::size_t unknown = 2 * std::size_t{nodes[k]} + d;
      if (data.prescribed[unknown] == 0) {
        data.prescribed[unknown] = 1;
        data.values[unknown] = value;
        data.ids[unknown] = id;
      } else if (std::abs(value - data.values[unknown]) > 1e-10 * largest) // more than rounding
        ++data.contradicted;
    }
}

/// The lowest node of the connected part that each node belongs to (union-find with path halving).
std::vector<unsigned> connected_parts(const Discretisation &discretisation) {
  std::vector<unsigned> parent(discretisation.n_nodes());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&parent](unsigned i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const auto nodes = discretisation.nodes_of(c);
    unsigned first = root(nodes[0]);
    for (const unsigned node : nodes) {
      const unsigned other = root(node);
      parent[std::max(first, other)] = std::min(first, other);
      first = std::min(first, other);
    }
  }
  for (unsigned i = 0; i < parent.size(); ++i)
    parent[i] = root(i);
  return parent;
}

/// What the prescribed components of one connected part fix. A rotation stays free as long as all
/// prescribed u1 have one x2 and all prescribed u2 have one x1: their intersection is a centre.
struct Supports {
  std::array<std::size_t, 2> count{};
  std::array<double, 2> lowest = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  std::array<double, 2> highest = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};

  void add(std::size_t component, Point position) {
    ++count[component];
    const double arm = position[1 - component];
    lowest[component] = std::min(lowest[component], arm);
    highest[component] = std::max(highest[component], arm);
  }

  std::vector<std::string> free_motions(double extent) const {
    std::vector<std::string> motions;
    bool rotation_fixed = false;
    for (std::size_t d = 0; d < 2; ++d) {
      if (count[d] == 0)
        motions.push_back(fmt::format("translation along x{}", d + 1));
      else if (highest[d] - lowest[d] > 1e-8 * extent)
        rotation_fixed = true;
    }
    if (!rotation_fixed)
      motions.push_back("rotation");
    return motions;
  }
};

void check_rigid_motions(const EssentialData &data, const Discretisation &discretisation) {
  const auto part = connected_parts(discretisation);
  std::map<unsigned, Supports> supports;
  for (unsigned node = 0; node < part.size(); ++node)
    if (part[node] == node)
      supports[node];
  for (unsigned node = 0; node < part.size(); ++node)
    for (std::size_t d = 0; d < 2; ++d)
      if (data.prescribed[2 * std::size_t{node} + d] != 0)
        supports[part[node]].add(d, discretisation.positions[node]);
  for (const auto &[node, support] : supports) {
    const auto motions = support.free_motions(discretisation.extent);
    if (motions.empty())
      continue;
    const auto position = discretisation.original_position(node);
    throw InvalidInput(fmt::format(
        "the essential conditions leave {} rigid motion{} free ({}){}: the stiffness is singular; "
        "prescribe more displacement components",
        motions.size(), motions.size() == 1 ? "" : "s", fmt::join(motions, ", "),
        supports.size() == 1
            ? std::string()
            : fmt::format(" in the part of the mesh that holds the point ({}, {})", position[0], position[1])));
  }
}
const char *name_of(PlaneModel model) { return model == PlaneModel::plane_stress ? "plane stress" : "plane strain"; }
} // namespace

void check_conditions(const PlaneProblem &problem) {
  std::map<int, std::size_t> edge_of_id;
  for (std::size_t e = 0; e < problem.mesh.boundary.size(); ++e)
    edge_of_id.emplace(problem.mesh.boundary[e].id, e);
  std::vector<int> ids;
  for (const auto &[id, edge] : edge_of_id)
    ids.push_back(id);
  for (const auto &[id, edge] : edge_of_id)
    if (problem.boundary.count(id) == 0)
      throw InvalidInput(fmt::format("boundary id {} of the mesh (boundary edge {}) has no condition", id, edge));
  for (const auto &[id, condition] : problem.boundary) {
    if (edge_of_id.count(id) == 0)
      throw InvalidInput(
          fmt::format("there is a condition for boundary id {}, but the mesh has only: {}", id, fmt::join(ids, ", ")));
    for (std::size_t d = 0; d < 2; ++d)
      if (condition.kind[d] == ConditionKind::displacement && !condition.displacement)
        throw InvalidInput(
            fmt::format("boundary id {} prescribes u{} but its `displacement` callback is empty", id, d + 1));
  }
}

void check_materials(const PlaneProblem &problem) {
  const auto &materials = problem.materials;
  if (materials.empty())
    throw InvalidInput("there is no material; give one for each region of the mesh");
  for (std::size_t m = 1; m < materials.size(); ++m)
    if (materials[m].model() != materials[0].model())
      throw InvalidInput(fmt::format("the material of region {} is in {} and that of region 0 in {}; a plane problem "
                                     "has one model",
                                     m, name_of(materials[m].model()), name_of(materials[0].model())));
  const auto &cells = problem.mesh.cells;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (cells[c].region < 0 || static_cast<std::size_t>(cells[c].region) >= materials.size())
      throw InvalidInput(fmt::format("mesh: cell {} is of region {}, but there are materials for {} region{} only, "
                                     "counted from 0",
                                     c, cells[c].region, materials.size(), materials.size() == 1 ? "" : "s"));
}

EssentialData essential_data(const PlaneProblem &problem, const Discretisation &discretisation,
                             FreeMotions free_motions) {
  EssentialData data;
  data.prescribed.assign(2 * discretisation.n_nodes(), 0);
  data.values.assign(2 * discretisation.n_nodes(), 0.);
  data.ids.assign(2 * discretisation.n_nodes(), -1);
  for (const auto &[id, condition] : problem.boundary) // ascending: the lowest id comes first
    if (condition.kind[0] == ConditionKind::displacement || condition.kind[1] == ConditionKind::displacement)
      prescribe(id, condition, discretisation, data);
  if (free_motions == FreeMotions::refused)
    check_rigid_motions(data, discretisation);
  return data;
}

void eliminate(const EssentialData &essential, linear_algebra::BlockMatrix &matrix,
               std::vector<double> &right_hand_side) {
  const auto &prescribed = essential.prescribed;
  std::vector<char> held(prescribed.size() / 2); // nodes
  for (std::size_t j = 0; j < held.size(); ++j)
    held[j] = prescribed[2 * j] | prescribed[2 * j + 1];
  const auto is_held = [&](int j) { return held[static_cast<std::size_t>(j)] != 0; };
  std::size_t entry = 0;
  for (int j = 0; j < matrix.n_nodes(); ++j) {
    const std::span rows(matrix.block_rows.begin() + matrix.block_start[j],
                         matrix.block_rows.begin() + matrix.block_start[j + 1]); // j first
    if (std::none_of(rows.begin(), rows.end(), is_held)) {
      entry += 4 * rows.size() - 1;
      continue;
    }
    for (int s = 0; s < 2; ++s) {
      const std::size_t column = 2 * static_cast<std::size_t>(j) + s;
      for (int k = matrix.block_start[j]; k < matrix.block_start[j + 1]; ++k)
        for (int r = (k == matrix.block_start[j] ? s : 0); r < 2; ++r, ++entry) {
          const std::size_t row = 2 * static_cast<std::size_t>(matrix.block_rows[k]) + r;
          if (row == column || (prescribed[row] == 0 && prescribed[column] == 0))
            continue;
          if (prescribed[row] == 0)
            right_hand_side[row] -= matrix.values[entry] * essential.values[column];
          if (prescribed[column] == 0)
            right_hand_side[column] -= matrix.values[entry] * essential.values[row];
          matrix.values[entry] = 0;
        }
    }
  }
  // The kept diagonal scales the equation u = value as its neighbours.
  for (int j = 0; j < matrix.n_nodes(); ++j) {
    const std::size_t first = matrix.first_entry(static_cast<unsigned>(j));
    const int n_blocks = matrix.block_start[j + 1] - matrix.block_start[j];
    for (std::size_t s = 0; s < 2; ++s)
      if (const std::size_t unknown = 2 * static_cast<std::size_t>(j) + s; prescribed[unknown] != 0)
        right_hand_side[unknown] =
            matrix.values[first + (s == 0 ? 0 : 2 * static_cast<std::size_t>(n_blocks))] * essential.values[unknown];
  }
}
} // namespace fem_reference::elasticity
