#include "meshless/domain/boundary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::domain {

double BoundaryPiece::length() const { return std::hypot(end[0] - begin[0], end[1] - begin[1]); }

Point2 BoundaryPiece::normal() const {
  const double l = length();
  return {(end[1] - begin[1]) / l, -(end[0] - begin[0]) / l};
}

Boundary::Boundary(std::vector<BoundaryPiece> pieces) : pieces_(std::move(pieces)) {
  if (pieces_.size() < 3)
    throw std::invalid_argument(fmt::format("a boundary needs at least three straight pieces, not {}", pieces_.size()));
  Point2 low = pieces_[0].begin;
  Point2 high = low;
  for (const auto &piece : pieces_)
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min({low[k], piece.begin[k], piece.end[k]});
      high[k] = std::max({high[k], piece.begin[k], piece.end[k]});
    }
  extent_ = std::hypot(high[0] - low[0], high[1] - low[1]);
  // Coordinates far from the origin carry their own rounding.
  const double largest = std::max({std::abs(low[0]), std::abs(low[1]), std::abs(high[0]), std::abs(high[1])});
  tolerance_ = 1e-9 * extent_ + 4e-16 * largest;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto &end = pieces_[i].end;
    if (pieces_[i].length() <= tolerance_)
      throw std::invalid_argument(
          fmt::format("boundary piece {} at ({:.6g}, {:.6g}) has no length", i, end[0], end[1]));
    const bool continued = std::any_of(pieces_.begin(), pieces_.end(), [&](const auto &next) {
      return std::hypot(next.begin[0] - end[0], next.begin[1] - end[1]) <= tolerance_;
    });
    if (!continued)
      throw std::invalid_argument(fmt::format(
          "the boundary is not closed: no piece begins where piece {} ends, at ({:.6g}, {:.6g})", i, end[0], end[1]));
  }
}

bool Boundary::contains(const Point2 &point) const {
  // Winding number by signed crossings of the ray to the right.
  int winding = 0;
  for (const auto &piece : pieces_) {
    const double cross = (piece.end[0] - piece.begin[0]) * (point[1] - piece.begin[1]) -
                         (point[0] - piece.begin[0]) * (piece.end[1] - piece.begin[1]);
    if (piece.begin[1] <= point[1]) {
      if (piece.end[1] > point[1] && cross > 0)
        ++winding;
    } else if (piece.end[1] <= point[1] && cross < 0)
      --winding;
  }
  return winding != 0;
}

double Boundary::distance(const Point2 &point, std::size_t index) const {
  const auto &piece = pieces_[index];
  const double tx = piece.end[0] - piece.begin[0];
  const double ty = piece.end[1] - piece.begin[1];
  const double dx = point[0] - piece.begin[0];
  const double dy = point[1] - piece.begin[1];
  const double t = std::clamp((dx * tx + dy * ty) / (tx * tx + ty * ty), 0.0, 1.0);
  return std::hypot(dx - t * tx, dy - t * ty);
}

std::vector<std::size_t> Boundary::pieces_at(const Point2 &point) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (distance(point, i) <= tolerance_)
      found.push_back(i);
  return found;
}

Boundary rectangle(const Point2 &lower, const Point2 &upper) {
  const Point2 south_east{upper[0], lower[1]};
  const Point2 north_west{lower[0], upper[1]};
  return Boundary({{lower, south_east, 2}, {south_east, upper, 1}, {upper, north_west, 3}, {north_west, lower, 0}});
}

} // namespace meshless::domain
