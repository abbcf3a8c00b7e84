#include "seen_piece.h"

#include <algorithm>
#include <numbers>

namespace meshless::domain {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

double dot(const Point2 &a, const Point2 &b) { return a[0] * b[0] + a[1] * b[1]; }
/// A circle that only touches a piece, to rounding, has no chord there: one of half this length, in radii of the disc,
/// rises above it by 1e-12 radii, and whether a ray meets it is chance.
constexpr double shortest_chord = 1e-6;

double cross(const Point2 &a, const Point2 &b) { return a[0] * b[1] - a[1] * b[0]; }
Point2 minus(const Point2 &a, const Point2 &b) { return {a[0] - b[0], a[1] - b[1]}; }

/// Angle from a to b in the given sense, in [0, 2 pi).
double turn(const Point2 &a, const Point2 &b, bool counter_clockwise) {
  const double angle = std::atan2(cross(a, b), dot(a, b));
  const double turned = counter_clockwise ? angle : -angle;
  return turned < 0 ? turned + full_turn : turned;
}

/// Stretching leaves a line a line, with the same parameter.
void append_part_of_line(const BoundaryPiece &piece, const Point2 &centre, const Ellipse &shape, double tolerance,
                         std::vector<Part> &parts) {
  const double radius = shape.radius;
  const Point2 along = shape.stretched(minus(piece.end, piece.begin));
  const Point2 from = shape.stretched(minus(piece.begin, centre));
  const double length = std::hypot(along[0], along[1]);
  const double nearest = -dot(along, from) / (length * length);
  const double distance = std::abs(cross(along, from)) / length;
  if (distance >= radius)
    return;
  const double half = std::sqrt((radius - distance) * (radius + distance)) / length;
  if (half * length < shortest_chord * radius)
    return;
  const Part part{std::max(0.0, nearest - half), std::min(1.0, nearest + half)};
  if (part.end - part.begin > tolerance / piece.length())
    parts.push_back(part);
}

/// Where f changes its sign between begin and end, at the ends of which it has opposite signs.
template <typename Function>
double root_between(const Function &f, double begin, double end) {
  const bool rises = f(begin) < 0;
  while (true) {
    const double middle = 0.5 * (begin + end);
    if (middle <= begin || middle >= end)
      return middle;
    ((f(middle) < 0) == rises ? begin : end) = middle;
  }
}

/// Roots of f between the given increasing points, at which its sign is looked at.
template <typename Function>
std::vector<double> roots_between(const Function &f, const std::vector<double> &points) {
  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if ((f(points[i]) < 0) != (f(points[i + 1]) < 0))
      roots.push_back(root_between(f, points[i], points[i + 1]));
  return roots;
}

/// s^2 - 1 is a trigonometric polynomial of degree 2 of the angle on the arc: it is monotonous between the at most four
/// zeros of its derivative, and those are far from each other unless it hardly changes between them.
void append_parts_of_arc_in_ellipse(const BoundaryPiece &piece, const Point2 &centre, const Ellipse &shape,
                                    double tolerance, std::vector<Part> &parts) {
  constexpr int n_looks = 32; // on a full turn: eight for a half wave
  const double sweep = piece.sweep();
  const double sense = piece.arc->counter_clockwise ? 1 : -1;
  const auto excess = [&](double t) {
    const Point2 y = shape.stretched(minus(piece.point(t), centre));
    return dot(y, y) - shape.radius * shape.radius;
  };
  const auto slope = [&](double t) { // but for a positive factor
    const Point2 y = shape.stretched(minus(piece.point(t), centre));
    const Point2 radial = minus(piece.point(t), piece.arc->centre);
    return dot(y, shape.stretched({-sense * radial[1], sense * radial[0]}));
  };
  const int n = std::max(1, static_cast<int>(std::ceil(n_looks * sweep / full_turn)));
  std::vector<double> looks;
  for (int i = 0; i <= n; ++i)
    looks.push_back(static_cast<double>(i) / n);
  std::vector<double> ends = roots_between(slope, looks);
  ends.insert(ends.begin(), 0.0);
  ends.push_back(1.0);
  ends = roots_between(excess, ends);
  ends.insert(ends.begin(), 0.0);
  ends.push_back(1.0);
  const double shortest = std::max(tolerance, 2 * shortest_chord * shape.radius / shape.aspect()) / piece.length();
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (ends[i + 1] - ends[i] > shortest && excess(0.5 * (ends[i] + ends[i + 1])) < 0)
      parts.push_back({ends[i], ends[i + 1]});
}

void append_parts_of_arc(const BoundaryPiece &piece, const Point2 &centre, double radius, double tolerance,
                         std::vector<Part> &parts) {
  const double R = piece.radius();
  const double sweep = piece.sweep();
  const Point2 to = minus(centre, piece.arc->centre);
  const double d = std::hypot(to[0], to[1]);
  if (std::abs(d - R) >= radius)
    return; // the circles do not cross, and the arc's does not lie inside: that needs d + R < radius
  // sin^2 of half the angle, about the arc's centre, of the part inside.
  const double denominator = 4 * d * R;
  const double numerator = (radius - (d - R)) * (radius + (d - R));
  if (numerator >= denominator) {
    parts.push_back({0, 1});
    return;
  }
  const double half = 2 * std::asin(std::sqrt(numerator / denominator));
  if (half * R < shortest_chord * radius)
    return;
  const double middle = turn(minus(piece.begin, piece.arc->centre), to, piece.arc->counter_clockwise);
  for (const double shift : {-full_turn, 0.0, full_turn}) {
    const double begin = std::max(0.0, middle + shift - half);
    const double end = std::min(sweep, middle + shift + half);
    if ((end - begin) * R > tolerance)
      parts.push_back({begin / sweep, end / sweep});
  }
}

} // namespace

SeenPiece::SeenPiece(const BoundaryPiece &piece, std::size_t index, const Point2 &from, double tolerance)
    : piece_(&piece), index_(index), tolerance_(tolerance), from_(from),
      offset_(minus(piece.arc ? piece.arc->centre : piece.begin, from)) {
  if (piece.arc) {
    radius_ = piece.radius();
    sweep_ = piece.sweep();
    const double d = std::hypot(offset_[0], offset_[1]);
    excess_ = std::abs(d - radius_) <= tolerance ? 0 : (d - radius_) * (d + radius_);
  } else
    along_ = minus(piece.end, piece.begin);
}

double SeenPiece::distance(const Point2 &direction, int root) const {
  if (!piece_->arc)
    return cross(offset_, along_) / cross(direction, along_);
  const double p = dot(offset_, direction);
  const double s = cross(offset_, direction);
  // The roots of r^2 - 2 p r + excess, without cancellation.
  const double discriminant = excess_ == 0 ? p * p : (radius_ - s) * (radius_ + s);
  const double half = std::sqrt(std::max(0.0, discriminant));
  const double larger = p < 0 ? p - half : p + half;
  const double smaller = larger == 0 ? 0 : excess_ / larger;
  return root == 0 ? std::min(larger, smaller) : std::max(larger, smaller);
}

void SeenPiece::append(const Point2 &direction, std::size_t slot, std::vector<Meeting> &meetings) const {
  if (!piece_->arc) {
    const double length = std::hypot(along_[0], along_[1]);
    const double denominator = cross(direction, along_);
    if (std::abs(denominator) <= 1e-14 * length)
      return; // parallel
    // Rays through an end of a piece are break points; the slack only guards against rounding.
    const double slack = tolerance_ / length;
    const double t = cross(offset_, direction) / denominator;
    const double r = cross(offset_, along_) / denominator;
    if (t >= -slack && t <= 1 + slack && r > tolerance_)
      meetings.push_back({r, slot, 0});
    return;
  }
  if (excess_ != 0 && std::abs(cross(offset_, direction)) >= radius_)
    return;
  const double slack = tolerance_ / radius_;
  for (const int root : {0, 1}) {
    const double r = distance(direction, root);
    if (r <= tolerance_)
      continue;
    const double angle = parameter(direction, r) * sweep_;
    if (angle <= sweep_ + slack || angle >= full_turn - slack)
      meetings.push_back({r, slot, root});
  }
}

double SeenPiece::parameter(const Point2 &direction, double r) const {
  if (!piece_->arc) {
    const Point2 from_begin{r * direction[0] - offset_[0], r * direction[1] - offset_[1]};
    return dot(from_begin, along_) / dot(along_, along_);
  }
  return turn(minus(piece_->begin, piece_->arc->centre), {r * direction[0] - offset_[0], r * direction[1] - offset_[1]},
              piece_->arc->counter_clockwise) /
         sweep_;
}

std::array<Point2, 2> SeenPiece::tangents() const {
  const double d = std::hypot(offset_[0], offset_[1]);
  const double c = tangent_length() / d;
  const double s = radius_ / d;
  const Point2 u{offset_[0] / d, offset_[1] / d};
  return {Point2{c * u[0] + s * u[1], c * u[1] - s * u[0]}, Point2{c * u[0] - s * u[1], c * u[1] + s * u[0]}};
}

void append_parts_inside(const BoundaryPiece &piece, const Point2 &centre, const Ellipse &shape, double tolerance,
                         std::vector<Part> &parts) {
  if (!piece.arc)
    append_part_of_line(piece, centre, shape, tolerance, parts);
  else if (shape.round())
    append_parts_of_arc(piece, centre, shape.radius, tolerance, parts);
  else
    append_parts_of_arc_in_ellipse(piece, centre, shape, tolerance, parts);
}

} // namespace meshless::domain
