#pragma once

namespace fem_reference::elasticity {
enum class PlaneModel { plane_stress, plane_strain };

/// Isotropic linear elastic material in plane stress or plane strain.
///
/// The plane law is sigma_ij = lambda epsilon_kk delta_ij + 2 mu epsilon_ij with i, j, k = 1, 2 and
///   plane strain: lambda = E nu / ((1 + nu) (1 - 2 nu)),
///   plane stress: lambda* = 2 lambda mu / (lambda + 2 mu) = E nu / (1 - nu^2).
/// The last form has no cancellation near nu = 1/2 and is finite there.
class Material {
public:
  /// Young's modulus in Pa, > 0; Poisson's ratio in (-1, 1/2) for plane strain and (-1, 1/2] for
  /// plane stress. Throws InvalidInput otherwise.
  Material(double youngs_modulus, double poisson_ratio, PlaneModel model);

  double youngs_modulus() const { return youngs_modulus_; }
  double poisson_ratio() const { return poisson_ratio_; }
  PlaneModel model() const { return model_; }

  /// Effective first Lame constant of the plane law, Pa.
  double lambda() const;
  /// In-plane stress that holds back a free strain of 1 in all directions, Pa: E / (1 - nu) or E / (1 - 2 nu).
  double thermal_modulus() const;
  /// Shear modulus, Pa.
  double mu() const;

private:
  double youngs_modulus_;
  double poisson_ratio_;
  PlaneModel model_;
};
} // namespace fem_reference::elasticity
