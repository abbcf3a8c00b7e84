#pragma once

#include "meshless/cloud/particles.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace meshless::domain {

using Point2 = cloud::Point<2>;

/// Circle that a curved boundary piece lies on, and the sense in which the piece runs around it.
struct Arc {
  Point2 centre{};
  bool counter_clockwise = true;
};

/// A straight line or circular arc of a boundary; the domain lies to its left. A clockwise arc is
/// part of a hole's edge, concave as seen from the domain.
struct BoundaryPiece {
  Point2 begin;
  Point2 end;
  /// Which boundary condition holds here.
  int id = 0;
  /// Empty: a straight line.
  std::optional<Arc> arc = {};

  double length() const;
  /// Radius of the arc, m; of no meaning for a line.
  double radius() const;
  /// Angle the arc sweeps, in (0, 2 pi), positive in both senses; of no meaning for a line.
  double sweep() const;
  /// Point at the parameter t in [0, 1], which is proportional to arc length.
  Point2 point(double t) const;
  /// Unit outward normal at the parameter t (the same everywhere on a line).
  Point2 normal(double t = 0) const;
  /// Unit vector along the piece at the parameter t.
  Point2 tangent(double t = 0) const;
  /// Parameter in [0, 1] of the point of the piece nearest to `x`.
  double nearest(const Point2 &x) const;
  /// Distance from `x` to the piece, m.
  double distance(const Point2 &x) const;
};

/// The boundary of a plane domain: closed loops of lines and arcs, counter-clockwise outside,
/// clockwise around holes. Queries cost about the pieces that are near, not all of them, so that a
/// polyline taken from a mesh may have many.
class Boundary {
public:
  /// @throws std::invalid_argument for fewer than three straight pieces or two with an arc, a piece without
  ///   length, an arc whose ends are not equally far from its centre, or a piece whose end no other
  ///   piece begins at (to 1e-9 of the domain's extent)
  explicit Boundary(std::vector<BoundaryPiece> pieces);

  std::span<const BoundaryPiece> pieces() const { return pieces_; }
  /// Diagonal of the bounding box, m.
  double extent() const { return extent_; }
  /// Points closer than this to a piece are on it, m.
  double tolerance() const { return tolerance_; }
  /// Corners of the bounding box.
  const Point2 &lower() const { return lower_; }
  const Point2 &upper() const { return upper_; }

  /// True for points inside (by the winding number); points within the tolerance of the boundary
  /// may come out either way.
  bool contains(const Point2 &point) const;

  /// Pieces that the point lies on, in their order: none inside, one on an edge, two at a corner.
  std::vector<std::size_t> pieces_at(const Point2 &point) const;

  /// Replaces `result` by the pieces closer than `radius` to the point, in their order.
  void pieces_within(const Point2 &point, double radius, std::vector<std::size_t> &result) const;

  /// Distance from the point to piece `index`, m.
  double distance(const Point2 &point, std::size_t index) const { return pieces_[index].distance(point); }
  /// Distance from the point to the nearest piece, m.
  double distance(const Point2 &point) const;

  // Loops: each piece belongs to one closed loop.
  std::size_t n_loops() const { return loop_lengths_.size(); }
  std::size_t loop(std::size_t piece) const { return loops_[piece]; }
  /// The piece that begins where this one ends.
  std::size_t next(std::size_t piece) const { return next_[piece]; }
  double loop_length(std::size_t loop) const { return loop_lengths_[loop]; }
  /// Distance along the loop from its first piece to the parameter t of this piece, m.
  double along_loop(std::size_t piece, double t) const { return starts_[piece] + t * lengths_[piece]; }
  /// The shorter way along the loop between two places on it, m.
  double distance_along_loop(std::size_t loop, double from, double to) const;

private:
  void find_bounds();
  void check_pieces() const;
  void link();
  void make_strips();
  void make_grid();

  /// Part of a piece on which x2 grows or falls monotonically.
  struct Monotone {
    double begin;
    double end;
    std::size_t piece;
    /// For an arc: right half (+1) or left half (-1) of its circle.
    int half;
  };

  std::vector<BoundaryPiece> pieces_;
  std::vector<double> lengths_;
  double extent_ = 0;
  double tolerance_ = 0;
  Point2 lower_{};
  Point2 upper_{};

  std::vector<std::size_t> next_;
  std::vector<std::size_t> loops_;
  std::vector<double> starts_;
  std::vector<double> loop_lengths_;

  // Horizontal strips with the monotone parts that reach into them, as compressed rows.
  std::vector<Monotone> monotone_;
  std::vector<std::size_t> strip_offsets_;
  std::vector<std::size_t> strip_members_;
  // Square cells with the pieces whose bounding box reaches into them, as compressed rows.
  double cell_size_ = 1;
  std::array<std::ptrdiff_t, 2> n_cells_{1, 1};
  std::vector<std::size_t> cell_offsets_;
  std::vector<std::size_t> cell_members_;
};

/// Rectangle with the ids 0 left, 1 right, 2 bottom, 3 top.
Boundary rectangle(const Point2 &lower, const Point2 &upper);

} // namespace meshless::domain
