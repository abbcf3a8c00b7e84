#pragma once

#include "comparisons/problems/plane_problem.h"

namespace comparisons::metrics {

/// sigma : C^-1 : sigma for isotropic elasticity in the plane, with E0, nu0, J/m^3.
inline double twice_energy_density(const problems::Stress2 &s, const problems::Material &material) {
  const double nu = material.poisson_ratio;
  const double nu0 = material.plane_strain ? nu / (1 - nu) : nu;
  const double e0 = material.plane_strain ? material.youngs_modulus / ((1 - nu) * (1 + nu)) : material.youngs_modulus;
  return (s[0] * s[0] + s[1] * s[1] - 2 * nu0 * s[0] * s[1]) / e0 +
         2 * (1 + nu) * s[2] * s[2] / material.youngs_modulus;
}

} // namespace comparisons::metrics
