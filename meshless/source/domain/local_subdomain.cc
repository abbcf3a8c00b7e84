#include "meshless/domain/local_subdomain.h"

#include "wedge.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace meshless::domain {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;
/// Longest arc that n_radial Gauss points are trusted with, radians.
constexpr double longest_arc = 1;

using PartKind = SubdomainQuadrature::PartKind;

Point2 direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Radius of a Gauss point of an interval, and its weight with the r of polar coordinates.
std::pair<double, double> radial_point(double inner, double outer, double point, double weight, bool by_area) {
  if (by_area) {
    const double area = (outer - inner) * (outer + inner);
    return {std::sqrt(inner * inner + area * point), 0.5 * area * weight};
  }
  const double r = inner + (outer - inner) * point;
  return {r, (outer - inner) * weight * r};
}

void add_boundary_point(const Point2 &x, const Point2 &normal, double JxW, SubdomainQuadrature &quadrature) {
  for (int k = 0; k < 2; ++k) {
    quadrature.boundary_point[k].push_back(x[k]);
    quadrature.boundary_normal[k].push_back(normal[k]);
  }
  quadrature.boundary_JxW.push_back(JxW);
}

} // namespace

void SubdomainQuadrature::clear() {
  for (int k = 0; k < 2; ++k) {
    point[k].clear();
    boundary_point[k].clear();
    boundary_normal[k].clear();
  }
  JxW.clear();
  boundary_JxW.clear();
  parts.clear();
  whole = true;
}

/// Builds the rule of one disc after the other.
struct SubdomainRule::Scratch {
  CutDisc disc;
  std::vector<std::size_t> near;
  std::vector<Part> piece_parts;
  std::vector<std::pair<std::size_t, Part>> parts;
  std::vector<double> breaks;
  std::vector<Wedge> wedges; ///< only the first n_wedges count
  std::size_t n_wedges = 0;
  AngularRule angular;
  std::vector<double> radii;
  std::vector<double> other_radii;
  std::vector<double> splits;
  std::vector<Meeting> meetings;

  /// The whole disc of radius 1 about the origin: all others are that one, moved and scaled.
  SubdomainQuadrature unit_disc;

  void make_unit_disc(const SubdomainPoints &n);
  void add_whole_disc(SubdomainQuadrature &quadrature) const;
  void add_whole_circle(int n, SubdomainQuadrature &quadrature) const;
  bool find_pieces(const Boundary &boundary);
  void make_wedges(const Boundary &boundary, const Visibility *visibility);
  void add_wedge(const Wedge &wedge, const SubdomainPoints &n, SubdomainQuadrature &quadrature);
  void add_boundary(std::size_t slot, const Part &part, bool any_hidden, int n, SubdomainQuadrature &quadrature);
  void split_at_breaks(const SeenPiece &piece, const Part &part);
  bool seen_inside_of(const BoundaryPiece &piece, double t);
  void add_cuts(int n, SubdomainQuadrature &quadrature);
  void add_cut(const Wedge &visible, const Wedge &hidden, double angle, double side, int n,
               SubdomainQuadrature &quadrature);
  void add_circle(int n, SubdomainQuadrature &quadrature) const;
  void add_arc(double begin, double end, int n, SubdomainQuadrature &quadrature) const;
  std::span<Wedge> all_wedges() { return std::span(wedges).first(n_wedges); }
};

SubdomainRule::SubdomainRule(const Boundary &boundary, const SubdomainPoints &points, const Visibility *visibility)
    : boundary_(&boundary), visibility_(visibility && !visibility->convex() ? visibility : nullptr), points_(points),
      scratch_(std::make_unique<Scratch>()) {
  if (points.radial < 1 || points.angular < 1 || points.boundary < 1)
    throw std::invalid_argument(
        "a subdomain needs at least one quadrature point in the radius, the angle and on a boundary");
  scratch_->make_unit_disc(points);
}

SubdomainRule::~SubdomainRule() = default;
SubdomainRule::SubdomainRule(SubdomainRule &&) noexcept = default;

const SubdomainQuadrature &SubdomainRule::unit_disc() const { return scratch_->unit_disc; }

void SubdomainRule::build(const Point2 &centre, const Ellipse &shape, SubdomainQuadrature &quadrature,
                          const SubdomainWanted &wanted) {
  if (wanted.circle && !shape.round())
    throw std::invalid_argument("the edge of an ellipse is not integrated over: choose a test function that vanishes "
                                "there, or round subdomains");
  quadrature.clear();
  auto &s = *scratch_;
  s.disc.centre = centre;
  s.disc.shape = shape;
  s.disc.tolerance = boundary_->tolerance();
  if (!s.find_pieces(*boundary_)) {
    if (wanted.interior)
      s.add_whole_disc(quadrature);
    if (wanted.circle)
      s.add_whole_circle(points_.boundary, quadrature);
    return;
  }
  quadrature.whole = false;
  SubdomainPoints cut = points_;
  if (points_.radial_cut > 0)
    cut.radial = points_.radial_cut;
  s.make_wedges(*boundary_, visibility_);
  bool any_hidden = false;
  for (const auto &wedge : s.all_wedges()) {
    any_hidden = any_hidden || (visibility_ && wedge.any(Interval::hidden));
    if (wanted.interior && wedge.any(Interval::visible))
      s.add_wedge(wedge, cut, quadrature);
  }
  for (const auto &[slot, part] : s.parts)
    s.add_boundary(slot, part, any_hidden, points_.boundary, quadrature);
  if (any_hidden)
    s.add_cuts(points_.boundary, quadrature);
  if (wanted.circle)
    s.add_circle(points_.boundary, quadrature);
}

/// Fills disc.pieces and parts; false if no boundary comes into the disc.
bool SubdomainRule::Scratch::find_pieces(const Boundary &boundary) {
  disc.pieces.clear();
  parts.clear();
  boundary.pieces_within(disc.centre, disc.shape.radius, near);
  for (const std::size_t i : near) {
    const auto &piece = boundary.pieces()[i];
    piece_parts.clear();
    append_parts_inside(piece, disc.centre, disc.shape, disc.tolerance, piece_parts);
    if (piece_parts.empty())
      continue;
    for (const auto &part : piece_parts)
      parts.emplace_back(disc.pieces.size(), part);
    disc.pieces.emplace_back(piece, i, disc.centre, disc.tolerance);
  }
  return !parts.empty();
}

void SubdomainRule::Scratch::make_wedges(const Boundary &boundary, const Visibility *visibility) {
  find_breaks(disc, parts, breaks);
  n_wedges = breaks.size();
  if (wedges.size() < n_wedges)
    wedges.resize(n_wedges);
  for (std::size_t w = 0; w < n_wedges; ++w) {
    wedges[w].begin = breaks[w];
    wedges[w].end = w + 1 < n_wedges ? breaks[w + 1] : breaks.front() + full_turn;
    wedges[w].look(disc, boundary, visibility);
  }
}

void SubdomainRule::Scratch::make_unit_disc(const SubdomainPoints &n) {
  const auto &radial = linear_algebra::cached_gauss_legendre(n.radial);
  const auto &gauss = linear_algebra::cached_gauss_legendre(n.angular);
  const auto n_angular = static_cast<std::size_t>(n.angular);
  for (std::size_t a = 0; a < n_angular; ++a) {
    const double turn = n.by_area ? static_cast<double>(a) / n.angular : gauss.points[a];
    const double width = full_turn * (n.by_area ? 1.0 / n.angular : gauss.weights[a]);
    const Point2 direction = direction_of(full_turn * turn);
    for (std::size_t q = 0; q < radial.points.size(); ++q) {
      const auto [r, weight] = radial_point(0, 1, radial.points[q], radial.weights[q], n.by_area);
      for (int k = 0; k < 2; ++k)
        unit_disc.point[k].push_back(r * direction[k]);
      unit_disc.JxW.push_back(width * weight);
    }
  }
}

void SubdomainRule::Scratch::add_whole_disc(SubdomainQuadrature &quadrature) const {
  const std::size_t n = unit_disc.JxW.size();
  const double radius = disc.shape.radius;
  const auto compress = disc.shape.compressing();
  for (int k = 0; k < 2; ++k)
    quadrature.point[k].resize(n);
  for (std::size_t q = 0; q < n; ++q) {
    const Point2 d = compress({unit_disc.point[0][q], unit_disc.point[1][q]});
    for (int k = 0; k < 2; ++k)
      quadrature.point[k][q] = disc.centre[k] + radius * d[k];
  }
  quadrature.JxW.resize(n);
  const double area = radius * radius / disc.shape.aspect();
  for (std::size_t q = 0; q < n; ++q)
    quadrature.JxW[q] = area * unit_disc.JxW[q];
}

/// n + 2 equispaced points: exact for trigonometric polynomials up to the degree n + 1.
void SubdomainRule::Scratch::add_whole_circle(int n, SubdomainQuadrature &quadrature) const {
  SubdomainQuadrature::Part part{PartKind::circle, 0, 0, quadrature.boundary_JxW.size(), 0};
  for (int i = 0; i < n + 2; ++i) {
    const Point2 direction = direction_of(full_turn * i / (n + 2));
    add_boundary_point(
        {disc.centre[0] + disc.shape.radius * direction[0], disc.centre[1] + disc.shape.radius * direction[1]},
        direction, full_turn * disc.shape.radius / (n + 2), quadrature);
  }
  part.end = quadrature.boundary_JxW.size();
  quadrature.parts.push_back(part);
}

void SubdomainRule::Scratch::add_wedge(const Wedge &wedge, const SubdomainPoints &n, SubdomainQuadrature &quadrature) {
  make_angular_rule(disc, wedge, n.angular, angular);
  const auto &radial = linear_algebra::cached_gauss_legendre(n.radial);
  for (std::size_t a = 0; a < angular.points.size(); ++a) {
    const Point2 direction = direction_of(angular.points[a]);
    wedge.radii(disc, direction, radii);
    for (std::size_t i = 0; i < wedge.intervals.size(); ++i) {
      const double extent = radii[i + 1] - radii[i];
      if (wedge.intervals[i] != Interval::visible || extent <= 0)
        continue;
      for (std::size_t q = 0; q < radial.points.size(); ++q) {
        const auto [r, weight] = radial_point(radii[i], radii[i + 1], radial.points[q], radial.weights[q], n.by_area);
        quadrature.point[0].push_back(disc.centre[0] + r * direction[0]);
        quadrature.point[1].push_back(disc.centre[1] + r * direction[1]);
        quadrature.JxW.push_back(angular.weights[a] * weight);
      }
    }
  }
}

/// Replaces `splits` by the parameters that the part is to be split at, its ends included: where it is nearest to the
/// particle, and where the directions of break points meet it if something is hidden.
void SubdomainRule::Scratch::split_at_breaks(const SeenPiece &piece, const Part &part) {
  for (const double angle : breaks) {
    const Point2 direction = direction_of(angle);
    meetings.clear();
    piece.append(direction, 0, meetings);
    for (const auto &meeting : meetings) {
      const double t = piece.parameter(direction, meeting.r);
      if (t > part.begin && t < part.end)
        splits.push_back(t);
    }
  }
}

/// Whether the domain beside the piece, at its parameter t, is visible from the centre.
bool SubdomainRule::Scratch::seen_inside_of(const BoundaryPiece &piece, double t) {
  const Point2 x = piece.point(t);
  const Point2 normal = piece.normal(t);
  const double step = 1e-7 * disc.shape.radius;
  const Point2 to{x[0] - step * normal[0] - disc.centre[0], x[1] - step * normal[1] - disc.centre[1]};
  const double r = std::hypot(to[0], to[1]);
  double angle = std::atan2(to[1], to[0]);
  while (angle < breaks.front())
    angle += full_turn;
  for (const auto &wedge : all_wedges()) {
    if (angle > wedge.end)
      continue;
    wedge.radii(disc, {to[0] / r, to[1] / r}, radii);
    for (std::size_t i = 0; i < wedge.intervals.size(); ++i)
      if (r <= radii[i + 1])
        return wedge.intervals[i] == Interval::visible;
    break;
  }
  return false;
}

void SubdomainRule::Scratch::add_boundary(std::size_t slot, const Part &part, bool any_hidden, int n,
                                          SubdomainQuadrature &quadrature) {
  const auto &seen = disc.pieces[slot];
  const auto &piece = seen.piece();
  const double length = piece.length();
  const auto &gauss = linear_algebra::cached_gauss_legendre(n);
  splits.assign({part.begin, part.end, std::clamp(piece.nearest(disc.centre), part.begin, part.end)});
  if (any_hidden)
    split_at_breaks(seen, part);
  std::sort(splits.begin(), splits.end());
  const auto add = [&](double begin, double end) {
    SubdomainQuadrature::Part result{PartKind::boundary, piece.id, seen.index(), quadrature.boundary_JxW.size(), 0};
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
      const double t = begin + (end - begin) * gauss.points[q];
      add_boundary_point(piece.point(t), piece.normal(t), (end - begin) * length * gauss.weights[q], quadrature);
    }
    result.end = quadrature.boundary_JxW.size();
    quadrature.parts.push_back(result);
  };
  for (std::size_t k = 0; k + 1 < splits.size(); ++k) {
    const double begin = splits[k];
    const double end = splits[k + 1];
    if ((end - begin) * length <= disc.tolerance || (any_hidden && !seen_inside_of(piece, 0.5 * (begin + end))))
      continue;
    const int n_arcs = piece.arc ? static_cast<int>(std::ceil((end - begin) * piece.sweep() / longest_arc)) : 1;
    for (int i = 0; i < n_arcs; ++i)
      add(begin + (end - begin) * i / n_arcs, begin + (end - begin) * (i + 1) / n_arcs);
  }
}

void SubdomainRule::Scratch::add_cuts(int n, SubdomainQuadrature &quadrature) {
  for (std::size_t w = 0; w < n_wedges; ++w) {
    const auto &wedge = wedges[w];
    const auto &next = wedges[(w + 1) % n_wedges];
    add_cut(wedge, next, wedge.end, 1, n, quadrature);
    add_cut(next, wedge, wedge.end, -1, n, quadrature);
  }
}

/// The ray at `angle` between two wedges, where it is visible in one and inside but hidden in the other.
/// @param side 1 if the hidden wedge lies counter-clockwise of the ray, -1 if not
void SubdomainRule::Scratch::add_cut(const Wedge &visible, const Wedge &hidden, double angle, double side, int n,
                                     SubdomainQuadrature &quadrature) {
  if (!hidden.any(Interval::hidden))
    return;
  const Point2 direction = direction_of(angle);
  visible.radii(disc, direction, radii);
  hidden.radii(disc, direction, other_radii);
  const auto &gauss = linear_algebra::cached_gauss_legendre(n);
  for (std::size_t i = 0; i < visible.intervals.size(); ++i)
    for (std::size_t j = 0; j < hidden.intervals.size(); ++j) {
      const double begin = std::max(radii[i], other_radii[j]);
      const double end = std::min(radii[i + 1], other_radii[j + 1]);
      if (visible.intervals[i] != Interval::visible || hidden.intervals[j] != Interval::hidden ||
          end - begin <= disc.tolerance)
        continue;
      SubdomainQuadrature::Part part{PartKind::cut, 0, 0, quadrature.boundary_JxW.size(), 0};
      for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const double r = begin + (end - begin) * gauss.points[q];
        add_boundary_point({disc.centre[0] + r * direction[0], disc.centre[1] + r * direction[1]},
                           {-side * direction[1], side * direction[0]}, (end - begin) * gauss.weights[q], quadrature);
      }
      part.end = quadrature.boundary_JxW.size();
      quadrature.parts.push_back(part);
    }
}

/// The circle where its rays are visible up to it, neighbouring wedges together.
void SubdomainRule::Scratch::add_circle(int n, SubdomainQuadrature &quadrature) const {
  std::size_t first = 0; // a wedge after one that is not included
  while (first < n_wedges && wedges[(first + n_wedges - 1) % n_wedges].intervals.back() == Interval::visible)
    ++first;
  if (first == n_wedges) { // all are, as around a small hole
    add_whole_circle(n, quadrature);
    return;
  }
  for (std::size_t k = 0; k < n_wedges;) {
    const auto &wedge = wedges[(first + k++) % n_wedges];
    if (wedge.intervals.back() != Interval::visible)
      continue;
    double width = wedge.end - wedge.begin;
    for (; k < n_wedges && wedges[(first + k) % n_wedges].intervals.back() == Interval::visible; ++k)
      width += wedges[(first + k) % n_wedges].end - wedges[(first + k) % n_wedges].begin;
    const int n_arcs = static_cast<int>(std::ceil(width / (std::numbers::pi * (1 + 1e-9))));
    for (int i = 0; i < n_arcs; ++i)
      add_arc(wedge.begin + width * i / n_arcs, wedge.begin + width * (i + 1) / n_arcs, n, quadrature);
  }
}

void SubdomainRule::Scratch::add_arc(double begin, double end, int n, SubdomainQuadrature &quadrature) const {
  const auto &gauss = linear_algebra::cached_gauss_legendre(n);
  SubdomainQuadrature::Part part{PartKind::circle, 0, 0, quadrature.boundary_JxW.size(), 0};
  for (std::size_t q = 0; q < gauss.points.size(); ++q) {
    const Point2 direction = direction_of(begin + (end - begin) * gauss.points[q]);
    add_boundary_point(
        {disc.centre[0] + disc.shape.radius * direction[0], disc.centre[1] + disc.shape.radius * direction[1]},
        direction, (end - begin) * disc.shape.radius * gauss.weights[q], quadrature);
  }
  part.end = quadrature.boundary_JxW.size();
  quadrature.parts.push_back(part);
}

} // namespace meshless::domain
