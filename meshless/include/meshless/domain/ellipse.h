#pragma once

#include "meshless/domain/boundary.h"

#include <cmath>

namespace meshless::domain {

/// The size and shape of a local subdomain: offsets d from its centre with |d|^2 + (f . d)^2 <= radius^2. Without a
/// flattening f it is a disc; with f it is sqrt(1 + |f|^2) times as short along f.
///
/// The linear map d -> d + (sqrt(1 + |f|^2) - 1) f (f . d) / |f|^2 stretches it to the disc of its radius.
struct Ellipse {
  Ellipse(double radius_, const Point2 &flattening_ = {}) // NOLINT(google-explicit-constructor): a disc is one
      : radius(radius_), flattening(flattening_) {}

  double radius; ///< half of its length, m
  Point2 flattening;

  bool round() const { return flattening[0] == 0 && flattening[1] == 0; }
  /// Length over width.
  double aspect() const { return std::sqrt(1 + squared(flattening)); }
  /// From the centre to the edge in the unit `direction`, m.
  double reach(const Point2 &direction) const {
    if (round())
      return radius;
    const double along = dot(flattening, direction);
    return radius / std::sqrt(1 + along * along);
  }

  /// A linear map with a symmetric matrix, for many offsets.
  struct Map {
    double xx = 1, xy = 0, yy = 1;
    Point2 operator()(const Point2 &d) const { return {xx * d[0] + xy * d[1], xy * d[0] + yy * d[1]}; }
  };
  Map stretching() const { return round() ? Map{} : scaling_along(aspect()); }
  Map compressing() const { return round() ? Map{} : scaling_along(1 / aspect()); }
  Point2 stretched(const Point2 &d) const { return stretching()(d); }
  Point2 compressed(const Point2 &d) const { return compressing()(d); }

private:
  static double dot(const Point2 &a, const Point2 &b) { return a[0] * b[0] + a[1] * b[1]; }
  static double squared(const Point2 &a) { return dot(a, a); }
  Map scaling_along(double factor) const {
    const double along = (factor - 1) / squared(flattening);
    return {1 + along * flattening[0] * flattening[0], along * flattening[0] * flattening[1],
            1 + along * flattening[1] * flattening[1]};
  }
};

} // namespace meshless::domain
