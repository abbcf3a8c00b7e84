#include "meshless/domain/boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshless::domain {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

Point2 minus(const Point2 &a, const Point2 &b) { return {a[0] - b[0], a[1] - b[1]}; }
double dot(const Point2 &a, const Point2 &b) { return a[0] * b[0] + a[1] * b[1]; }
double cross(const Point2 &a, const Point2 &b) { return a[0] * b[1] - a[1] * b[0]; }

/// Angle from a to b in the given sense, in [0, 2 pi).
double turn(const Point2 &a, const Point2 &b, bool counter_clockwise) {
  const double angle = std::atan2(cross(a, b), dot(a, b));
  const double turned = counter_clockwise ? angle : -angle;
  return turned < 0 ? turned + full_turn : turned;
}

} // namespace

double BoundaryPiece::radius() const {
  const Point2 a = minus(begin, arc->centre);
  const Point2 b = minus(end, arc->centre);
  return 0.5 * (std::hypot(a[0], a[1]) + std::hypot(b[0], b[1]));
}

double BoundaryPiece::sweep() const {
  return turn(minus(begin, arc->centre), minus(end, arc->centre), arc->counter_clockwise);
}

double BoundaryPiece::length() const {
  return arc ? radius() * sweep() : std::hypot(end[0] - begin[0], end[1] - begin[1]);
}

Point2 BoundaryPiece::point(double t) const {
  if (t <= 0)
    return begin;
  if (t >= 1)
    return end;
  if (!arc)
    return {begin[0] + t * (end[0] - begin[0]), begin[1] + t * (end[1] - begin[1])};
  // Turned from the nearer end, so that the ends are met to the last bit.
  const bool from_begin = t < 0.5;
  const double angle = (arc->counter_clockwise ? 1 : -1) * sweep() * (from_begin ? t : t - 1);
  const Point2 from = minus(from_begin ? begin : end, arc->centre);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {arc->centre[0] + c * from[0] - s * from[1], arc->centre[1] + s * from[0] + c * from[1]};
}

Point2 BoundaryPiece::normal(double t) const {
  if (!arc) {
    const double l = length();
    return {(end[1] - begin[1]) / l, -(end[0] - begin[0]) / l};
  }
  const Point2 outwards = minus(point(t), arc->centre);
  const double r = (arc->counter_clockwise ? 1 : -1) * std::hypot(outwards[0], outwards[1]);
  return {outwards[0] / r, outwards[1] / r};
}

Point2 BoundaryPiece::tangent(double t) const {
  const Point2 n = normal(t);
  return {-n[1], n[0]};
}

double BoundaryPiece::nearest(const Point2 &x) const {
  if (!arc) {
    const Point2 along = minus(end, begin);
    return std::clamp(dot(minus(x, begin), along) / dot(along, along), 0.0, 1.0);
  }
  const double whole = sweep();
  const double angle = turn(minus(begin, arc->centre), minus(x, arc->centre), arc->counter_clockwise);
  if (angle <= whole)
    return angle / whole;
  // Beyond the end or before the beginning: whichever is nearer by the angle.
  return angle - whole < full_turn - angle ? 1.0 : 0.0;
}

double BoundaryPiece::distance(const Point2 &x) const {
  if (arc) {
    const Point2 from = minus(x, arc->centre);
    const double angle = turn(minus(begin, arc->centre), from, arc->counter_clockwise);
    if (angle <= sweep())
      return std::abs(std::hypot(from[0], from[1]) - radius());
    return std::min(std::hypot(x[0] - begin[0], x[1] - begin[1]), std::hypot(x[0] - end[0], x[1] - end[1]));
  }
  const double t = nearest(x);
  return std::hypot(x[0] - begin[0] - t * (end[0] - begin[0]), x[1] - begin[1] - t * (end[1] - begin[1]));
}

} // namespace meshless::domain
