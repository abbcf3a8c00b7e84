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

void append_part_of_line(const BoundaryPiece &piece, const Point2 &centre, double radius, double tolerance,
                         std::vector<Part> &parts) {
  const Point2 along = minus(piece.end, piece.begin);
  const Point2 from = minus(piece.begin, centre);
  const double length = piece.length();
  const double nearest = -dot(along, from) / (length * length);
  const double distance = std::abs(cross(along, from)) / length;
  if (distance >= radius)
    return;
  const double half = std::sqrt((radius - distance) * (radius + distance)) / length;
  if (half * length < shortest_chord * radius)
    return;
  const Part part{std::max(0.0, nearest - half), std::min(1.0, nearest + half)};
  if (part.end - part.begin > tolerance / length)
    parts.push_back(part);
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

void append_parts_inside(const BoundaryPiece &piece, const Point2 &centre, double radius, double tolerance,
                         std::vector<Part> &parts) {
  if (piece.arc)
    append_parts_of_arc(piece, centre, radius, tolerance, parts);
  else
    append_part_of_line(piece, centre, radius, tolerance, parts);
}

} // namespace meshless::domain
