#pragma once

#include "comparisons/problems/plane_problem.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comparisons::geometry {

/// A side of a cell on the edge of its region, which lies to the left.
struct RegionEdge {
  unsigned begin = 0;
  unsigned end = 0;
  /// Position of the node in its middle, if it has one and it is not on the straight line.
  std::optional<problems::Point2> midpoint = {};
  int id = 0;
  /// The region on the other side; -1 on the boundary.
  int neighbour = -1;
  std::string name;
  /// Set by `find_circles`: the centre of the circle that the edge shares with a neighbour.
  std::optional<problems::Point2> circle_centre = {};
};

/// The edges of a region as closed loops. A vertex where more than two edges meet, the domain touching itself, is
/// returned in its place.
struct Loops {
  std::vector<std::vector<RegionEdge>> loops;
  std::optional<unsigned> touching_vertex;
};
Loops make_loops(std::span<const RegionEdge> edges);

/// Finds the edges that lie on a circle: the middle node is equally far from both ends, and the neighbour with the same
/// id has the same circle (or there is no such neighbour).
void find_circles(std::vector<RegionEdge> &loop, const std::vector<problems::Point2> &vertices);

/// Pieces of a loop, with edges of one line or circle joined.
std::vector<problems::BoundaryPiece> make_pieces(const std::vector<RegionEdge> &loop,
                                                 const std::vector<problems::Point2> &vertices);

/// A curved boundary in straight pieces.
struct StraightApproximation {
  std::string name;
  std::size_t n_pieces = 0;
  double largest_turn = 0; ///< radians
};
/// Adds what the loop has of them: straight edges of one id that turn by .5 to 50 degrees.
void find_approximations(const std::vector<RegionEdge> &loop, const std::vector<problems::Point2> &vertices,
                         std::vector<StraightApproximation> &found);

/// Centre of the circle through three points; nothing if they are in one line.
std::optional<problems::Point2> circle_through(const problems::Point2 &a, const problems::Point2 &b,
                                               const problems::Point2 &c);

} // namespace comparisons::geometry
