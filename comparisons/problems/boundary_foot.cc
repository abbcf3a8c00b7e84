#include "comparisons/problems/boundary_foot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace comparisons::problems {

Point2 nearest_on(const BoundaryPiece &piece, const Point2 &x) {
  if (!piece.arc) {
    const Point2 d{piece.end[0] - piece.begin[0], piece.end[1] - piece.begin[1]};
    const double t = ((x[0] - piece.begin[0]) * d[0] + (x[1] - piece.begin[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    const double within = std::clamp(t, 0.0, 1.0);
    return {piece.begin[0] + within * d[0], piece.begin[1] + within * d[1]};
  }
  const Point2 &c = piece.arc->centre;
  const double sign = piece.arc->counter_clockwise ? 1 : -1;
  const auto angle_from_begin = [&](const Point2 &p) {
    const Point2 u{piece.begin[0] - c[0], piece.begin[1] - c[1]};
    const Point2 v{p[0] - c[0], p[1] - c[1]};
    const double angle = sign * std::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
  };
  if (angle_from_begin(x) <= angle_from_begin(piece.end)) {
    const double radius = std::hypot(piece.begin[0] - c[0], piece.begin[1] - c[1]);
    const double distance = std::hypot(x[0] - c[0], x[1] - c[1]);
    return {c[0] + radius * (x[0] - c[0]) / distance, c[1] + radius * (x[1] - c[1]) / distance};
  }
  const auto distance = [&](const Point2 &p) { return std::hypot(p[0] - x[0], p[1] - x[1]); };
  return distance(piece.begin) < distance(piece.end) ? piece.begin : piece.end;
}

} // namespace comparisons::problems
