#include "interior_start.h"

#include "meshless/cloud_generation/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace meshless::cloud_generation {

namespace {

constexpr double most_particles = 1e7;
/// Samples an axis of a cell that the boundary may cut.
constexpr int samples = 6;
constexpr std::uint32_t resolution = 1u << 30;

/// Place of (x, y) < resolution along Hilbert's curve.
std::uint64_t hilbert(std::uint32_t x, std::uint32_t y) {
  std::uint64_t order = 0;
  for (std::uint32_t half = resolution / 2; half > 0; half /= 2) {
    const std::uint32_t right = (x & half) != 0 ? 1 : 0;
    const std::uint32_t up = (y & half) != 0 ? 1 : 0;
    order = 4 * order + ((3 * right) ^ up);
    if (up == 0) {
      if (right == 1) {
        x = resolution - 1 - x;
        y = resolution - 1 - y;
      }
      std::swap(x, y);
    }
  }
  return order;
}

Point2 sample(const Point2 &lower, double size, int i, int j) {
  return {lower[0] + size * (i + 0.5) / samples, lower[1] + size * (j + 0.5) / samples};
}

} // namespace

InteriorCells::InteriorCells(const domain::Boundary &region, const Spacing &spacing, double scale, int deepest)
    : region_(region) {
  const Point2 lower = region.lower();
  const double side = std::max(region.upper()[0] - lower[0], region.upper()[1] - lower[1]);
  const double per_area = 2 / std::numbers::sqrt3;
  std::vector<Cell> open{{lower, side, 0, 0, false}};
  std::vector<Point2> middles;
  std::vector<Cell> finer;
  std::vector<std::size_t> near;
  for (int depth = 0; !open.empty(); ++depth) {
    // Only where the region is does the spacing have to be known: a cell outside is dropped, and one that is
    // cut asks at a point inside.
    middles.clear();
    std::vector<Cell> kept;
    for (Cell cell : open) {
      const Point2 middle{cell.lower[0] + 0.5 * cell.size, cell.lower[1] + 0.5 * cell.size};
      region.pieces_within(middle, 0.71 * cell.size, near);
      cell.whole = near.empty();
      Point2 inside = middle;
      if (cell.whole) {
        if (!region.contains(middle))
          continue;
        cell.n = 1;
      } else {
        int n_inside = 0;
        for (int i = 0; i < samples; ++i)
          for (int j = 0; j < samples; ++j)
            if (const Point2 x = sample(cell.lower, cell.size, i, j); region.contains(x)) {
              inside = x;
              ++n_inside;
            }
        cell.n = static_cast<double>(n_inside) / (samples * samples);
        // A thin part of the region may hide between the samples of a large cell.
        if (n_inside == 0 && !region.contains(middle)) {
          const auto &piece = region.pieces()[near[0]];
          inside = piece.point(piece.nearest(middle));
        }
      }
      kept.push_back(cell);
      middles.push_back(inside);
    }
    const auto s = spacing.at(middles);
    // Told before the cells fill the memory; coarse cells know their number only roughly.
    double expected = total_;
    for (std::size_t i = 0; i < kept.size(); ++i)
      expected += kept[i].n * per_area * kept[i].size * kept[i].size / (s[i] * s[i]);
    if (depth >= 6 && expected > 2 * most_particles * scale * scale)
      throw std::invalid_argument(fmt::format("the spacing asks for about {:.1e} particles; at most {:.0e}",
                                              expected / (scale * scale), most_particles));
    finer.clear();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      Cell cell = kept[i];
      if (cell.size > 0.5 * scale * s[i] && depth < deepest) {
        for (int k = 0; k < 4; ++k)
          finer.push_back({{cell.lower[0] + 0.5 * cell.size * (k % 2), cell.lower[1] + 0.5 * cell.size * (k / 2)},
                           0.5 * cell.size,
                           0,
                           0,
                           false});
        continue;
      }
      cell.n *= per_area * cell.size * cell.size / (s[i] * s[i]);
      if (cell.n == 0)
        continue;
      const auto place = [&](std::size_t d) {
        return static_cast<std::uint32_t>((cell.lower[d] + 0.5 * cell.size - lower[d]) / side * resolution);
      };
      cell.order = hilbert(place(0), place(1));
      total_ += cell.n;
      cells_.push_back(cell);
    }
    std::swap(open, finer);
  }
  std::sort(cells_.begin(), cells_.end(), [](const Cell &a, const Cell &b) { return a.order < b.order; });
}

std::vector<Point2> InteriorCells::places(std::size_t n, std::uint64_t seed) const {
  Random random(seed);
  std::vector<Point2> points;
  points.reserve(n);
  double so_far = 0;
  for (const Cell &cell : cells_) {
    so_far += cell.n;
    // The last one must not be lost to rounding.
    while (points.size() < n &&
           (so_far * static_cast<double>(n) >= (static_cast<double>(points.size()) + 0.5) * total_)) {
      Point2 x{};
      bool inside = false;
      for (int attempt = 0; attempt < 20 && !inside; ++attempt) {
        x = {cell.lower[0] + cell.size * random.uniform(), cell.lower[1] + cell.size * random.uniform()};
        inside = cell.whole || (region_.contains(x) && region_.distance(x) > 0.02 * cell.size);
      }
      for (int k = 0; k < samples * samples && !inside; ++k) {
        x = sample(cell.lower, cell.size, k % samples, k / samples);
        inside = region_.contains(x);
      }
      points.push_back(x);
    }
  }
  return points;
}

} // namespace meshless::cloud_generation
