#include "meshless/domain/local_subdomain.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace meshless::domain {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

double dot(const Point2 &a, const Point2 &b) { return a[0] * b[0] + a[1] * b[1]; }
double cross(const Point2 &a, const Point2 &b) { return a[0] * b[1] - a[1] * b[0]; }
Point2 minus(const Point2 &a, const Point2 &b) { return {a[0] - b[0], a[1] - b[1]}; }

/// Part of a segment inside a disc, as parameters in [0, 1], and that of the nearest point.
struct Chord {
  double begin;
  double end;
  double nearest;
};

std::optional<Chord> chord(const BoundaryPiece &piece, const Point2 &centre, double radius, double tolerance) {
  const Point2 along = minus(piece.end, piece.begin);
  const Point2 from = minus(piece.begin, centre);
  const double length = piece.length();
  const double nearest = -dot(along, from) / (length * length);
  const double distance = std::abs(cross(along, from)) / length;
  if (distance >= radius)
    return {};
  const double half = std::sqrt((radius - distance) * (radius + distance)) / length;
  const Chord result{std::max(0.0, nearest - half), std::min(1.0, nearest + half), nearest};
  if (result.end - result.begin <= tolerance / length)
    return {};
  return result;
}

/// Distance along the ray from centre in `direction` to the line of the piece, or nothing if it
/// does not meet the piece.
std::optional<double> crossing(const BoundaryPiece &piece, const Point2 &centre, const Point2 &direction,
                               double tolerance) {
  const Point2 along = minus(piece.end, piece.begin);
  const Point2 from = minus(piece.begin, centre);
  const double denominator = cross(direction, along);
  const double length = piece.length();
  if (std::abs(denominator) <= 1e-14 * length)
    return {}; // parallel: such a ray is a break point, not inside a wedge
  const double t = cross(from, direction) / denominator;
  const double r = cross(from, along) / denominator;
  // Rays through an end of a piece are break points too; the slack only guards against rounding.
  const double slack = tolerance / length;
  if (t < -slack || t > 1 + slack || r <= tolerance)
    return {};
  return r;
}

double angle_of(const Point2 &v) {
  const double angle = std::atan2(v[1], v[0]);
  return angle < 0 ? angle + full_turn : angle;
}

} // namespace

void SubdomainQuadrature::clear() {
  for (int k = 0; k < 2; ++k) {
    point[k].clear();
    boundary_point[k].clear();
  }
  JxW.clear();
  boundary_JxW.clear();
  parts.clear();
  whole = true;
}

SubdomainRule::SubdomainRule(const Boundary &boundary, int n_radial) : boundary_(&boundary), n_radial_(n_radial) {
  if (n_radial < 1)
    throw std::invalid_argument("a subdomain needs at least one radial quadrature point");
}

void SubdomainRule::build(const Point2 &centre, double radius, SubdomainQuadrature &quadrature) const {
  quadrature.clear();
  const double tolerance = boundary_->tolerance();
  thread_local std::vector<std::size_t> near;
  thread_local std::vector<double> breaks;
  near.clear();
  breaks.clear();
  const auto pieces = boundary_->pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto part = chord(pieces[i], centre, radius, tolerance);
    if (!part)
      continue;
    near.push_back(i);
    const Point2 along = minus(pieces[i].end, pieces[i].begin);
    // Crossings of the circle and corners inside the disc are the ends of the chord.
    for (const double t : {part->begin, part->end}) {
      const Point2 to{pieces[i].begin[0] + t * along[0] - centre[0], pieces[i].begin[1] + t * along[1] - centre[1]};
      if (std::hypot(to[0], to[1]) > tolerance)
        breaks.push_back(angle_of(to));
    }
  }
  if (near.empty()) {
    add_whole_disc(centre, radius, quadrature);
    return;
  }
  quadrature.whole = false;
  std::sort(breaks.begin(), breaks.end());
  // Break points of adjacent pieces coincide to the rounding of coordinates, and no more is merged:
  // where a circle through a corner touches a piece there, two lie 1e-8 apart, and a wedge that
  // began at the wrong one would be as much too wide.
  const double same = 1e-15 * (10 + (std::abs(centre[0]) + std::abs(centre[1])) / radius);
  breaks.erase(std::unique(breaks.begin(), breaks.end(), [&](double a, double b) { return b - a <= same; }),
               breaks.end());
  if (breaks.size() > 1 && breaks.front() + full_turn - breaks.back() <= same)
    breaks.pop_back();
  for (std::size_t w = 0; w < breaks.size(); ++w) {
    const double end = w + 1 < breaks.size() ? breaks[w + 1] : breaks.front() + full_turn;
    add_wedge(centre, radius, breaks[w], end, near, quadrature);
  }
  for (const std::size_t i : near)
    add_boundary(centre, radius, i, quadrature);
}

void SubdomainRule::add_whole_disc(const Point2 &centre, double radius, SubdomainQuadrature &quadrature) const {
  const auto &radial = linear_algebra::cached_gauss_legendre(n_radial_);
  const auto &angular = linear_algebra::cached_gauss_legendre(4 * n_radial_);
  for (std::size_t a = 0; a < angular.points.size(); ++a) {
    const double angle = full_turn * angular.points[a];
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (std::size_t q = 0; q < radial.points.size(); ++q) {
      const double r = radius * radial.points[q];
      quadrature.point[0].push_back(centre[0] + r * c);
      quadrature.point[1].push_back(centre[1] + r * s);
      quadrature.JxW.push_back(full_turn * angular.weights[a] * radius * radial.weights[q] * r);
    }
  }
}

void SubdomainRule::add_wedge(const Point2 &centre, double radius, double begin, double end,
                              std::span<const std::size_t> pieces, SubdomainQuadrature &quadrature) const {
  const double tolerance = boundary_->tolerance();
  // Crossings of a ray with the pieces, nearest first, closed by the centre and the circle.
  thread_local std::vector<double> radii;
  const auto cast = [&](double angle) {
    const Point2 direction{std::cos(angle), std::sin(angle)};
    radii.assign(1, 0.0);
    for (const std::size_t i : pieces)
      if (const auto r = crossing(boundary_->pieces()[i], centre, direction, tolerance); r && *r < radius)
        radii.push_back(*r);
    radii.push_back(radius);
    std::sort(radii.begin(), radii.end());
    return direction;
  };

  // Between two break points every ray crosses the same pieces: the middle ray tells which of its
  // intervals are inside.
  const Point2 middle = cast(0.5 * (begin + end));
  thread_local std::vector<bool> inside;
  inside.clear();
  for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
    const double r = 0.5 * (radii[i] + radii[i + 1]);
    inside.push_back(boundary_->contains({centre[0] + r * middle[0], centre[1] + r * middle[1]}));
  }
  if (std::none_of(inside.begin(), inside.end(), [](bool b) { return b; }))
    return;

  const double width = end - begin;
  const int n_angular = 4 * n_radial_;
  const auto &angular = linear_algebra::cached_gauss_legendre(n_angular);
  const auto &radial = linear_algebra::cached_gauss_legendre(n_radial_);
  for (std::size_t a = 0; a < angular.points.size(); ++a) {
    const Point2 direction = cast(begin + width * angular.points[a]);
    const std::size_t n_intervals = std::min(radii.size() - 1, inside.size());
    for (std::size_t i = 0; i < n_intervals; ++i) {
      const double extent = radii[i + 1] - radii[i];
      if (!inside[i] || extent <= 0)
        continue;
      for (std::size_t q = 0; q < radial.points.size(); ++q) {
        const double r = radii[i] + extent * radial.points[q];
        quadrature.point[0].push_back(centre[0] + r * direction[0]);
        quadrature.point[1].push_back(centre[1] + r * direction[1]);
        quadrature.JxW.push_back(width * angular.weights[a] * extent * radial.weights[q] * r);
      }
    }
  }
}

void SubdomainRule::add_boundary(const Point2 &centre, double radius, std::size_t piece,
                                 SubdomainQuadrature &quadrature) const {
  const auto &segment = boundary_->pieces()[piece];
  const auto inside = chord(segment, centre, radius, boundary_->tolerance());
  if (!inside)
    return;
  const double length = segment.length();
  const auto &gauss = linear_algebra::cached_gauss_legendre(n_radial_);
  const auto add_part = [&](double begin, double end) {
    if ((end - begin) * length <= boundary_->tolerance())
      return;
    SubdomainQuadrature::BoundaryPart part;
    part.id = segment.id;
    part.normal = segment.normal();
    part.begin = quadrature.boundary_JxW.size();
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
      const double t = begin + (end - begin) * gauss.points[q];
      for (int k = 0; k < 2; ++k)
        quadrature.boundary_point[k].push_back(segment.begin[k] + t * (segment.end[k] - segment.begin[k]));
      quadrature.boundary_JxW.push_back((end - begin) * length * gauss.weights[q]);
    }
    part.end = quadrature.boundary_JxW.size();
    quadrature.parts.push_back(part);
  };
  const double split = std::clamp(inside->nearest, inside->begin, inside->end);
  add_part(inside->begin, split);
  add_part(split, inside->end);
}

} // namespace meshless::domain
