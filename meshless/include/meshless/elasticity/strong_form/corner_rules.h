#pragma once

#include "meshless/elasticity/plane_problem.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace meshless::elasticity::strong_form {

/// One condition that a boundary particle can satisfy.
enum class Quantity { u1, u2, t1, t2, s11, s22, s12 };

/// Reads "u1", "t2", "s12" ...; nothing for another word.
std::optional<Quantity> quantity_from(std::string_view word);

/// The two conditions of the particle at one corner. A corner belongs to two boundary pieces with
/// four conditions, of which a particle can satisfy two (Batra & Zhang 2008, (4.5), (4.6)).
struct CornerRule {
  Point2 corner;
  std::array<Quantity, 2> conditions;
};

/// One row of the collocation system at a boundary particle.
struct RowCondition {
  ConditionKind kind;
  /// Component of displacement or traction.
  int component;
  /// Piece of the region's boundary whose data and normal hold.
  std::size_t piece;
};

/// The rows of a particle of the region that lies at the point, on the given pieces of its boundary, none of them of an
/// interface. Normals are those at the point.
///
/// On one piece: its own two conditions. At a corner without a rule: essential conditions first,
/// component by component; a component without one takes the traction of the piece whose normal is
/// nearer to the x1 axis, so that a corner between two loaded sides gets s11 and s12 there (the
/// best choice of the paper's Table 2).
///
/// With a rule: u1, u2 need a piece on which that component is prescribed; t1, t2 one on which the
/// traction component is; s11, s22 and s12 a piece normal to an axis with that traction component.
/// @throws std::invalid_argument if the rule asks for what no piece prescribes, or twice the same
std::array<RowCondition, 2> conditions_at(const PlaneProblem &problem, std::size_t region, const Point2 &point,
                                          std::span<const std::size_t> pieces, const CornerRule *rule);

} // namespace meshless::elasticity::strong_form
