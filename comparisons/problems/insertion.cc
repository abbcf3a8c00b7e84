#include "comparisons/problems/insertion.h"

#include "comparisons/problems/domain_boundary.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace comparisons::problems {

namespace {

double distance(const Point2 &a, const Point2 &b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

std::vector<std::size_t> nearest_first(const std::vector<Point2> &points, const Point2 &place) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return distance(points[a], place) < distance(points[b], place);
  });
  return order;
}

int region_of(const Cloud &cloud, std::size_t i) { return cloud.regions.empty() ? 0 : cloud.regions[i]; }

/// Grows a cloud point by point.
class Insertion {
public:
  Insertion(Cloud cloud, const PlaneStatement &statement) : cloud_(std::move(cloud)) {
    for (const auto &region : statement.regions)
      boundaries_.push_back(domain_boundary(region.boundary));
  }

  void try_between(std::size_t i, std::size_t j) {
    const Point2 &a = cloud_.positions[i], &b = cloud_.positions[j];
    const Point2 middle{.5 * (a[0] + b[0]), .5 * (a[1] + b[1])};
    const double spacing = std::min(cloud_.spacing[i], cloud_.spacing[j]);
    const int region = region_of(cloud_, i);
    const auto &boundary = boundaries_[static_cast<std::size_t>(region)];
    if (!boundary.contains(middle) || boundary.distance(middle) < .25 * spacing)
      return;
    for (std::size_t k = 0; k < cloud_.positions.size(); ++k)
      if (region_of(cloud_, k) == region && distance(cloud_.positions[k], middle) < .45 * spacing)
        return;
    cloud_.positions.push_back(middle);
    cloud_.spacing.push_back(.5 * spacing);
    if (!cloud_.regions.empty())
      cloud_.regions.push_back(region);
  }

  const Cloud &cloud() const { return cloud_; }
  Cloud take() { return std::move(cloud_); }

private:
  Cloud cloud_;
  std::vector<meshless::domain::Boundary> boundaries_;
};

Point2 centre_of(const Mesh &mesh, const Mesh::Cell &cell) {
  Point2 centre{};
  for (unsigned k = 0; k < cell.n_vertices; ++k)
    for (std::size_t d = 0; d < 2; ++d)
      centre[d] += mesh.vertices[cell.vertices[k]][d] / cell.n_vertices;
  return centre;
}

void divide(Mesh &mesh, std::size_t c) {
  const Mesh::Cell cell = mesh.cells[c];
  const Point2 centre = centre_of(mesh, cell);
  const auto first = static_cast<unsigned>(mesh.vertices.size());
  Mesh::Cell inner = cell;
  for (unsigned k = 0; k < cell.n_vertices; ++k) {
    const Point2 corner = mesh.vertices[cell.vertices[k]];
    mesh.vertices.push_back({.5 * (corner[0] + centre[0]), .5 * (corner[1] + centre[1])});
    inner.vertices[k] = first + k;
    const unsigned next = (k + 1) % cell.n_vertices;
    mesh.cells.push_back({{cell.vertices[k], cell.vertices[next], first + next, first + k}, 4, cell.region});
  }
  mesh.cells[c] = inner;
}

} // namespace

Cloud with_points_near(const Point2 &place, std::size_t n, Cloud cloud, const PlaneStatement &statement) {
  const auto order = nearest_first(cloud.positions, place);
  const std::size_t n_before = cloud.positions.size();
  cloud.regular = false;
  Insertion insertion(std::move(cloud), statement);
  for (std::size_t k = 0; k < n_before; ++k)
    for (std::size_t l = 0; l < k; ++l) { // pairs by the farther of the two
      const std::size_t i = order[k], j = order[l];
      if (insertion.cloud().positions.size() >= n_before + n)
        return insertion.take();
      const double reach = 1.6 * std::max(insertion.cloud().spacing[i], insertion.cloud().spacing[j]);
      if (region_of(insertion.cloud(), i) == region_of(insertion.cloud(), j) &&
          distance(insertion.cloud().positions[i], insertion.cloud().positions[j]) < reach)
        insertion.try_between(i, j);
    }
  return insertion.take();
}

Mesh with_points_near(const Point2 &place, std::size_t n, Mesh mesh) {
  std::vector<Point2> centres;
  for (const auto &cell : mesh.cells)
    centres.push_back(centre_of(mesh, cell));
  const std::size_t n_before = mesh.vertices.size();
  for (const std::size_t c : nearest_first(centres, place)) {
    // As near to n as whole cells allow.
    if (mesh.vertices.size() + mesh.cells[c].n_vertices / 2 > n_before + n)
      break;
    divide(mesh, c);
  }
  return mesh;
}

} // namespace comparisons::problems
