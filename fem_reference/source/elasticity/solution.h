#pragma once

#include "boundary_conditions.h"
#include "discretisation.h"
#include "point_location.h"
#include "recovery.h"
#include "stiffness.h"

#include "fem_reference/elasticity/plane_elasticity.h"

#include <atomic>
#include <mutex>
#include <optional>

namespace fem_reference::elasticity {
class PlaneSolution::Implementation {
public:
  Implementation(std::vector<Material> materials_, Discretisation discretisation_)
      : materials(std::move(materials_)), discretisation(std::move(discretisation_)) {}

  /// Call `function(k, cell, N, dN_1, dN_2)` for every point, with the shape functions and their derivatives
  /// along both reference axes.
  template <typename Function>
  void for_each_point(std::span<const Point> points, const Function &function) const;

  const Material &material_of(std::size_t cell) const {
    return materials[static_cast<std::size_t>(discretisation.regions[cell])];
  }

  /// Takes the thermal stress off.
  void subtract_thermal(std::span<const Point> points, std::span<std::array<double, 3>> stress) const;

  // Built by the first use.
  const PointLocation &location() const;
  const RecoveredStress &recovered() const;
  const InternalForces &internal() const;

  std::vector<Material> materials;
  Discretisation discretisation;
  std::vector<double> values;        ///< unknown = 2 node + component
  std::vector<double> cell_pressure; ///< of a mixed method, see MixedResult
  std::size_t n_dofs = 0;
  Loads loads;
  ScalarField thermal_strain; ///< empty: none
  EssentialData essential;
  std::size_t nonzeros = 0;
  int iterations = 0;
  Seconds seconds;
  double relative_residual = 0;
  double backward_error = 0;
  std::optional<double> algebraic_error;
  mutable std::atomic<std::size_t> points_outside{0};

private:
  mutable std::once_flag location_built_;
  mutable std::optional<PointLocation> location_;
  mutable std::once_flag recovered_built_;
  mutable std::optional<RecoveredStress> recovered_;
  mutable std::once_flag internal_built_;
  mutable InternalForces internal_;
};
} // namespace fem_reference::elasticity
