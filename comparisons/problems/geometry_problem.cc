#include "comparisons/problems/geometry_problem.h"

#include "comparisons/problems/boundary_foot.h"
#include "comparisons/problems/domain_boundary.h"

#include "comparisons/geometry/mesh_operations.h"

#include "meshless/cloud/point_tree.h"
#include "meshless/cloud_generation/generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::problems {

namespace {

/// The vertices on the edge of each region: of cells' sides whose other side is no cell of the region.
std::vector<std::vector<bool>> edge_vertices(const Mesh &mesh, std::size_t n_regions) {
  std::map<std::pair<unsigned, unsigned>, std::vector<int>> sides;
  for (const auto &cell : mesh.cells)
    for (unsigned k = 0; k < cell.n_vertices; ++k)
      sides[std::minmax(cell.vertices[k], cell.vertices[(k + 1) % cell.n_vertices])].push_back(cell.region);
  std::vector<std::vector<bool>> result(n_regions, std::vector<bool>(mesh.vertices.size(), false));
  for (const auto &[edge, regions] : sides)
    if (regions.size() == 1 || regions[0] != regions[1])
      for (const int region : regions)
        result[static_cast<std::size_t>(region)][edge.first] = result[static_cast<std::size_t>(region)][edge.second] =
            true;
  return result;
}

/// The vertices with those on boundaries moved onto the pieces of the statement. They are off them only where a
/// boundary is neither straight nor round, by the difference between two approximations of it.
std::vector<Point2> on_pieces(const Mesh &mesh, const std::vector<Region> &regions,
                              const std::vector<std::vector<bool>> &on_edge, const std::vector<double> &spacing) {
  std::vector<Point2> points = mesh.vertices;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if (!on_edge[r][v])
        continue;
      double least = 0.2 * spacing[v];
      for (const auto &piece : regions[r].boundary) {
        const Point2 foot = nearest_on(piece, mesh.vertices[v]);
        const double distance = std::hypot(foot[0] - mesh.vertices[v][0], foot[1] - mesh.vertices[v][1]);
        if (distance < least) {
          least = distance;
          points[v] = foot;
        }
      }
      break; // both sides of an interface have the same pieces
    }
  return points;
}

} // namespace

GeometryProblem::GeometryProblem(std::shared_ptr<const ResolvedGeometry> geometry, const scene::GeometryTables &tables,
                                 std::uint64_t seed, ReferenceSolver solve_reference)
    : geometry_(std::move(geometry)), generated_(tables.geometry.keys.text("cloud") == "generated"), seed_(seed),
      element_(tables.reference.keys.text("element")),
      refinements_(static_cast<int>(tables.reference.keys.integer("refinements"))),
      solve_reference_(std::move(solve_reference)) {}

const ExactSolution &GeometryProblem::exact() const {
  if (geometry_->exact.displacement)
    return geometry_->exact;
  if (!computed_.displacement) {
    Mesh mesh = geometry_->levels.at(geometry_->finest_level);
    for (int i = 0; i < refinements_; ++i)
      mesh = geometry::refine(mesh);
    computed_ = solve_reference_(geometry_->statement, mesh, element_);
  }
  return computed_;
}

Mesh GeometryProblem::mesh(const scene::Level &level) const { return geometry_->levels.at(level.text); }

Cloud GeometryProblem::cloud(const scene::Level &level) const {
  if (!geometry_->cloud.positions.empty())
    return geometry_->cloud;
  const Mesh &mesh = geometry_->levels.at(level.text);
  Cloud cloud = nodes(mesh);
  return generated_ ? generated(mesh, cloud.positions.size()) : cloud;
}

Cloud GeometryProblem::generated(const Mesh &mesh, std::size_t n_particles) const {
  meshless::cloud_generation::CloudRequest request;
  for (const auto &region : geometry_->statement.regions)
    request.regions.push_back(domain_boundary(region.boundary));
  const auto spacing = geometry::vertex_spacing(mesh);
  const meshless::cloud::PointTree<2> tree(mesh.vertices);
  request.spacing = [&](std::span<const Point2> points, std::span<double> values) {
    std::vector<meshless::cloud::Index> nearest;
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i) {
      tree.nearest(points[i], 1, nearest, distances);
      values[i] = spacing[static_cast<std::size_t>(nearest.front())];
    }
  };
  request.seed = seed_;
  request.n_particles = n_particles;
  auto made = meshless::cloud_generation::generate(request);
  Cloud cloud{std::move(made.positions), std::move(made.spacing)};
  if (geometry_->statement.regions.size() > 1)
    cloud.regions = std::move(made.regions);
  return cloud;
}

Cloud GeometryProblem::nodes(const Mesh &mesh) const {
  const auto &regions = geometry_->statement.regions;
  const auto spacing = geometry::vertex_spacing(mesh);
  const auto points = on_pieces(mesh, regions, edge_vertices(mesh, regions.size()), spacing);
  Cloud cloud;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::vector<bool> taken(mesh.vertices.size(), false);
    for (const auto &cell : mesh.cells) {
      if (cell.region != static_cast<int>(r))
        continue;
      for (unsigned k = 0; k < cell.n_vertices; ++k) {
        const unsigned v = cell.vertices[k];
        if (taken[v])
          continue;
        taken[v] = true;
        cloud.positions.push_back(points[v]);
        cloud.spacing.push_back(spacing[v]);
        if (regions.size() > 1)
          cloud.regions.push_back(static_cast<int>(r));
      }
    }
  }
  return cloud;
}

Quadrature GeometryProblem::quadrature(const scene::Level &level) const {
  // Four points a direction on at least 400 cells: no method uses this rule for itself.
  constexpr std::size_t least_cells = 400;
  Mesh mesh = geometry_->levels.at(level.text);
  while (mesh.cells.size() < least_cells)
    mesh = geometry::refine(mesh);
  auto quadrature = geometry::cell_quadrature(mesh, 4);
  if (geometry_->statement.regions.size() == 1)
    quadrature.regions.clear();
  return quadrature;
}

std::vector<std::string> GeometryProblem::remarks() const {
  auto remarks = geometry_->remarks;
  if (!geometry_->reference_file.empty())
    remarks.push_back(fmt::format("errors are relative to {}, at its {} points", geometry_->reference_file,
                                  geometry_->exact.only_at->points.size()));
  if (!geometry_->exact.displacement)
    remarks.push_back(
        fmt::format("errors are relative to a finer finite-element solution: {} on the level {} refined {} {}",
                    element_, geometry_->finest_level, refinements_, refinements_ == 1 ? "time" : "times"));
  return remarks;
}

} // namespace comparisons::problems
