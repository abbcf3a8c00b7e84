#include "fem_reference/elasticity/material.h"

#include "fem_reference/errors.h"

#include <cmath>

#include <fmt/format.h>

namespace fem_reference::elasticity {
Material::Material(double youngs_modulus, double poisson_ratio, PlaneModel model)
    : youngs_modulus_(youngs_modulus), poisson_ratio_(poisson_ratio), model_(model) {
  if (!(youngs_modulus > 0) || !std::isfinite(youngs_modulus))
    throw InvalidInput(fmt::format("material: Young's modulus is {} Pa, expected a finite value > 0", youngs_modulus));
  if (model == PlaneModel::plane_strain && !(poisson_ratio > -1 && poisson_ratio < .5))
    throw InvalidInput(
        fmt::format("material: Poisson's ratio is {}, expected -1 < nu < 0.5 in plane strain", poisson_ratio));
  if (model == PlaneModel::plane_stress && !(poisson_ratio > -1 && poisson_ratio <= .5))
    throw InvalidInput(
        fmt::format("material: Poisson's ratio is {}, expected -1 < nu <= 0.5 in plane stress", poisson_ratio));
}

double Material::lambda() const {
  const double nu = poisson_ratio_;
  return model_ == PlaneModel::plane_strain ? youngs_modulus_ * nu / ((1 + nu) * (1 - 2 * nu))
                                            : youngs_modulus_ * nu / ((1 + nu) * (1 - nu));
}

double Material::mu() const { return youngs_modulus_ / (2 * (1 + poisson_ratio_)); }

double Material::thermal_modulus() const {
  return youngs_modulus_ / (1 - (model_ == PlaneModel::plane_stress ? 1 : 2) * poisson_ratio_);
}
} // namespace fem_reference::elasticity
