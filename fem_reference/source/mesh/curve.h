#pragma once

#include "fem_reference/mesh/plane_mesh.h"

#include <cmath>

namespace fem_reference::mesh {
/// A curved edge from `begin` (t = 0) to `end` (t = 1).
struct Curve {
  enum class Kind { arc, parabola };

  Kind kind = Kind::arc;
  Point begin{};
  Point end{};
  Point control{}; ///< centre of the arc, or point of the parabola at t = 1/2

  /// On an arc t is the fraction of the angle. Where both ends are not at exactly one distance from
  /// the centre, as in rounded files, the radius is interpolated.
  Point at(double t) const {
    if (kind == Kind::parabola) {
      const double a = (1 - t) * (1 - 2 * t);
      const double b = 4 * t * (1 - t);
      const double c = t * (2 * t - 1);
      return {a * begin[0] + b * control[0] + c * end[0], a * begin[1] + b * control[1] + c * end[1]};
    }
    const Point from = {begin[0] - control[0], begin[1] - control[1]};
    const Point to = {end[0] - control[0], end[1] - control[1]};
    const double angle = t * std::atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
    const double stretch = 1 + t * (std::hypot(to[0], to[1]) / std::hypot(from[0], from[1]) - 1);
    const double cosine = stretch * std::cos(angle);
    const double sine = stretch * std::sin(angle);
    return {control[0] + cosine * from[0] - sine * from[1], control[1] + sine * from[0] + cosine * from[1]};
  }

  /// How far the curve leaves its chord at t.
  Point deviation(double t) const {
    const Point x = at(t);
    return {x[0] - begin[0] - t * (end[0] - begin[0]), x[1] - begin[1] - t * (end[1] - begin[1])};
  }

  Curve reversed() const { return {kind, end, begin, control}; }

  Curve relative_to(Point origin) const {
    Curve curve = *this;
    for (auto *point : {&curve.begin, &curve.end, &curve.control})
      *point = {(*point)[0] - origin[0], (*point)[1] - origin[1]};
    return curve;
  }
};
} // namespace fem_reference::mesh
