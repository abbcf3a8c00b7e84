#pragma once

#include "comparisons/problems/plane_problem.h"

#include <cstdint>

namespace comparisons::problems {

/// A grid of points on a rectangle, with the boundary ids 0 left, 1 right, 2 bottom, 3 top.
///
/// Jitter moves every point by at most `jitter` spacings in each direction, uniformly at random and
/// the same for a given seed on every machine; points of an edge stay on it, corners stay.
class RectangleGrid {
public:
  /// @param n points along the axes, each >= 2
  RectangleGrid(const Point2 &lower, const Point2 &upper, std::array<int, 2> n, double jitter, std::uint64_t seed);

  /// Points with the first axis slowest.
  const std::vector<Point2> &points() const { return points_; }
  /// The smaller of the two spacings of the grid before it was jittered, m.
  double spacing() const;

  Cloud cloud() const;
  Mesh mesh() const;
  /// Tensor Gauss rule on the cells of the (unjittered) grid, each cut into as many equal parts as make
  /// at least 24 along the longer side.
  Quadrature quadrature() const;

private:
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(i * n_[1] + j); }

  Point2 lower_;
  Point2 upper_;
  std::array<int, 2> n_;
  std::vector<Point2> points_;
};

/// Boundary pieces of the rectangle, counter-clockwise from the bottom.
std::vector<BoundaryPiece> rectangle_boundary(const Point2 &lower, const Point2 &upper);

/// Its corners NE, SE, SW, NW: the paper's particles 1 to 4, clockwise from the north-east.
std::vector<Corner> rectangle_corners(const Point2 &lower, const Point2 &upper);

} // namespace comparisons::problems
