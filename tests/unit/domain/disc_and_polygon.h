#pragma once

#include "meshless/domain/boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// Integrals over the part of a disc inside a polygon, by the divergence theorem: along the edges
/// inside the disc and the arcs inside the polygon. No rays, no wedges, no code of meshless/domain.
namespace disc_and_polygon {

using meshless::domain::BoundaryPiece;
using meshless::domain::Point2;

/// 5 Gauss points on each of 20 equal parts of [0, 1]: degree 9 per part.
template <typename F>
double integrate(const F &f) {
  const double inner = std::sqrt(5 - 2 * std::sqrt(10. / 7)) / 3;
  const double outer = std::sqrt(5 + 2 * std::sqrt(10. / 7)) / 3;
  const double points[] = {-outer, -inner, 0, inner, outer};
  const double weights[] = {(322 - 13 * std::sqrt(70.)) / 900, (322 + 13 * std::sqrt(70.)) / 900, 128. / 225,
                            (322 + 13 * std::sqrt(70.)) / 900, (322 - 13 * std::sqrt(70.)) / 900};
  double sum = 0;
  for (int part = 0; part < 20; ++part)
    for (int q = 0; q < 5; ++q)
      sum += weights[q] / 40 * f((part + .5 * (1 + points[q])) / 20);
  return sum;
}

inline double power(double x, int n) {
  double product = 1;
  for (int i = 0; i < n; ++i)
    product *= x;
  return product;
}

/// By the number of edges above the point.
inline bool inside(std::span<const BoundaryPiece> pieces, const Point2 &x) {
  bool odd = false;
  for (const auto &piece : pieces) {
    const auto &a = piece.begin;
    const auto &b = piece.end;
    if ((a[0] <= x[0]) != (b[0] <= x[0]) && a[1] + (x[0] - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) > x[1])
      odd = !odd;
  }
  return odd;
}

/// Parameters at which the line of the piece crosses the circle, confined to the piece.
inline std::array<double, 2> inside_disc(const BoundaryPiece &piece, const Point2 &centre, double radius) {
  const Point2 u{piece.end[0] - piece.begin[0], piece.end[1] - piece.begin[1]};
  const Point2 v{piece.begin[0] - centre[0], piece.begin[1] - centre[1]};
  const double a = u[0] * u[0] + u[1] * u[1];
  const double b = u[0] * v[0] + u[1] * v[1];
  const double root = b * b - a * (v[0] * v[0] + v[1] * v[1] - radius * radius);
  // A circle that touches the line to rounding has no chord: neglecting one of 1e-6 radii costs 1e-18.
  if (root <= 1e-12 * a * radius * radius)
    return {0, 0};
  return {std::clamp((-b - std::sqrt(root)) / a, 0., 1.), std::clamp((-b + std::sqrt(root)) / a, 0., 1.)};
}

/// Integral of x^a y^b, measured from the centre in units of the radius, over disc and polygon; m^2.
inline double moment(std::span<const BoundaryPiece> pieces, const Point2 &centre, double radius, int a, int b) {
  // div (x^(a+1) / (a+1) y^b, 0) = x^a y^b
  const auto flux = [&](double x, double y) { return power(x, a + 1) / (a + 1) * power(y, b); };
  double sum = 0;
  std::vector<double> angles{0, 2 * std::numbers::pi};
  for (const auto &piece : pieces) {
    const auto [begin, end] = inside_disc(piece, centre, radius);
    if (begin >= end)
      continue;
    const double l1 = (piece.end[0] - piece.begin[0]) / radius;
    const double l2 = (piece.end[1] - piece.begin[1]) / radius;
    const double x = (piece.begin[0] - centre[0]) / radius;
    const double y = (piece.begin[1] - centre[1]) / radius;
    sum += integrate([&](double t) {
      const double s = begin + t * (end - begin);
      return (end - begin) * l2 * flux(x + s * l1, y + s * l2); // n1 ds = dy
    });
    for (const double t : {begin, end}) {
      const double angle = std::atan2(y + t * l2, x + t * l1);
      angles.push_back(angle < 0 ? angle + 2 * std::numbers::pi : angle);
    }
  }
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double width = angles[i + 1] - angles[i];
    // Not the midpoint: symmetric cases touch the polygon there.
    const double middle = angles[i] + .47 * width;
    if (inside(pieces, {centre[0] + radius * std::cos(middle), centre[1] + radius * std::sin(middle)}))
      sum += integrate([&](double t) {
        const double angle = angles[i] + t * width;
        return width * std::cos(angle) * flux(std::cos(angle), std::sin(angle));
      });
  }
  return sum * radius * radius;
}

} // namespace disc_and_polygon
