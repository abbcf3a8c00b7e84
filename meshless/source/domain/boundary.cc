#include "meshless/domain/boundary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace meshless::domain {

namespace {

/// Extremes of the arc's circle in the four axis directions that the arc passes through.
template <typename Visit>
void for_each_extreme(const BoundaryPiece &piece, Visit visit) {
  const double r = piece.radius();
  const Point2 c = piece.arc->centre;
  for (const Point2 &direction : {Point2{1, 0}, Point2{0, 1}, Point2{-1, 0}, Point2{0, -1}}) {
    const Point2 extreme{c[0] + r * direction[0], c[1] + r * direction[1]};
    const double t = piece.nearest(extreme);
    if (t > 0 && t < 1)
      visit(direction, extreme, t);
  }
}

struct Box {
  Point2 lower;
  Point2 upper;
};

Box box_of(const BoundaryPiece &piece) {
  Box box{piece.begin, piece.begin};
  const auto include = [&](const Point2 &p) {
    for (std::size_t k = 0; k < 2; ++k) {
      box.lower[k] = std::min(box.lower[k], p[k]);
      box.upper[k] = std::max(box.upper[k], p[k]);
    }
  };
  include(piece.end);
  if (piece.arc)
    for_each_extreme(piece, [&](const Point2 &, const Point2 &extreme, double) { include(extreme); });
  return box;
}

/// Compressed rows from (row, member) pairs that `visit` calls its argument with, twice.
template <typename VisitAll>
void compress(std::size_t n_rows, VisitAll visit_all, std::vector<std::size_t> &offsets,
              std::vector<std::size_t> &members) {
  offsets.assign(n_rows + 1, 0);
  visit_all([&](std::size_t row, std::size_t) { ++offsets[row + 1]; });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  members.resize(offsets.back());
  std::vector<std::size_t> at(offsets.begin(), offsets.end() - 1);
  visit_all([&](std::size_t row, std::size_t member) { members[at[row]++] = member; });
}

std::ptrdiff_t bin(double x, double lower, double size, std::ptrdiff_t n) {
  return static_cast<std::ptrdiff_t>(std::clamp((x - lower) / size, 0.0, static_cast<double>(n - 1)));
}

} // namespace

Boundary::Boundary(std::vector<BoundaryPiece> pieces) : pieces_(std::move(pieces)) {
  const bool curved = std::any_of(pieces_.begin(), pieces_.end(), [](const auto &p) { return p.arc.has_value(); });
  if (pieces_.size() < (curved ? 2u : 3u))
    throw std::invalid_argument(
        fmt::format("a boundary needs at least three straight pieces, or two with an arc, not {}", pieces_.size()));
  for (const auto &piece : pieces_)
    for (const double x : {piece.begin[0], piece.begin[1], piece.end[0], piece.end[1]})
      if (!std::isfinite(x))
        throw std::invalid_argument("a boundary piece has an end that is not finite");
  find_bounds();
  check_pieces();
  link();
  make_strips();
  make_grid();
}

void Boundary::find_bounds() {
  lower_ = upper_ = pieces_[0].begin;
  for (const auto &piece : pieces_) {
    const Box box = box_of(piece);
    for (std::size_t k = 0; k < 2; ++k) {
      lower_[k] = std::min(lower_[k], box.lower[k]);
      upper_[k] = std::max(upper_[k], box.upper[k]);
    }
  }
  extent_ = std::hypot(upper_[0] - lower_[0], upper_[1] - lower_[1]);
  // Coordinates far from the origin carry their own rounding.
  const double largest = std::max({std::abs(lower_[0]), std::abs(lower_[1]), std::abs(upper_[0]), std::abs(upper_[1])});
  tolerance_ = 1e-9 * extent_ + 4e-16 * largest;
}

void Boundary::check_pieces() const {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto &piece = pieces_[i];
    if (std::hypot(piece.end[0] - piece.begin[0], piece.end[1] - piece.begin[1]) <= tolerance_)
      throw std::invalid_argument(fmt::format("boundary piece {} at ({:.6g}, {:.6g}) has no length{}", i, piece.end[0],
                                              piece.end[1], piece.arc ? ": give a full circle as two arcs" : ""));
    if (!piece.arc)
      continue;
    const auto &c = piece.arc->centre;
    const double a = std::hypot(piece.begin[0] - c[0], piece.begin[1] - c[1]);
    const double b = std::hypot(piece.end[0] - c[0], piece.end[1] - c[1]);
    if (!(std::abs(a - b) <= tolerance_))
      throw std::invalid_argument(
          fmt::format("boundary piece {}: the ends of an arc are {:.6g} and {:.6g} m from its centre", i, a, b));
  }
}

void Boundary::link() {
  const std::size_t n = pieces_.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return pieces_[a].begin[0] < pieces_[b].begin[0]; });
  next_.assign(n, n);
  std::vector<bool> taken(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 &end = pieces_[i].end;
    auto at = std::lower_bound(order.begin(), order.end(), end[0] - tolerance_,
                               [&](std::size_t k, double x) { return pieces_[k].begin[0] < x; });
    for (; at != order.end() && pieces_[*at].begin[0] <= end[0] + tolerance_; ++at) {
      const auto &begin = pieces_[*at].begin;
      const auto &back = pieces_[*at].end;
      // Particles on one face would see those on the other: the body would be whole, and nothing would say so.
      if (!pieces_[i].arc && !pieces_[*at].arc && std::hypot(begin[0] - end[0], begin[1] - end[1]) <= tolerance_ &&
          std::hypot(back[0] - pieces_[i].begin[0], back[1] - pieces_[i].begin[1]) <= tolerance_)
        throw std::invalid_argument(
            fmt::format("boundary pieces {} and {} lie on each other up to ({:.6g}, {:.6g}): a slit of no width cannot "
                        "be represented; open it by a small angle or width",
                        i, *at, end[0], end[1]));
      // Where two loops touch, each piece is the successor of one.
      if (!taken[*at] && std::hypot(begin[0] - end[0], begin[1] - end[1]) <= tolerance_) {
        next_[i] = *at;
        taken[*at] = true;
        break;
      }
    }
    if (next_[i] == n)
      throw std::invalid_argument(fmt::format(
          "the boundary is not closed: no piece begins where piece {} ends, at ({:.6g}, {:.6g})", i, end[0], end[1]));
  }
  lengths_.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    lengths_[i] = pieces_[i].length();
  loops_.assign(n, n);
  starts_.assign(n, 0);
  for (std::size_t first = 0; first < n; ++first) {
    if (loops_[first] != n)
      continue;
    double length = 0;
    for (std::size_t i = first; loops_[i] == n; i = next_[i]) {
      loops_[i] = loop_lengths_.size();
      starts_[i] = length;
      length += lengths_[i];
    }
    loop_lengths_.push_back(length);
  }
}

void Boundary::make_strips() {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto &piece = pieces_[i];
    if (!piece.arc) {
      monotone_.push_back({piece.begin[1], piece.end[1], i, 0});
      continue;
    }
    std::vector<std::pair<double, double>> cuts{{0.0, piece.begin[1]}}; // parameter, x2
    for_each_extreme(piece, [&](const Point2 &direction, const Point2 &extreme, double t) {
      if (direction[1] != 0)
        cuts.emplace_back(t, extreme[1]);
    });
    cuts.emplace_back(1.0, piece.end[1]);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Point2 middle = piece.point(0.5 * (cuts[k].first + cuts[k + 1].first));
      monotone_.push_back({cuts[k].second, cuts[k + 1].second, i, middle[0] >= piece.arc->centre[0] ? 1 : -1});
    }
  }
  const auto n = static_cast<std::ptrdiff_t>(monotone_.size());
  const double height = (upper_[1] - lower_[1]) / static_cast<double>(n);
  compress(
      monotone_.size(),
      [&](auto &&insert) {
        for (std::size_t m = 0; m < monotone_.size(); ++m) {
          const auto [low, high] = std::minmax(monotone_[m].begin, monotone_[m].end);
          for (auto s = bin(low, lower_[1], height, n); s <= bin(high, lower_[1], height, n); ++s)
            insert(static_cast<std::size_t>(s), m);
        }
      },
      strip_offsets_, strip_members_);
}

void Boundary::make_grid() {
  const double wide = upper_[0] - lower_[0];
  const double high = upper_[1] - lower_[1];
  const double n = static_cast<double>(pieces_.size());
  cell_size_ = std::max({std::sqrt(wide * high / n), wide / (4 * n), high / (4 * n)});
  n_cells_ = {1 + static_cast<std::ptrdiff_t>(wide / cell_size_), 1 + static_cast<std::ptrdiff_t>(high / cell_size_)};
  compress(
      static_cast<std::size_t>(n_cells_[0] * n_cells_[1]),
      [&](auto &&insert) {
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
          const Box box = box_of(pieces_[i]);
          for (auto y = bin(box.lower[1], lower_[1], cell_size_, n_cells_[1]);
               y <= bin(box.upper[1], lower_[1], cell_size_, n_cells_[1]); ++y)
            for (auto x = bin(box.lower[0], lower_[0], cell_size_, n_cells_[0]);
                 x <= bin(box.upper[0], lower_[0], cell_size_, n_cells_[0]); ++x)
              insert(static_cast<std::size_t>(y * n_cells_[0] + x), i);
        }
      },
      cell_offsets_, cell_members_);
}

bool Boundary::contains(const Point2 &point) const {
  if (!(point[1] >= lower_[1]) || !(point[1] <= upper_[1]))
    return false;
  // Winding number by signed crossings of the ray to the right.
  int winding = 0;
  const auto n = static_cast<std::ptrdiff_t>(monotone_.size());
  const auto strip =
      static_cast<std::size_t>(bin(point[1], lower_[1], (upper_[1] - lower_[1]) / static_cast<double>(n), n));
  for (std::size_t k = strip_offsets_[strip]; k < strip_offsets_[strip + 1]; ++k) {
    const Monotone &part = monotone_[strip_members_[k]];
    const bool rises = part.begin <= point[1] && part.end > point[1];
    const bool falls = part.end <= point[1] && part.begin > point[1];
    if (!rises && !falls)
      continue;
    const auto &piece = pieces_[part.piece];
    double x = 0;
    if (part.half == 0)
      x = piece.begin[0] +
          (point[1] - piece.begin[1]) / (piece.end[1] - piece.begin[1]) * (piece.end[0] - piece.begin[0]);
    else {
      const double r = piece.radius();
      const double dy = point[1] - piece.arc->centre[1];
      x = piece.arc->centre[0] + part.half * std::sqrt(std::max(0.0, (r - dy) * (r + dy)));
    }
    if (point[0] < x)
      winding += rises ? 1 : -1;
  }
  return winding != 0;
}

void Boundary::pieces_within(const Point2 &point, double radius, std::vector<std::size_t> &result) const {
  result.clear();
  const auto first = [&](std::size_t k) { return bin(point[k] - radius, lower_[k], cell_size_, n_cells_[k]); };
  const auto last = [&](std::size_t k) { return bin(point[k] + radius, lower_[k], cell_size_, n_cells_[k]); };
  for (auto y = first(1); y <= last(1); ++y)
    for (auto x = first(0); x <= last(0); ++x) {
      const auto cell = static_cast<std::size_t>(y * n_cells_[0] + x);
      for (std::size_t k = cell_offsets_[cell]; k < cell_offsets_[cell + 1]; ++k)
        result.push_back(cell_members_[k]);
    }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](std::size_t i) { return !(pieces_[i].distance(point) < radius); });
}

std::vector<std::size_t> Boundary::pieces_at(const Point2 &point) const {
  std::vector<std::size_t> found;
  // The next number after the tolerance: a piece exactly at the tolerance counts.
  pieces_within(point, std::nextafter(tolerance_, std::numeric_limits<double>::max()), found);
  return found;
}

double Boundary::distance(const Point2 &point) const {
  // Circles that double until one reaches a piece; the nearest piece is then among those within.
  std::vector<std::size_t> found;
  for (double radius = cell_size_;; radius *= 2) {
    pieces_within(point, radius, found);
    if (found.empty())
      continue;
    double least = radius;
    for (const std::size_t i : found)
      least = std::min(least, pieces_[i].distance(point));
    return least;
  }
}

double Boundary::distance_along_loop(std::size_t loop, double from, double to) const {
  const double forward = std::abs(to - from);
  return std::min(forward, loop_lengths_[loop] - forward);
}

Boundary rectangle(const Point2 &lower, const Point2 &upper) {
  const Point2 south_east{upper[0], lower[1]};
  const Point2 north_west{lower[0], upper[1]};
  return Boundary({{lower, south_east, 2}, {south_east, upper, 1}, {upper, north_west, 3}, {north_west, lower, 0}});
}

} // namespace meshless::domain
