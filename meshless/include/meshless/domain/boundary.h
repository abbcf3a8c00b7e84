#pragma once

#include "meshless/cloud/particles.h"

#include <optional>
#include <span>
#include <vector>

namespace meshless::domain {

using Point2 = cloud::Point<2>;

/// A straight piece of a boundary; the domain lies to its left.
struct BoundaryPiece {
  Point2 begin;
  Point2 end;
  /// Which boundary condition holds here.
  int id = 0;

  double length() const;
  /// Unit outward normal.
  Point2 normal() const;
};

/// The boundary of a plane domain: closed loops of straight pieces, counter-clockwise outside,
/// clockwise around holes.
class Boundary {
public:
  /// @throws std::invalid_argument for fewer than three pieces, a piece without length, or a
  ///   piece whose end no other piece begins at (to 1e-9 of the domain's extent)
  explicit Boundary(std::vector<BoundaryPiece> pieces);

  std::span<const BoundaryPiece> pieces() const { return pieces_; }
  /// Diagonal of the bounding box, m.
  double extent() const { return extent_; }
  /// Points closer than this to a piece are on it, m.
  double tolerance() const { return tolerance_; }

  /// True for points inside (by the winding number); points within the tolerance of the boundary
  /// may come out either way.
  bool contains(const Point2 &point) const;

  /// Pieces that the point lies on, in their order: none inside, one on an edge, two at a corner.
  std::vector<std::size_t> pieces_at(const Point2 &point) const;

  /// Distance from the point to piece `index`, m.
  double distance(const Point2 &point, std::size_t index) const;

private:
  std::vector<BoundaryPiece> pieces_;
  double extent_ = 0;
  double tolerance_ = 0;
};

/// Rectangle with the ids 0 left, 1 right, 2 bottom, 3 top.
Boundary rectangle(const Point2 &lower, const Point2 &upper);

} // namespace meshless::domain
