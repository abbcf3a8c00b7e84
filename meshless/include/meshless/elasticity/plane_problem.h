#pragma once

#include "meshless/domain/boundary.h"
#include "meshless/elasticity/material.h"

#include <array>
#include <functional>
#include <map>
#include <span>

namespace meshless::elasticity {

using Point2 = cloud::Point<2>;
using Vector2 = std::array<double, 2>;
/// Components 11, 22, 12.
using Stress2 = std::array<double, 3>;

/// Batch callback: values of a vector field at points.
using VectorField = std::function<void(std::span<const Point2>, std::span<Vector2>)>;
/// Batch callback: traction in Pa at boundary points with these outward unit normals.
using TractionField =
    std::function<void(std::span<const Point2>, std::span<const Vector2> normals, std::span<Vector2>)>;

enum class ConditionKind { displacement, traction };

/// Condition on one boundary id, per component; an empty traction is zero.
struct BoundaryCondition {
  std::array<ConditionKind, 2> kind{ConditionKind::traction, ConditionKind::traction};
  VectorField displacement; ///< m
  TractionField traction;   ///< Pa
};

/// Plane elastostatics, Batra & Zhang 2008, Eqs. (3.1)-(3.7).
struct PlaneProblem {
  domain::Boundary boundary;
  Material material;
  std::map<int, BoundaryCondition> conditions; ///< by boundary id
  /// Force per volume, N/m^3; empty if the scene calls for none: nothing is then computed for it.
  VectorField body_force;

  /// @throws std::invalid_argument if a piece has no condition, a condition lacks its displacement
  ///   field, or no component of any piece is fixed
  void check() const;

  /// @throws std::invalid_argument naming the first particle that lies outside of the domain: its subdomain
  ///   would be empty, and collocation would take it for an interior one
  void require_inside(std::span<const Point2> particles) const;
};

} // namespace meshless::elasticity
