#pragma once

#include "detour.h"
#include "seen_piece.h"

#include "meshless/domain/ellipse.h"
#include "meshless/domain/visibility.h"

#include <span>
#include <vector>

namespace meshless::domain {

/// The disc or ellipse around a particle that the boundary comes into.
struct CutDisc {
  Point2 centre{};
  Ellipse shape{0};
  double tolerance = 0;
  std::vector<SeenPiece> pieces; ///< that come into it
};

enum class Interval : char { outside, visible, hidden };

/// A sector of a cut disc between two break points: all its rays meet the same pieces in the same order.
struct Wedge {
  double begin = 0; ///< angles, begin < end
  double end = 0;
  std::vector<Meeting> meetings;
  std::vector<Interval> intervals; ///< between meetings, from the centre to the circle

  /// Looks along the ray in the middle.
  /// @param visibility null: nothing is hidden
  void look(const CutDisc &disc, const Boundary &boundary, const Visibility *visibility);

  bool any(Interval kind) const;
  /// Ends of the intervals on one ray of the wedge, from 0 to the disc's edge, m.
  void radii(const CutDisc &disc, const Point2 &direction, std::vector<double> &result) const;
};

/// Angular points and weights, radians.
struct AngularRule {
  std::vector<double> points;
  std::vector<double> weights;
};

/// Replaces `rule` by n Gauss points over the wedge, or over each half of it, in a variable in which the distances to
/// its arcs are smooth. In an ellipse that variable is the angle in the disc that it is stretched to.
void make_angular_rule(const CutDisc &disc, const Wedge &wedge, int n, AngularRule &rule);

/// Angles of all break points, increasing, in [0, 2 pi).
/// @param parts of every piece inside the disc, with the index in `disc.pieces`
void find_breaks(const CutDisc &disc, std::span<const std::pair<std::size_t, Part>> parts, std::vector<double> &breaks);

} // namespace meshless::domain
