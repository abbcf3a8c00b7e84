#include "comparisons/geometry/boundary_loops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace comparisons::geometry {

namespace {

using problems::BoundaryPiece;
using problems::Point2;

Point2 minus(const Point2 &a, const Point2 &b) { return {a[0] - b[0], a[1] - b[1]}; }
double cross(const Point2 &a, const Point2 &b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Point2 &a, const Point2 &b) { return a[0] * b[0] + a[1] * b[1]; }
double distance(const Point2 &a, const Point2 &b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Nodes of a mesh file have about 16 digits; what agrees to this is meant to be the same.
constexpr double same = 1e-9;
/// Centres of circles lose digits by the flatness of the edge.
constexpr double same_circle = 1e-6;

bool is_same_part(const RegionEdge &a, const RegionEdge &b) { return a.id == b.id && a.neighbour == b.neighbour; }

/// The circle of an edge by itself, if its middle node is equally far from both ends.
std::optional<Point2> own_circle(const RegionEdge &edge, const std::vector<Point2> &vertices) {
  if (!edge.midpoint)
    return {};
  const Point2 &a = vertices[edge.begin];
  const Point2 &b = vertices[edge.end];
  const double first = distance(a, *edge.midpoint);
  const double second = distance(b, *edge.midpoint);
  if (std::abs(first - second) > same_circle * distance(a, b))
    return {};
  return circle_through(a, *edge.midpoint, b);
}

double signed_turn(const Point2 &a, const Point2 &b) { return std::atan2(cross(a, b), dot(a, b)); }

/// One piece in the making: edges first to last of a loop.
struct Run {
  std::size_t first = 0;
  std::size_t n = 0;
};

/// Decides which edges of a loop are joined.
class Joiner {
public:
  Joiner(const std::vector<RegionEdge> &loop, const std::vector<Point2> &vertices) : loop_(loop), vertices_(vertices) {}

  bool can_join(const RegionEdge &a, const RegionEdge &b) const {
    if (!is_same_part(a, b) || a.circle_centre.has_value() != b.circle_centre.has_value())
      return false;
    if (a.circle_centre)
      return distance(*a.circle_centre, *b.circle_centre) <
             same_circle * distance(*a.circle_centre, vertices_[a.begin]);
    if (a.midpoint || b.midpoint)
      return false;
    const Point2 u = direction(a);
    const Point2 v = direction(b);
    return std::abs(cross(u, v)) < same && dot(u, v) > 0;
  }

  std::vector<Run> runs() const {
    const std::size_t n = loop_.size();
    // Begin where a piece must begin; a full circle begins at its lowest vertex, whichever way it is walked.
    std::size_t start = 0;
    bool found = false;
    for (std::size_t i = 0; i < n && !found; ++i)
      if (!can_join(loop_[(i + n - 1) % n], loop_[i])) {
        start = i;
        found = true;
      }
    if (!found)
      start = static_cast<std::size_t>(std::ranges::min_element(loop_, {}, &RegionEdge::begin) - loop_.begin());
    std::vector<Run> result;
    double turned = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const RegionEdge &edge = loop_[(start + k) % n];
      const double own = sweep(edge);
      const bool joins = !result.empty() && can_join(loop_[(start + k + n - 1) % n], edge) &&
                         turned + own < std::numbers::pi * (1 + same);
      if (!joins) {
        result.push_back({(start + k) % n, 0});
        turned = 0;
      }
      ++result.back().n;
      turned += own;
    }
    return result;
  }

private:
  Point2 direction(const RegionEdge &edge) const {
    const Point2 d = minus(vertices_[edge.end], vertices_[edge.begin]);
    const double length = std::hypot(d[0], d[1]);
    return {d[0] / length, d[1] / length};
  }

  double sweep(const RegionEdge &edge) const {
    if (!edge.circle_centre)
      return 0;
    return std::abs(signed_turn(minus(vertices_[edge.begin], *edge.circle_centre),
                                minus(vertices_[edge.end], *edge.circle_centre)));
  }

  const std::vector<RegionEdge> &loop_;
  const std::vector<Point2> &vertices_;
};

} // namespace

std::optional<Point2> circle_through(const Point2 &a, const Point2 &b, const Point2 &c) {
  const Point2 u = minus(b, a);
  const Point2 v = minus(c, a);
  const double twice = 2 * cross(u, v);
  if (std::abs(twice) <= 1e-14 * (dot(u, u) + dot(v, v)))
    return {};
  const double uu = dot(u, u);
  const double vv = dot(v, v);
  return Point2{a[0] + (v[1] * uu - u[1] * vv) / twice, a[1] + (u[0] * vv - v[0] * uu) / twice};
}

Loops make_loops(std::span<const RegionEdge> edges) {
  Loops result;
  std::map<unsigned, std::size_t> at;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!at.emplace(edges[i].begin, i).second) {
      result.touching_vertex = edges[i].begin;
      return result;
    }
  std::vector<bool> used(edges.size(), false);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (used[i])
      continue;
    auto &loop = result.loops.emplace_back();
    for (std::size_t k = i; !used[k]; k = at.at(edges[k].end)) {
      used[k] = true;
      loop.push_back(edges[k]);
    }
  }
  return result;
}

void find_circles(std::vector<RegionEdge> &loop, const std::vector<Point2> &vertices) {
  const std::size_t n = loop.size();
  std::vector<std::optional<Point2>> circles(n);
  for (std::size_t i = 0; i < n; ++i)
    circles[i] = own_circle(loop[i], vertices);
  const auto agree = [&](std::size_t i, std::size_t j) {
    return circles[i] && circles[j] &&
           distance(*circles[i], *circles[j]) < same_circle * distance(*circles[i], vertices[loop[i].begin]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const std::size_t after = (i + 1) % n;
    const bool alone = !is_same_part(loop[i], loop[before]) && !is_same_part(loop[i], loop[after]);
    if (circles[i] && (alone || agree(i, before) || agree(i, after)))
      loop[i].circle_centre = circles[i];
  }
}

std::vector<BoundaryPiece> make_pieces(const std::vector<RegionEdge> &loop, const std::vector<Point2> &vertices) {
  std::vector<BoundaryPiece> pieces;
  const std::size_t n = loop.size();
  for (const Run &run : Joiner(loop, vertices).runs()) {
    const RegionEdge &first = loop[run.first];
    const RegionEdge &last = loop[(run.first + run.n - 1) % n];
    BoundaryPiece piece{vertices[first.begin], vertices[last.end], first.id, first.name};
    if (first.midpoint) {
      // The circle anew from three points of the whole piece: both ends are then equally far from its centre.
      const RegionEdge &middle = loop[(run.first + run.n / 2) % n];
      const Point2 on_it = run.n == 1 ? *first.midpoint : vertices[middle.begin];
      if (const auto centre = circle_through(piece.begin, on_it, piece.end))
        piece.arc = problems::Arc{*centre, cross(minus(on_it, piece.begin), minus(piece.end, on_it)) > 0};
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

void find_approximations(const std::vector<RegionEdge> &loop, const std::vector<Point2> &vertices,
                         std::vector<StraightApproximation> &found) {
  constexpr double degree = std::numbers::pi / 180;
  const std::size_t n = loop.size();
  std::vector<bool> turns(n, false); // the edge turns against the one before or after it
  std::vector<double> turn(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto &a = loop[i];
    const auto &b = loop[(i + 1) % n];
    if (a.midpoint || b.midpoint || !is_same_part(a, b))
      continue;
    const double angle =
        std::abs(signed_turn(minus(vertices[a.end], vertices[a.begin]), minus(vertices[b.end], vertices[b.begin])));
    if (angle < 0.5 * degree || angle > 50 * degree)
      continue;
    turns[i] = turns[(i + 1) % n] = true;
    turn[i] = angle;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!turns[i])
      continue;
    auto entry = std::ranges::find(found, loop[i].name, &StraightApproximation::name);
    if (entry == found.end())
      entry = found.insert(found.end(), {loop[i].name, 0, 0});
    ++entry->n_pieces;
    entry->largest_turn = std::max(entry->largest_turn, turn[i]);
  }
}

} // namespace comparisons::geometry
