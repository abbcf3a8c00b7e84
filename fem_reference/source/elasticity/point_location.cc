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
/// Steps of Newton's method smaller than this were the last that mattered: it converges quadratically.
constexpr double last_step = 1e-12;

using mesh::Point;

/// Corners of a cell, counter-clockwise. Where its sides are straight they alone give the geometry, whatever
/// the degree.
std::array<Point, 4> corners(const Discretisation &discretisation, std::size_t cell) {
  const auto nodes = discretisation.nodes_of(cell);
  const auto &element = discretisation.element_of(cell);
  std::array<Point, 4> result{};
  for (unsigned k = 0; k < element.n_vertices(); ++k)
    result[k] = discretisation.positions[nodes[element.corner(k)]];
  return result;
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

/// A curved side is taken as a polygon of this many segments: enough to tell which cell is nearest.
constexpr int segments_of_curve = 16;

Point point_of_side(const Discretisation &discretisation, std::size_t cell, unsigned side, double t) {
  const auto nodes = discretisation.nodes_of(cell);
  const auto &element = discretisation.element_of(cell);
  const auto along = element.side(side);
  LagrangeBasis::Values shape, slope;
  element.line().evaluate(t, shape, slope);
  Point x{};
  for (std::size_t a = 0; a < along.size(); ++a)
    for (std::size_t d = 0; d < 2; ++d)
      x[d] += shape[a] * discretisation.positions[nodes[along[a]]][d];
  return x;
}

/// As project, for a side of a cell.
Projection project_on_side(Point x, const Discretisation &discretisation, std::size_t cell, unsigned side) {
  const auto nodes = discretisation.nodes_of(cell);
  const auto along = discretisation.element_of(cell).side(side);
  if (discretisation.curved[cell] == 0)
    return project(x, discretisation.positions[nodes[along.front()]], discretisation.positions[nodes[along.back()]]);
  Projection best = {0, std::numeric_limits<double>::max()};
  Point from = discretisation.positions[nodes[along.front()]];
  for (int k = 1; k <= segments_of_curve; ++k) {
    const Point to = point_of_side(discretisation, cell, side, static_cast<double>(k) / segments_of_curve);
    const auto projection = project(x, from, to);
    if (projection.distance_squared < best.distance_squared)
      best = {(k - 1 + projection.parameter) / segments_of_curve, projection.distance_squared};
    from = to;
  }
  return best;
}

double squared_distance(Point x, Point lower, Point upper) {
  const double d0 = std::max({lower[0] - x[0], 0., x[0] - upper[0]});
  const double d1 = std::max({lower[1] - x[1], 0., x[1] - upper[1]});
  return d0 * d0 + d1 * d1;
}
} // namespace

PointLocation::Box PointLocation::box_of(std::size_t cell) const {
  Box box = {{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()},
             {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()}};
  const auto include = [&box](Point x) {
    for (std::size_t d = 0; d < 2; ++d) {
      box.lower[d] = std::min(box.lower[d], x[d]);
      box.upper[d] = std::max(box.upper[d], x[d]);
    }
  };
  const bool curved = discretisation_.curved[cell] != 0;
  const auto corner = corners(discretisation_, cell);
  for (unsigned k = 0; k < discretisation_.n_vertices[cell]; ++k) {
    include(corner[k]);
    for (int i = 1; curved && i < segments_of_curve; ++i)
      include(point_of_side(discretisation_, cell, k, static_cast<double>(i) / segments_of_curve));
  }
  // Between the points of a polygon the side leaves it by less than a hundredth.
  const double margin = (curved ? .01 : 1e-9) * std::max(box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]);
  for (std::size_t d = 0; d < 2; ++d) {
    box.lower[d] -= margin;
    box.upper[d] += margin;
  }
  return box;
}

PointLocation::PointLocation(const Discretisation &discretisation) : discretisation_(discretisation) {
  boxes_.reserve(discretisation.n_cells);
  Point upper{};
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const Box box = box_of(c);
    for (std::size_t d = 0; d < 2; ++d) {
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

/// Newton's method, from the centre; for straight sides with the bilinear or linear map. False if it does
/// not converge, which for a convex cell with straight sides happens only away from it.
bool PointLocation::invert(std::size_t cell, Point point, Point &xi) const {
  if (discretisation_.curved[cell] != 0) {
    xi = discretisation_.element_of(cell).centre();
    return invert_curved(cell, point, xi);
  }
  const auto x = corners(discretisation_, cell);
  const bool triangle = discretisation_.n_vertices[cell] == 3;
  const Point &opposite = triangle ? x[2] : x[3];
  Point a{};
  Point b{};
  Point c{};
  for (std::size_t d = 0; d < 2; ++d) {
    a[d] = x[1][d] - x[0][d];
    b[d] = opposite[d] - x[0][d];
    c[d] = triangle ? 0 : x[2][d] - x[3][d] - a[d];
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
    if (std::abs(s) + std::abs(t) < last_step)
      return true;
  }
  return false;
}

/// Newton's method for the isoparametric map, from the given xi.
bool PointLocation::invert_curved(std::size_t cell, Point point, Point &xi) const {
  const auto nodes = discretisation_.nodes_of(cell);
  const auto &element = discretisation_.element_of(cell);
  ReferenceElement::Values shape, slope_1, slope_2;
  for (int iteration = 0; iteration < 30; ++iteration) {
    element.evaluate(xi, shape, slope_1, slope_2);
    Point residual = point;
    Point d1{};
    Point d2{};
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t d = 0; d < 2; ++d) {
        const double coordinate = discretisation_.positions[nodes[a]][d];
        residual[d] -= shape[a] * coordinate;
        d1[d] += slope_1[a] * coordinate;
        d2[d] += slope_2[a] * coordinate;
      }
    const double determinant = d1[0] * d2[1] - d1[1] * d2[0];
    const double s = (d2[1] * residual[0] - d2[0] * residual[1]) / determinant;
    const double t = (d1[0] * residual[1] - d1[1] * residual[0]) / determinant;
    xi[0] += s;
    xi[1] += t;
    // Far from the element its polynomials grow and lead further away.
    if (!(std::abs(xi[0]) + std::abs(xi[1]) < 10))
      return false;
    if (std::abs(s) + std::abs(t) < last_step)
      return true;
  }
  return false;
}

/// Second try for a curved cell, where Newton.s method may miss from the centre: from the node next to the point.
bool PointLocation::invert_from_node(std::size_t cell, Point point, Point &xi) const {
  const auto nodes = discretisation_.nodes_of(cell);
  const auto distance = [&](unsigned node) {
    return std::hypot(discretisation_.positions[node][0] - point[0], discretisation_.positions[node][1] - point[1]);
  };
  const auto closest =
      std::min_element(nodes.begin(), nodes.end(), [&](unsigned i, unsigned j) { return distance(i) < distance(j); });
  xi = discretisation_.element_of(cell).nodes()[static_cast<std::size_t>(closest - nodes.begin())];
  return invert_curved(cell, point, xi);
}

Location PointLocation::locate(Point point) const {
  if (!std::isfinite(point[0]) || !std::isfinite(point[1]))
    throw InvalidInput(fmt::format("evaluation point ({}, {}) is not finite", discretisation_.origin[0] + point[0],
                                   discretisation_.origin[1] + point[1]));
  const std::size_t bin = static_cast<std::size_t>(bin_of(point[1], 1)) * n_bins_[0] + bin_of(point[0], 0);
  Location location;
  for (const bool second_try : {false, true})
    for (unsigned k = bin_start_[bin]; k < bin_start_[bin + 1]; ++k) {
      const unsigned cell = bin_cells_[k];
      if (squared_distance(point, boxes_[cell].lower, boxes_[cell].upper) > 0 ||
          (second_try && discretisation_.curved[cell] == 0))
        continue;
      const bool found = second_try ? invert_from_node(cell, point, location.xi) : invert(cell, point, location.xi);
      if (found && discretisation_.element_of(cell).contains(location.xi, tolerance)) {
        location.cell = cell;
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
    const auto &element = discretisation_.element_of(cell);
    for (unsigned side = 0; side < element.n_vertices(); ++side) {
      const auto projection = project_on_side(point, discretisation_, cell, side);
      if (projection.distance_squared < best || (projection.distance_squared == best && cell < location.cell)) {
        best = projection.distance_squared;
        location.cell = cell;
        on_border = element.on_side(side, projection.parameter);
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
  const auto &element = discretisation_.element_of(location.cell);
  const bool curved = discretisation_.curved[location.cell] != 0;
  location.xi = on_border;
  const bool inverted =
      curved ? invert_curved(location.cell, point, location.xi) : invert(location.cell, point, location.xi);
  if (!inverted || !element.contains(location.xi, 1))
    location.xi = on_border;
  location.xi = element.limited(location.xi, largest_continuation);
  return location;
}
} // namespace fem_reference::elasticity
