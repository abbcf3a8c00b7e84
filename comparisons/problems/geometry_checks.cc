#include "comparisons/problems/geometry_checks.h"

#include "comparisons/geometry/mesh_operations.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace comparisons::problems {

namespace {

const scene::PlacedTable *table_of(const std::string &group, const scene::GeometryTables &tables) {
  const auto found = std::ranges::find_if(
      tables.boundaries, [&](const scene::PlacedTable &table) { return table.keys.text("group") == group; });
  return found == tables.boundaries.end() ? nullptr : &*found;
}

Vector2 displacement_at(const BoundaryCondition &condition, const Point2 &point) {
  Vector2 u{};
  condition.displacement({&point, 1}, {&u, 1});
  return u;
}

std::string motion_name(const Eigen::Vector3d &motion, const Point2 &centre, double length) {
  // The motion (a - c (y - y0), b + c (x - x0)).
  const double a = motion[0];
  const double b = motion[1];
  const double c = motion[2] / length;
  constexpr double small = 1e-6;
  if (std::abs(c) * length < small)
    return std::abs(b) < small   ? "translation along 1 (x)"
           : std::abs(a) < small ? "translation along 2 (y)"
                                 : fmt::format("translation along ({:.3g}, {:.3g})", a, b);
  // It leaves the point at rest where both components vanish.
  const Point2 rest{centre[0] - b / c, centre[1] + a / c};
  const auto tidy = [&](double value) { return std::abs(value) < 1e-9 * length ? 0.0 : value; };
  return fmt::format("rotation about ({:.4g}, {:.4g})", tidy(rest[0]), tidy(rest[1]));
}

/// Names of a basis of the motions that the rows let pass: translations by themselves first.
std::vector<std::string> free_motions(const Eigen::Matrix3d &normal, const Point2 &centre, double length) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  const double scale = std::max(1e-300, solver.eigenvalues()[2]);
  std::vector<Eigen::Vector3d> null;
  for (int i = 0; i < 3; ++i)
    if (solver.eigenvalues()[i] < 1e-10 * std::max(scale, 1.0))
      null.push_back(solver.eigenvectors().col(i));
  if (null.size() == 3)
    return {"translation along 1 (x)", "translation along 2 (y)", "rotation"};
  if (null.size() == 2) {
    // A rotation is among them if the third components do not all vanish; it is parted from the translation.
    std::ranges::sort(null, {}, [](const Eigen::Vector3d &v) { return std::abs(v[2]); });
    if (std::abs(null[1][2]) > 1e-6)
      null[0] -= null[0][2] / null[1][2] * null[1];
  }
  std::vector<std::string> names;
  for (auto &motion : null)
    names.push_back(motion_name(motion.normalized(), centre, length));
  return names;
}

} // namespace

void check_rigid_motions(const geometry::PlaneGeometry &geometry, const PlaneStatement &statement,
                         const scene::GeometryTables &tables, scene::Diagnostics &diagnostics) {
  const auto &mesh = geometry.mesh;
  const auto [component, n] = geometry::components(mesh);
  std::vector<int> of_vertex(mesh.vertices.size(), 0);
  std::vector<Point2> somewhere(static_cast<std::size_t>(n));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (unsigned k = 0; k < mesh.cells[c].n_vertices; ++k) {
      of_vertex[mesh.cells[c].vertices[k]] = component[c];
      somewhere[static_cast<std::size_t>(component[c])] = mesh.vertices[mesh.cells[c].vertices[k]];
    }
  const Point2 centre{0.5 * (geometry.lower[0] + geometry.upper[0]), 0.5 * (geometry.lower[1] + geometry.upper[1])};
  const double length = geometry.extent();
  std::vector<Eigen::Matrix3d> normal(static_cast<std::size_t>(n), Eigen::Matrix3d::Zero());
  for (const auto &edge : mesh.boundary) {
    const auto found = statement.conditions.find(edge.id);
    if (found == statement.conditions.end())
      continue;
    for (const unsigned v : edge.vertices)
      for (std::size_t k = 0; k < 2; ++k) {
        if (!found->second.displacement_prescribed[k])
          continue;
        const double x = (mesh.vertices[v][0] - centre[0]) / length;
        const double y = (mesh.vertices[v][1] - centre[1]) / length;
        const Eigen::Vector3d row = k == 0 ? Eigen::Vector3d(1, 0, -y) : Eigen::Vector3d(0, 1, x);
        normal[static_cast<std::size_t>(of_vertex[v])] += row * row.transpose();
      }
  }
  for (std::size_t c = 0; c < normal.size(); ++c) {
    const auto motions = free_motions(normal[c], centre, length);
    if (motions.empty())
      continue;
    const std::string part =
        n == 1 ? "the domain"
               : fmt::format("the part of the domain at ({:.4g}, {:.4g})", somewhere[c][0], somewhere[c][1]);
    diagnostics.error(tables.boundaries.front().location, "boundary",
                      fmt::format("the conditions leave rigid motions of {}: {}", part, fmt::join(motions, ", ")),
                      "prescribe u1 or u2 on further groups");
  }
}

void check_shared_corners(const geometry::PlaneGeometry &geometry, const PlaneStatement &statement,
                          const scene::GeometryTables &tables, scene::Diagnostics &diagnostics) {
  const auto &mesh = geometry.mesh;
  std::map<unsigned, std::set<int>> ids;
  for (const auto &edge : mesh.boundary)
    for (const unsigned v : edge.vertices)
      ids[v].insert(edge.id);
  for (const auto &[vertex, at_vertex] : ids) {
    if (at_vertex.size() < 2)
      continue;
    const int first = *at_vertex.begin();
    const int last = *at_vertex.rbegin();
    const auto a = statement.conditions.find(first);
    const auto b = statement.conditions.find(last);
    if (a == statement.conditions.end() || b == statement.conditions.end())
      continue;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!a->second.displacement_prescribed[k] || !b->second.displacement_prescribed[k])
        continue;
      const Point2 &x = mesh.vertices[vertex];
      const double u = displacement_at(a->second, x)[k];
      const double v = displacement_at(b->second, x)[k];
      if (std::abs(u - v) <= 1e-9 * std::max(std::abs(u), std::abs(v)))
        continue;
      const auto &name_a = geometry.boundary_names[static_cast<std::size_t>(first)];
      const auto &name_b = geometry.boundary_names[static_cast<std::size_t>(last)];
      const auto *table = table_of(name_b, tables);
      diagnostics.error(
          table->keys.location(k == 0 ? "u1" : "u2"), fmt::format("{}.u{}", table->key, k + 1),
          fmt::format("'{}' and '{}' meet at ({:.6g}, {:.6g}) and prescribe different displacements there: "
                      "u{} = {:.6g} and {:.6g} m",
                      name_a, name_b, x[0], x[1], k + 1, u, v),
          "prescribe the same value where they meet, or leave the component to one of them");
    }
  }
}

void check_finite(const geometry::PlaneGeometry &geometry, const PlaneStatement &statement,
                  const scene::GeometryTables &tables, scene::Diagnostics &diagnostics) {
  const auto &mesh = geometry.mesh;
  const geometry::EdgeCurves curves(mesh);
  std::map<int, std::vector<Point2>> points;
  std::map<int, std::vector<Vector2>> normals;
  for (const auto &edge : mesh.boundary)
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      points[edge.id].push_back(curves.point(mesh, edge.vertices[0], edge.vertices[1], t));
      normals[edge.id].push_back({1, 0});
    }
  for (const auto &[id, condition] : statement.conditions) {
    const auto *table = table_of(geometry.boundary_names[static_cast<std::size_t>(id)], tables);
    if (table == nullptr)
      continue;
    std::vector<Vector2> values(points[id].size());
    try {
      if (condition.displacement)
        condition.displacement(points[id], values);
      if (condition.traction)
        condition.traction(points[id], normals[id], values);
    } catch (const std::domain_error &error) {
      diagnostics.error(table->location, table->key, error.what(), "an expression must be finite on its boundary");
    }
  }
  if (statement.thermal_strain) {
    std::vector<double> strain(mesh.vertices.size());
    try {
      statement.thermal_strain(mesh.vertices, strain);
    } catch (const std::domain_error &error) {
      diagnostics.error(tables.thermal_expansion->location, tables.thermal_expansion->key, error.what(),
                        "an expression must be finite in the domain");
    }
  }
  if (!statement.body_force)
    return;
  std::vector<Vector2> values(mesh.vertices.size());
  try {
    statement.body_force(mesh.vertices, values);
  } catch (const std::domain_error &error) {
    diagnostics.error(tables.body_force->location, tables.body_force->key, error.what(),
                      "an expression must be finite in the domain");
  }
}

} // namespace comparisons::problems
