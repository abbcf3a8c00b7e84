#pragma once

#include "meshless/domain/boundary.h"

#include <memory>
#include <span>
#include <vector>

namespace meshless::domain {

/// Who sees whom in a domain that is not convex: the two sides of a slot must not interact across it, although they
/// are closer than the radius of a support.
///
/// The straight way from x to y may leave the domain, at a, and come back, at b. Where it does, the way around, along
/// the boundary from a to b, replaces the gap. y is hidden from x if the detour is long:
///   (|x - a| + way(a, b) + |b - y|) / |x - y| > 1.25,
/// with the sum of all gaps if there are several. At that limit the two ends of an arc of 130 degrees just see each
/// other, so that a hole with 11 particles on a quarter of its edge hides nothing from a support of four spacings;
/// the faces of a slot of any width see each other only closer to its square end than an eighth of the width; at a
/// re-entrant right angle only points on its two faces, equally far from the corner to a factor of 3, are hidden.
///
/// In a convex domain nothing is ever looked at.
class Visibility {
public:
  static constexpr double largest_detour = 1.25;

  /// @param boundary kept by reference
  explicit Visibility(const Boundary &boundary);

  const Boundary &boundary() const { return *boundary_; }
  /// True if the whole domain is convex: everything sees everything.
  bool convex() const { return convex_; }

  /// True if the pieces, in increasing order, are one convex chain: they hide nothing.
  bool convex_chain(std::span<const std::size_t> pieces) const;

  /// A place on the boundary.
  struct Place {
    std::size_t piece;
    double t;
  };
  /// The place nearest to a point on the boundary, or as good as on it.
  Place place_of(const Point2 &point) const;
  /// The shorter way along the boundary, m; infinite from one loop to another.
  double way(const Place &from, const Place &to) const;

private:
  const Boundary *boundary_;
  bool convex_ = true;
  std::vector<bool> concave_;      ///< the piece itself
  std::vector<bool> reflex_after_; ///< the corner at its end
};

/// The view from one point; storage is reused from one to the next.
class View {
public:
  /// @param visibility kept by reference
  explicit View(const Visibility &visibility);
  ~View();
  View(View &&) noexcept;

  /// Moves to a point of the domain or its boundary.
  /// @param reach nothing farther will be asked for, m
  void move_to(const Point2 &from, double reach);

  /// True if nothing within reach is hidden.
  bool clear() const { return clear_; }
  bool sees(const Point2 &to) const;

private:
  struct Scratch;
  const Visibility *visibility_;
  Point2 from_{};
  bool clear_ = true;
  bool on_boundary_ = false;
  std::unique_ptr<Scratch> scratch_;
};

} // namespace meshless::domain
