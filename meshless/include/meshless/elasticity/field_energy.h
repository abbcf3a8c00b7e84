#pragma once

#include "meshless/elasticity/equations_of_motion.h"

#include <span>
#include <vector>

namespace meshless::elasticity {

/// Energies of a discrete displacement field by a quadrature of its own, not by the equations that it solves: what says
/// whether equations that have no energy of their own keep it nevertheless.
class FieldEnergy {
public:
  /// A quadrature of the domain, and of the tractions (or other forces) on the boundary.
  struct Quadrature {
    std::vector<Point2> points;
    std::vector<double> weights; ///< m^2
    std::vector<Point2> force_points;
    std::vector<Vector2> forces; ///< times the weight, N per m of thickness
  };

  /// @param densities of the regions, kg/m^3
  FieldEnergy(const EquationsOfMotion &equations, std::span<const double> densities, const Quadrature &quadrature);

  /// Half the integral of rho v^2, J/m.
  double kinetic(std::span<const double> velocity) const;
  /// Half the integral of stress times strain, J/m.
  double strain(std::span<const double> displacement) const;
  /// Forces times displacement, J/m.
  double work(std::span<const double> displacement) const;

private:
  /// Rows act on the coefficients of one component.
  linear_algebra::SparseRows value_, slope_1_, slope_2_, force_value_;
  std::vector<double> weights_, densities_;
  std::vector<Material> materials_;
  std::vector<Vector2> forces_;
};

} // namespace meshless::elasticity
