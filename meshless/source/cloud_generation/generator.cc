#include "meshless/cloud_generation/generator.h"

#include "boundary_curves.h"
#include "interior_start.h"
#include "relaxation.h"
#include "wall.h"

#include "meshless/cloud/point_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::cloud_generation {

namespace {

/// Counts of one region for a factor of the spacing.
struct Counts {
  std::size_t boundary;
  std::size_t interior;
};

class Generator {
public:
  explicit Generator(const CloudRequest &request)
      : request_(request), spacing_(request.spacing), curves_(request.regions, spacing_, request.n_on_curves) {}

  GeneratedCloud run() {
    GeneratedCloud cloud;
    if (request_.n_particles) {
      // Cells as small as the particles will need can only be made once the scale is known.
      make_cells(1, 7);
      make_cells(fitting_scale(*request_.n_particles), 30);
      cloud.scale = fitting_scale(*request_.n_particles);
    } else
      make_cells(1, 30);
    std::vector<Counts> counts;
    for (std::size_t r = 0; r < cells_.size(); ++r)
      counts.push_back(counts_of(r, cloud.scale));
    if (request_.n_particles)
      make_exact(*request_.n_particles, counts);
    for (std::size_t r = 0; r < cells_.size(); ++r) {
      auto points = curves_.particles(r, cloud.scale);
      auto interior = cells_[r].places(counts[r].interior, request_.seed + 0x9e3779b9 * r);
      relax(request_.regions[r], spacing_, cloud.scale, points, interior);
      points.insert(points.end(), interior.begin(), interior.end());
      cloud.positions.insert(cloud.positions.end(), points.begin(), points.end());
      cloud.regions.insert(cloud.regions.end(), points.size(), static_cast<int>(r));
    }
    cloud.spacing = local_spacing(request_.regions, cloud.positions, cloud.regions);
    return cloud;
  }

private:
  void make_cells(double scale, int deepest) {
    cells_.clear();
    for (const auto &region : request_.regions)
      cells_.emplace_back(region, spacing_, scale, deepest);
  }

  /// In a triangulation of n_i points inside and n_b on the boundary, with k holes, there are
  /// 2 n_i + n_b - 2 + 2 k triangles.
  Counts counts_of(std::size_t region, double scale) const {
    const std::size_t n_boundary = curves_.n_particles(region, scale);
    const double holes = static_cast<double>(request_.regions[region].n_loops()) - 1;
    const double expected = cells_[region].n_expected() / (scale * scale);
    const double interior = std::round(expected - 0.5 * static_cast<double>(n_boundary) + 1 - holes);
    if (interior > 1e7)
      throw std::invalid_argument(fmt::format("{:.3g} particles in one region; at most 1e7", interior));
    return {n_boundary, interior > 0 ? static_cast<std::size_t>(interior) : 0};
  }

  double n_total(double scale) const {
    double n = 0;
    for (std::size_t r = 0; r < cells_.size(); ++r) {
      const Counts counts = counts_of(r, scale);
      n += static_cast<double>(counts.boundary + counts.interior);
    }
    return n;
  }

  /// The number falls with the scale, in steps.
  double fitting_scale(std::size_t wanted) const {
    double low = 1;
    double high = 1;
    const auto n = static_cast<double>(wanted);
    if (n > 1e7)
      throw std::invalid_argument(fmt::format("{} particles; at most 1e7", wanted));
    while (n_total(low) < n)
      low /= 2;
    while (n_total(high) > n) {
      high *= 2;
      if (high > 1e9)
        throw std::invalid_argument(
            fmt::format("{} particles are too few: the corners and the counts given for curves alone need {}", wanted,
                        n_total(high)));
    }
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (n_total(middle) < n ? high : low) = middle;
    }
    return low;
  }

  /// The last few particles, or a few less, go where most are.
  void make_exact(std::size_t wanted, std::vector<Counts> &counts) const {
    const auto largest = std::max_element(counts.begin(), counts.end(),
                                          [](const Counts &a, const Counts &b) { return a.interior < b.interior; });
    std::size_t others = 0;
    for (const Counts &c : counts)
      others += c.boundary + c.interior;
    others -= largest->interior;
    if (others > wanted)
      throw std::invalid_argument(
          fmt::format("{} particles are too few: at this spacing the boundary alone has {}", wanted, others));
    largest->interior = wanted - others;
  }

  const CloudRequest &request_;
  Spacing spacing_;
  BoundaryCurves curves_;
  std::vector<InteriorCells> cells_;
};

void check_sizes(std::size_t n_boundaries, std::size_t n, std::span<const int> regions) {
  if (!regions.empty() && regions.size() != n)
    throw std::invalid_argument(fmt::format("{} particles but {} regions", n, regions.size()));
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[i] < 0 || static_cast<std::size_t>(regions[i]) >= n_boundaries)
      throw std::invalid_argument(
          fmt::format("particle {} is in region {}; there are {}", i, regions[i], n_boundaries));
}

} // namespace

GeneratedCloud generate(const CloudRequest &request) {
  if (request.regions.empty())
    throw std::invalid_argument("a cloud needs at least one region");
  if (!request.spacing)
    throw std::invalid_argument("a cloud needs a spacing");
  return Generator(request).run();
}

std::vector<double> local_spacing(std::span<const domain::Boundary> boundaries, std::span<const Point2> positions,
                                  std::span<const int> regions) {
  check_sizes(boundaries.size(), positions.size(), regions);
  std::vector<double> result(positions.size());
  std::vector<cloud::Index> nearest;
  std::vector<double> distances;
  for (std::size_t r = 0; r < boundaries.size(); ++r) {
    std::vector<std::size_t> own;
    std::vector<Point2> points;
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (regions.empty() ? r == 0 : static_cast<std::size_t>(regions[i]) == r) {
        own.push_back(i);
        points.push_back(positions[i]);
      }
    const Wall wall(boundaries[r], points);
    const cloud::PointTree<2> tree(points);
    for (std::size_t i = 0; i < own.size(); ++i) {
      int n_found = 0;
      double sum = 0;
      // Some of the nearest may be behind the boundary.
      for (int k = 8; n_found < 4; k *= 2) {
        tree.nearest(points[i], k, nearest, distances);
        n_found = 0;
        sum = 0;
        for (std::size_t j = 0; j < nearest.size() && n_found < 4; ++j) {
          const auto other = static_cast<std::size_t>(nearest[j]);
          if (other == i || wall.hides(other, points[other], points[i]) || wall.hides(i, points[i], points[other]))
            continue;
          sum += distances[j];
          ++n_found;
        }
        if (nearest.size() < static_cast<std::size_t>(k))
          break;
      }
      if (n_found == 0)
        throw std::invalid_argument(fmt::format("particle {} at ({:.6g}, {:.6g}) has no neighbour in its region",
                                                own[i], points[i][0], points[i][1]));
      result[own[i]] = sum / n_found;
    }
  }
  return result;
}

} // namespace meshless::cloud_generation
