#pragma once

#include "meshless/domain/boundary.h"
#include "meshless/domain/ellipse.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace meshless::domain {

/// Where a ray meets the boundary. Between two break points every ray meets the same roots in the same order.
struct Meeting {
  double r;          ///< distance along the ray, m
  std::size_t piece; ///< index in the list of pieces that was looked at
  int root;          ///< 0 the nearer, 1 the farther meeting with a circle
};

/// A boundary piece in polar coordinates about one point: where rays from there meet it.
class SeenPiece {
public:
  /// @param piece kept by reference
  SeenPiece(const BoundaryPiece &piece, std::size_t index, const Point2 &from, double tolerance);

  const BoundaryPiece &piece() const { return *piece_; }
  /// Index of the piece in the boundary.
  std::size_t index() const { return index_; }

  /// Distance along the ray in the unit `direction` to the line or circle of the piece, beyond its ends too;
  /// at a tangent both roots are the tangent point.
  double distance(const Point2 &direction, int root) const;

  /// Appends the meetings of the ray with the piece itself, farther than the tolerance.
  /// @param slot index that the meetings carry
  void append(const Point2 &direction, std::size_t slot, std::vector<Meeting> &meetings) const;

  /// Parameter of the piece at the point at distance `r` along the ray.
  double parameter(const Point2 &direction, double r) const;

  /// True for an arc whose circle the point is outside of: rays can be tangent to it.
  bool has_tangents() const { return piece_->arc && excess_ > 0; }
  /// Unit directions of the two tangents, clockwise and counter-clockwise of the centre.
  std::array<Point2, 2> tangents() const;
  /// Distance to the tangent points, m.
  double tangent_length() const { return std::sqrt(excess_); }
  /// True if the point lies on the circle of an arc.
  bool on_circle() const { return piece_->arc && excess_ == 0; }
  /// From the point to the centre of the arc, or to the beginning of the line, m.
  const Point2 &offset() const { return offset_; }

private:
  const BoundaryPiece *piece_;
  std::size_t index_;
  double tolerance_;
  Point2 from_;
  Point2 offset_;
  // A line: its vector. An arc: radius, its square, sweep, and d^2 - R^2 of the point, zero on the circle.
  Point2 along_{};
  double radius_ = 0;
  double sweep_ = 0;
  double excess_ = 0;
};

/// A part of a piece, as parameters in [0, 1].
struct Part {
  double begin;
  double end;
};

/// Appends the parts of the piece inside the disc or ellipse that are longer than the tolerance.
void append_parts_inside(const BoundaryPiece &piece, const Point2 &centre, const Ellipse &shape, double tolerance,
                         std::vector<Part> &parts);

} // namespace meshless::domain
