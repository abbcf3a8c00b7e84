#include "meshless/elasticity/strong_form/corner_rules.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace meshless::elasticity::strong_form {

namespace {

constexpr std::pair<std::string_view, Quantity> names[] = {
    {"u1", Quantity::u1},   {"u2", Quantity::u2},   {"t1", Quantity::t1},  {"t2", Quantity::t2},
    {"s11", Quantity::s11}, {"s22", Quantity::s22}, {"s12", Quantity::s12}};

std::string_view name_of(Quantity quantity) {
  for (const auto &[name, value] : names)
    if (value == quantity)
      return name;
  return "?";
}

/// The pieces that a particle lies on.
struct Place {
  const PlaneProblem &problem;
  std::size_t region;
  const Point2 &point;
  std::span<const std::size_t> pieces;

  Vector2 normal(std::size_t piece) const {
    const auto &p = problem.regions[region].boundary.pieces()[piece];
    return p.normal(p.nearest(point));
  }
  bool along_axis(std::size_t piece, int axis) const { return std::abs(normal(piece)[axis]) > 1 - 1e-9; }
  const BoundaryCondition &condition(std::size_t piece) const {
    return problem.conditions.at(problem.regions[region].boundary.pieces()[piece].id);
  }
};

/// First of the pieces that prescribes `kind` for the component, with the normal along an axis if one is named.
std::optional<RowCondition> find_row(const Place &place, ConditionKind kind, int component, int normal_axis = -1) {
  for (const std::size_t piece : place.pieces)
    if (place.condition(piece).kind[component] == kind && (normal_axis < 0 || place.along_axis(piece, normal_axis)))
      return RowCondition{kind, component, piece};
  return {};
}

std::optional<RowCondition> row_for(const Place &place, Quantity quantity) {
  using enum Quantity;
  const auto displacement = ConditionKind::displacement;
  const auto traction = ConditionKind::traction;
  switch (quantity) {
  case u1:
    return find_row(place, displacement, 0);
  case u2:
    return find_row(place, displacement, 1);
  case t1:
    return find_row(place, traction, 0);
  case t2:
    return find_row(place, traction, 1);
  case s11:
    return find_row(place, traction, 0, 0);
  case s22:
    return find_row(place, traction, 1, 1);
  case s12:
    if (const auto row = find_row(place, traction, 1, 0))
      return row;
    return find_row(place, traction, 0, 1);
  }
  return {};
}

} // namespace

std::optional<Quantity> quantity_from(std::string_view word) {
  for (const auto &[name, quantity] : names)
    if (name == word)
      return quantity;
  return {};
}

std::array<RowCondition, 2> conditions_at(const PlaneProblem &problem, std::size_t region, const Point2 &point,
                                          std::span<const std::size_t> pieces, const CornerRule *rule) {
  const Place place{problem, region, point, pieces};
  if (rule == nullptr) {
    std::size_t nearest = pieces[0];
    for (const std::size_t piece : pieces)
      if (std::abs(place.normal(piece)[0]) > std::abs(place.normal(nearest)[0]) + 1e-9)
        nearest = piece;
    std::array<RowCondition, 2> rows{};
    for (int k = 0; k < 2; ++k) {
      const auto essential = find_row(place, ConditionKind::displacement, k);
      rows[k] = essential ? *essential : RowCondition{ConditionKind::traction, k, nearest};
    }
    return rows;
  }
  std::array<RowCondition, 2> rows{};
  for (int i = 0; i < 2; ++i) {
    const auto row = row_for(place, rule->conditions[i]);
    if (!row)
      throw std::invalid_argument(
          fmt::format("the corner at ({:.6g}, {:.6g}) asks for {}, which no boundary there prescribes", rule->corner[0],
                      rule->corner[1], name_of(rule->conditions[i])));
    rows[i] = *row;
  }
  // Two names may mean one condition: t1 on a piece normal to x1 is s11.
  if (rows[0].kind == rows[1].kind && rows[0].component == rows[1].component && rows[0].piece == rows[1].piece)
    throw std::invalid_argument(
        fmt::format("the corner at ({:.6g}, {:.6g}) asks twice for the same condition, by {} and {}", rule->corner[0],
                    rule->corner[1], name_of(rule->conditions[0]), name_of(rule->conditions[1])));
  return rows;
}

} // namespace meshless::elasticity::strong_form
