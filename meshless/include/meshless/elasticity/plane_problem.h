#pragma once

#include "meshless/domain/boundary.h"
#include "meshless/elasticity/material.h"

#include <array>
#include <functional>
#include <map>
#include <span>
#include <vector>

namespace meshless::elasticity {

using Point2 = cloud::Point<2>;
using Vector2 = std::array<double, 2>;
/// Components 11, 22, 12.
using Stress2 = std::array<double, 3>;

/// Batch callback: values of a vector field at points.
using VectorField = std::function<void(std::span<const Point2>, std::span<Vector2>)>;
/// Batch callback: values of a scalar field at points.
using ScalarField = std::function<void(std::span<const Point2>, std::span<double>)>;
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

/// The id of boundary pieces between two regions, which are bonded there: equal displacement, opposite tractions.
inline constexpr int interface_id = -1;

/// Part of the domain that is of one material.
struct Region {
  domain::Boundary boundary;
  Material material;
};

/// Plane elastostatics, Batra & Zhang 2008, Eqs. (3.1)-(3.7).
struct PlaneProblem {
  /// At least one. A piece that two of them share stands in both, in opposite directions, with interface_id.
  std::vector<Region> regions;
  std::map<int, BoundaryCondition> conditions; ///< by boundary id
  /// Force per volume, N/m^3; empty if the scene calls for none: nothing is then computed for it.
  VectorField body_force;
  /// Free strain by temperature, expansion coefficient times rise of temperature, the same in all directions; empty if
  /// the scene calls for none. The stress is then sigma = D eps - E / (1 - nu) eps_0 I (plane stress; 1 - 2 nu in plane
  /// strain): eps_0 acts as a load.
  ScalarField thermal_strain = {};

  /// @throws std::invalid_argument if there is no region, a piece has no condition, a condition lacks its displacement
  ///   field, no component of any piece is fixed, or a piece of an interface has no counterpart
  /// @param may_move freely: a body in motion needs no supports
  void check(bool may_move = false) const;

  /// @throws std::invalid_argument naming the first particle that lies outside of its region, or whose region does not
  ///   exist: its subdomain would be empty, and collocation would take it for an interior one
  void require_inside(const cloud::Particles<2> &particles) const;
};

/// What lies on the other side of the pieces of an interface.
class Interfaces {
public:
  struct Side {
    std::size_t region; ///< on the other side
    std::size_t piece;  ///< of that region's boundary
    /// True on the side whose displacement follows that of the other. It is the softer one (of equals, the one with
    /// the lower index), and the traction comes from its stress: where a rigid body meets a soft one the soft one has
    /// its displacement prescribed, and where a body meets next to nothing, no traction acts on it. The other choice
    /// would make the stiff side follow, and multiply its small strains by a large modulus.
    bool follows;
  };

  /// @throws std::invalid_argument naming a piece without a counterpart
  explicit Interfaces(std::span<const Region> regions);

  bool empty() const { return sides_.empty(); }
  const Side &at(std::size_t region, std::size_t piece) const { return sides_.at({region, piece}); }

private:
  std::map<std::pair<std::size_t, std::size_t>, Side> sides_;
};

} // namespace meshless::elasticity
