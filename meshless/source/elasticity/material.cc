#include "meshless/elasticity/material.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace meshless::elasticity {

Material::Material(double youngs_modulus, double poisson_ratio, PlaneModel model)
    : youngs_modulus_(youngs_modulus), poisson_ratio_(poisson_ratio), model_(model) {
  if (!(youngs_modulus > 0) || !std::isfinite(youngs_modulus))
    throw std::invalid_argument(fmt::format("Young's modulus {} is not a positive number", youngs_modulus));
  const bool strain = model == PlaneModel::plane_strain;
  if (!(poisson_ratio > -1) || poisson_ratio > 0.5 || (strain && poisson_ratio >= 0.5))
    throw std::invalid_argument(fmt::format("Poisson's ratio {} is outside (-1, 0.5{} for {}", poisson_ratio,
                                            strain ? ")" : "]", strain ? "plane strain" : "plane stress"));
  const double e = youngs_modulus;
  const double nu = poisson_ratio;
  // Written without E0, nu0, whose differences cancel near nu = 1/2.
  shear_ = e / (2 * (1 + nu));
  if (strain) {
    axial_ = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    coupling_ = e * nu / ((1 + nu) * (1 - 2 * nu));
  } else {
    axial_ = e / ((1 - nu) * (1 + nu));
    coupling_ = nu * axial_;
  }
}

double Material::thermal_modulus() const {
  return youngs_modulus_ / (model_ == PlaneModel::plane_stress ? 1 - poisson_ratio_ : 1 - 2 * poisson_ratio_);
}

double Material::plane_modulus() const {
  return model_ == PlaneModel::plane_stress ? youngs_modulus_
                                            : youngs_modulus_ / ((1 - poisson_ratio_) * (1 + poisson_ratio_));
}

} // namespace meshless::elasticity
