#include "wedge.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meshless::domain {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

double angle_of(const Point2 &v) {
  const double angle = std::atan2(v[1], v[0]);
  return angle < 0 ? angle + full_turn : angle;
}

/// Angle from `from` counter-clockwise to `to` if it is small and positive, 0 if rounding made it negative.
double ahead(double from, double to) {
  double angle = std::fmod(to - from, full_turn);
  if (angle < 0)
    angle += full_turn;
  return angle > std::numbers::pi + 1 ? 0 : angle;
}

/// From a to b, in (-pi, pi].
double angle_between(const Point2 &a, const Point2 &b) {
  return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

/// Angle of a direction after the ellipse has been stretched to a disc; infinity remains.
double stretched_angle(const Ellipse &shape, double angle) {
  if (std::isinf(angle))
    return angle;
  const Point2 e{std::cos(angle), std::sin(angle)};
  return angle + angle_between(e, shape.stretched(e));
}

/// Distances in angle from the ends of a wedge outwards to the nearest tangent of an arc that its rays meet.
struct Tangencies {
  double before = std::numeric_limits<double>::infinity();
  double after = std::numeric_limits<double>::infinity();
};

Tangencies tangencies(const CutDisc &disc, const Wedge &wedge) {
  Tangencies result;
  for (const auto &meeting : wedge.meetings) {
    const auto &piece = disc.pieces[meeting.piece];
    if (!piece.has_tangents())
      continue;
    const auto [clockwise, counter_clockwise] = piece.tangents();
    result.before = std::min(result.before, ahead(angle_of(clockwise), wedge.begin));
    result.after = std::min(result.after, ahead(wedge.end, angle_of(counter_clockwise)));
  }
  return result;
}

/// A tangent farther from the wedge than this part of its width leaves the Gauss rule its accuracy: 40 points
/// converge like 2.6^-80.
constexpr double harmless = 0.25;

void append_rule(double begin, double end, const Tangencies &at, int n, AngularRule &rule) {
  const double width = end - begin;
  const bool before = at.before < harmless * width;
  const bool after = at.after < harmless * width;
  constexpr double none = std::numeric_limits<double>::infinity();
  if (before && after) {
    const double middle = 0.5 * (begin + end);
    append_rule(begin, middle, {at.before, none}, n, rule);
    append_rule(middle, end, {none, at.after}, n, rule);
    return;
  }
  const auto &gauss = linear_algebra::cached_gauss_legendre(n);
  // theta = tangent +- s^2
  const double gap = before ? at.before : at.after;
  const double s0 = std::sqrt(gap);
  const double s1 = std::sqrt(width + gap);
  for (std::size_t q = 0; q < gauss.points.size(); ++q) {
    if (!before && !after) {
      rule.points.push_back(begin + width * gauss.points[q]);
      rule.weights.push_back(width * gauss.weights[q]);
      continue;
    }
    const double s = s0 + (s1 - s0) * gauss.points[q];
    rule.points.push_back(before ? begin - gap + s * s : end + gap - s * s);
    rule.weights.push_back(2 * s * (s1 - s0) * gauss.weights[q]);
  }
}

} // namespace

bool Wedge::any(Interval kind) const { return std::find(intervals.begin(), intervals.end(), kind) != intervals.end(); }

void Wedge::look(const CutDisc &disc, const Boundary &boundary, const Visibility *visibility) {
  const double middle = 0.5 * (begin + end);
  const Point2 direction{std::cos(middle), std::sin(middle)};
  meetings.clear();
  for (std::size_t i = 0; i < disc.pieces.size(); ++i)
    disc.pieces[i].append(direction, i, meetings);
  const double reach = disc.shape.reach(direction);
  std::erase_if(meetings, [&](const Meeting &m) { return m.r >= reach; });
  std::sort(meetings.begin(), meetings.end(), [](const Meeting &a, const Meeting &b) { return a.r < b.r; });

  intervals.clear();
  thread_local std::vector<bool> outside;
  outside.clear();
  bool gap = false;
  double inner = 0;
  for (std::size_t k = 0; k <= meetings.size(); ++k) {
    const double outer = k < meetings.size() ? meetings[k].r : reach;
    const double r = 0.5 * (inner + outer);
    const bool inside = boundary.contains({disc.centre[0] + r * direction[0], disc.centre[1] + r * direction[1]});
    outside.push_back(!inside);
    gap = gap || !inside;
    Interval kind = inside ? Interval::visible : Interval::outside;
    if (inside && gap && visibility &&
        way_around(*visibility, disc.centre, direction, r, disc.pieces, std::span(meetings).first(k), outside) >
            Visibility::largest_detour * r)
      kind = Interval::hidden;
    intervals.push_back(kind);
    inner = outer;
  }
}

void Wedge::radii(const CutDisc &disc, const Point2 &direction, std::vector<double> &result) const {
  const double reach = disc.shape.reach(direction);
  result.assign(1, 0.0);
  for (const auto &meeting : meetings)
    // In their order, and inside the disc, whatever rounding does close to break points.
    result.push_back(std::clamp(disc.pieces[meeting.piece].distance(direction, meeting.root), result.back(), reach));
  result.push_back(reach);
}

void make_angular_rule(const CutDisc &disc, const Wedge &wedge, int n, AngularRule &rule) {
  rule.points.clear();
  rule.weights.clear();
  const auto at = tangencies(disc, wedge);
  if (disc.shape.round()) {
    append_rule(wedge.begin, wedge.end, at, n, rule);
    return;
  }
  const double begin = stretched_angle(disc.shape, wedge.begin);
  const double end = stretched_angle(disc.shape, wedge.end);
  append_rule(begin, end,
              {begin - stretched_angle(disc.shape, wedge.begin - at.before),
               stretched_angle(disc.shape, wedge.end + at.after) - end},
              n, rule);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Point2 e{std::cos(rule.points[q]), std::sin(rule.points[q])};
    const Point2 d = disc.shape.compressed(e);
    rule.points[q] += angle_between(e, d);
    // r^2 dtheta is an area, which the stretching multiplies by the aspect.
    rule.weights[q] /= disc.shape.aspect() * (d[0] * d[0] + d[1] * d[1]);
  }
}

void find_breaks(const CutDisc &disc, std::span<const std::pair<std::size_t, Part>> parts,
                 std::vector<double> &breaks) {
  breaks.clear();
  const auto add = [&](const Point2 &to) {
    if (std::hypot(to[0], to[1]) > disc.tolerance)
      breaks.push_back(angle_of(to));
  };
  for (const auto &[slot, part] : parts) {
    const auto &piece = disc.pieces[slot].piece();
    // Crossings of the circle and corners inside the disc are the ends of the parts.
    for (const double t : {part.begin, part.end}) {
      const Point2 x = piece.point(t);
      add({x[0] - disc.centre[0], x[1] - disc.centre[1]});
    }
  }
  for (const auto &piece : disc.pieces) {
    if (piece.has_tangents())
      for (const auto &tangent : piece.tangents())
        if (piece.tangent_length() < disc.shape.reach(tangent) && piece.parameter(tangent, piece.tangent_length()) <= 1)
          breaks.push_back(angle_of(tangent));
    if (piece.on_circle() && piece.piece().distance(disc.centre) <= disc.tolerance) {
      const Point2 &c = piece.offset();
      breaks.push_back(angle_of({c[1], -c[0]}));
      breaks.push_back(angle_of({-c[1], c[0]}));
    }
  }
  std::sort(breaks.begin(), breaks.end());
  // Break points of adjacent pieces coincide to the rounding of coordinates, and no more is merged:
  // where a circle through a corner touches a piece there, two lie 1e-8 apart, and a wedge that
  // began at the wrong one would be as much too wide.
  const double same = 1e-15 * (10 + (std::abs(disc.centre[0]) + std::abs(disc.centre[1])) / disc.shape.radius);
  breaks.erase(std::unique(breaks.begin(), breaks.end(), [&](double a, double b) { return b - a <= same; }),
               breaks.end());
  if (breaks.size() > 1 && breaks.front() + full_turn - breaks.back() <= same)
    breaks.pop_back();
}

} // namespace meshless::domain
