#include "point_location.h"

#include "fem_reference/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
constexpr double tolerance = 1e-10;
constexpr double largest_continuation = .25;

using mesh::Point;

/// Corners of a cell in the order (0,0), (1,0), (0,1), (1,1). Sides are straight, so the corners
/// alone give the geometry, whatever the degree.
std::array<Point, 4> corners(const Discretisation &discretisation, std::size_t cell) {
  const auto nodes = discretisation.nodes_of(cell);
  const auto p = static_cast<std::size_t>(discretisation.degree);
  return {discretisation.positions[nodes[0]], discretisation.positions[nodes[p]],
          discretisation.positions[nodes[p * (p + 1)]], discretisation.positions[nodes[p * (p + 2)]]};
}

/// The point of the segment from a to b closest to x: its parameter in [0, 1] and distance squared.
struct Projection {
  double parameter;
  double distance_squared;
};
Projection project(Point x, Point a, Point b) {
  const Point ab = {b[0] - a[0], b[1] - a[1]};
  const Point ax = {x[0] - a[0], x[1] - a[1]};
  const double t = std::clamp((ab[0] * ax[0] + ab[1] * ax[1]) / (ab[0] * ab[0] + ab[1] * ab[1]), 0., 1.);
  const double d0 = ax[0] - t * ab[0];
  const double d1 = ax[1] - t * ab[1];
  return {t, d0 * d0 + d1 * d1};
}

double squared_distance(Point x, Point lower, Point upper) {
  const double d0 = std::max({lower[0] - x[0], 0., x[0] - upper[0]});
  const double d1 = std::max({lower[1] - x[1], 0., x[1] - upper[1]});
  return d0 * d0 + d1 * d1;
}
} // namespace

PointLocation::PointLocation(const Discretisation &discretisation) : discretisation_(discretisation) {
  boxes_.reserve(discretisation.n_cells);
  Point upper{};
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const auto corner = corners(discretisation, c);
    Box box = {corner[0], corner[0]};
    for (const auto &x : corner)
      for (std::size_t d = 0; d < 2; ++d) {
        box.lower[d] = std::min(box.lower[d], x[d]);
        box.upper[d] = std::max(box.upper[d], x[d]);
      }
    const double margin = 1e-9 * std::max(box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]);
    for (std::size_t d = 0; d < 2; ++d) {
      box.lower[d] -= margin;
      box.upper[d] += margin;
      lower_[d] = c == 0 ? box.lower[d] : std::min(lower_[d], box.lower[d]);
      upper[d] = c == 0 ? box.upper[d] : std::max(upper[d], box.upper[d]);
    }
    boxes_.push_back(box);
  }
  const double area = (upper[0] - lower_[0]) * (upper[1] - lower_[1]);
  const double size = std::sqrt(area / static_cast<double>(discretisation.n_cells));
  // A thin mesh still gets at least one bin; the cap keeps 32-bit products safe.
  for (std::size_t d = 0; d < 2; ++d) {
    n_bins_[d] = static_cast<int>(std::clamp((upper[d] - lower_[d]) / size, 1., 30000.));
    bin_size_[d] = (upper[d] - lower_[d]) / n_bins_[d];
  }

  const auto for_each_bin = [this](const Box &box, const auto &function) {
    for (int j = bin_of(box.lower[1], 1); j <= bin_of(box.upper[1], 1); ++j)
      for (int i = bin_of(box.lower[0], 0); i <= bin_of(box.upper[0], 0); ++i)
        function(static_cast<std::size_t>(j) * n_bins_[0] + i);
  };
  bin_start_.assign(static_cast<std::size_t>(n_bins_[0]) * n_bins_[1] + 1, 0);
  for (const auto &box : boxes_)
    for_each_bin(box, [this](std::size_t bin) { ++bin_start_[bin + 1]; });
  for (std::size_t bin = 1; bin < bin_start_.size(); ++bin)
    bin_start_[bin] += bin_start_[bin - 1];
  bin_cells_.resize(bin_start_.back());
  std::vector<unsigned> next(bin_start_.begin(), bin_start_.end() - 1);
  for (unsigned c = 0; c < boxes_.size(); ++c) // ascending within each bin
    for_each_bin(boxes_[c], [&](std::size_t bin) { bin_cells_[next[bin]++] = c; });
}

int PointLocation::bin_of(double coordinate, std::size_t direction) const {
  const double bin = (coordinate - lower_[direction]) / bin_size_[direction];
  return static_cast<int>(std::clamp(bin, 0., n_bins_[direction] - .5));
}

/// Newton's method for the bilinear map, from the centre. False if it does not converge, which for a
/// convex cell happens only away from it.
bool PointLocation::invert(std::size_t cell, Point point, Point &xi) const {
  const auto x = corners(discretisation_, cell);
  Point a{};
  Point b{};
  Point c{};
  for (std::size_t d = 0; d < 2; ++d) {
    a[d] = x[1][d] - x[0][d];
    b[d] = x[2][d] - x[0][d];
    c[d] = x[3][d] - x[2][d] - a[d];
  }
  xi = {.5, .5};
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Point d1 = {a[0] + c[0] * xi[1], a[1] + c[1] * xi[1]};
    const Point d2 = {b[0] + c[0] * xi[0], b[1] + c[1] * xi[0]};
    const double r0 = point[0] - x[0][0] - xi[0] * d1[0] - xi[1] * b[0];
    const double r1 = point[1] - x[0][1] - xi[0] * d1[1] - xi[1] * b[1];
    const double determinant = d1[0] * d2[1] - d1[1] * d2[0];
    const double s = (d2[1] * r0 - d2[0] * r1) / determinant;
    const double t = (d1[0] * r1 - d1[1] * r0) / determinant;
    if (!std::isfinite(s) || !std::isfinite(t))
      return false;
    xi[0] += s;
    xi[1] += t;
    if (std::abs(s) + std::abs(t) < 1e-12) // quadratic: this step was the last that mattered
      return true;
  }
  return false;
}

Location PointLocation::locate(Point point) const {
  if (!std::isfinite(point[0]) || !std::isfinite(point[1]))
    throw InvalidInput(fmt::format("evaluation point ({}, {}) is not finite", discretisation_.origin[0] + point[0],
                                   discretisation_.origin[1] + point[1]));
  const std::size_t bin = static_cast<std::size_t>(bin_of(point[1], 1)) * n_bins_[0] + bin_of(point[0], 0);
  Location location;
  for (unsigned k = bin_start_[bin]; k < bin_start_[bin + 1]; ++k) {
    const auto &box = boxes_[bin_cells_[k]];
    if (squared_distance(point, box.lower, box.upper) > 0 || !invert(bin_cells_[k], point, location.xi))
      continue;
    const auto [s, t] = location.xi;
    if (s >= -tolerance && s <= 1 + tolerance && t >= -tolerance && t <= 1 + tolerance) {
      location.cell = bin_cells_[k];
      return location;
    }
  }
  return nearest(point);
}

/// Search rings of bins around the point's own until no closer cell is possible.
Location PointLocation::nearest(Point point) const {
  const std::array<int, 2> centre = {bin_of(point[0], 0), bin_of(point[1], 1)};
  double best = std::numeric_limits<double>::max();
  Location location;
  location.outside = true;
  Point on_border{};
  const auto visit = [&](unsigned cell) {
    if (squared_distance(point, boxes_[cell].lower, boxes_[cell].upper) > best)
      return;
    const auto x = corners(discretisation_, cell);
    const std::array<std::array<int, 2>, 4> sides = {{{0, 2}, {1, 3}, {0, 1}, {2, 3}}};
    for (std::size_t side = 0; side < 4; ++side) {
      const auto projection = project(point, x[sides[side][0]], x[sides[side][1]]);
      if (projection.distance_squared < best || (projection.distance_squared == best && cell < location.cell)) {
        best = projection.distance_squared;
        location.cell = cell;
        const double t = projection.parameter;
        on_border = side < 2 ? Point{side == 0 ? 0. : 1., t} : Point{t, side == 2 ? 0. : 1.};
      }
    }
  };
  const Point inside = {std::clamp(point[0], lower_[0], lower_[0] + n_bins_[0] * bin_size_[0]),
                        std::clamp(point[1], lower_[1], lower_[1] + n_bins_[1] * bin_size_[1])};
  const double gap_squared = squared_distance(point, inside, inside);
  const int last_ring = std::max(n_bins_[0], n_bins_[1]);
  for (int ring = 0; ring <= last_ring; ++ring) {
    // Cells first met in this ring are at least ring - 1 bins away from `inside`, which is the
    // projection of the point on the convex box of bins: the squares of both distances add up.
    const double reach = std::max(0, ring - 1) * std::min(bin_size_[0], bin_size_[1]);
    if (gap_squared + reach * reach > best)
      break;
    for (int j = std::max(0, centre[1] - ring); j <= std::min(n_bins_[1] - 1, centre[1] + ring); ++j)
      for (int i = std::max(0, centre[0] - ring); i <= std::min(n_bins_[0] - 1, centre[0] + ring); ++i) {
        if (std::max(std::abs(i - centre[0]), std::abs(j - centre[1])) != ring)
          continue;
        const std::size_t bin = static_cast<std::size_t>(j) * n_bins_[0] + i;
        for (unsigned k = bin_start_[bin]; k < bin_start_[bin + 1]; ++k)
          visit(bin_cells_[k]);
      }
  }
  // Where the cell's map cannot be continued to the point, the closest point of its border stands in.
  if (!invert(location.cell, point, location.xi) || squared_distance(location.xi, {-1, -1}, {2, 2}) > 0)
    location.xi = on_border;
  for (auto &coordinate : location.xi)
    coordinate = std::clamp(coordinate, -largest_continuation, 1 + largest_continuation);
  return location;
}
} // namespace fem_reference::elasticity
