#include "comparisons/problems/boundary_quadrature.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace comparisons::problems {

namespace {

/// A piece as a curve over t in [0, 1].
class Curve {
public:
  explicit Curve(const BoundaryPiece &piece) : piece_(piece) {
    const double dx = piece.end[0] - piece.begin[0];
    const double dy = piece.end[1] - piece.begin[1];
    length_ = std::hypot(dx, dy);
    if (!piece.arc)
      return;
    const auto &c = piece.arc->centre;
    radius_ = std::hypot(piece.begin[0] - c[0], piece.begin[1] - c[1]);
    first_ = std::atan2(piece.begin[1] - c[1], piece.begin[0] - c[0]);
    turn_ = std::atan2(piece.end[1] - c[1], piece.end[0] - c[0]) - first_;
    constexpr double full = 2 * std::numbers::pi;
    if (piece.arc->counter_clockwise && turn_ <= 0)
      turn_ += full;
    if (!piece.arc->counter_clockwise && turn_ >= 0)
      turn_ -= full;
    length_ = radius_ * std::abs(turn_);
  }

  double length() const { return length_; }

  Point2 point(double t) const {
    if (!piece_.arc)
      return {piece_.begin[0] + t * (piece_.end[0] - piece_.begin[0]),
              piece_.begin[1] + t * (piece_.end[1] - piece_.begin[1])};
    const double angle = first_ + t * turn_;
    return {piece_.arc->centre[0] + radius_ * std::cos(angle), piece_.arc->centre[1] + radius_ * std::sin(angle)};
  }

  /// The region is to the left of the piece: out is to its right.
  Vector2 normal(double t) const {
    if (!piece_.arc)
      return {(piece_.end[1] - piece_.begin[1]) / length_, -(piece_.end[0] - piece_.begin[0]) / length_};
    const double angle = first_ + t * turn_;
    const double sign = turn_ > 0 ? 1 : -1;
    return {sign * std::cos(angle), sign * std::sin(angle)};
  }

private:
  const BoundaryPiece &piece_;
  double length_ = 0;
  double radius_ = 0;
  double first_ = 0;
  double turn_ = 0;
};

} // namespace

std::map<int, BoundaryQuadrature> boundary_quadrature(const PlaneStatement &statement, double least_parts) {
  std::map<int, double> lengths;
  for (const auto &region : statement.regions)
    for (const auto &piece : region.boundary)
      if (piece.id != interface_id)
        lengths[piece.id] += Curve(piece).length();
  const auto gauss = meshless::linear_algebra::gauss_legendre(5);
  std::map<int, BoundaryQuadrature> result;
  for (const auto &region : statement.regions)
    for (const auto &piece : region.boundary) {
      if (piece.id == interface_id)
        continue;
      const Curve curve(piece);
      auto &target = result[piece.id];
      const int parts = static_cast<int>(std::ceil(least_parts * curve.length() / lengths[piece.id]));
      for (int part = 0; part < parts; ++part)
        for (std::size_t q = 0; q < gauss.points.size(); ++q) {
          const double t = (part + gauss.points[q]) / parts;
          target.points.push_back(curve.point(t));
          target.normals.push_back(curve.normal(t));
          target.weights.push_back(gauss.weights[q] * curve.length() / parts);
        }
    }
  return result;
}

} // namespace comparisons::problems
