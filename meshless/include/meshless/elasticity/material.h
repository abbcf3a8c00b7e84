#pragma once

namespace meshless::elasticity {

enum class PlaneModel { plane_stress, plane_strain };

/// Isotropic linear elasticity in the plane: sigma = D eps, Batra & Zhang 2008, Eqs. (3.3)-(3.5).
class Material {
public:
  /// @param youngs_modulus E > 0, Pa
  /// @param poisson_ratio -1 < nu <= 1/2 in plane stress, -1 < nu < 1/2 in plane strain
  /// @throws std::invalid_argument outside these ranges
  Material(double youngs_modulus, double poisson_ratio, PlaneModel model);

  double youngs_modulus() const { return youngs_modulus_; }
  double poisson_ratio() const { return poisson_ratio_; }
  PlaneModel model() const { return model_; }
  /// E0 of (3.5), Pa.
  double plane_modulus() const;

  /// D11 = D22 of (3.4), Pa.
  double axial() const { return axial_; }
  /// D12 of (3.4), Pa.
  double coupling() const { return coupling_; }
  /// D33 of (3.4), the shear modulus, Pa.
  double shear() const { return shear_; }
  /// Stress in the plane that holds back a free strain of 1: E / (1 - nu) in plane stress, E / (1 - 2 nu) in plane
  /// strain, Pa.
  double thermal_modulus() const;

private:
  double youngs_modulus_;
  double poisson_ratio_;
  PlaneModel model_;
  double axial_;
  double coupling_;
  double shear_;
};

} // namespace meshless::elasticity
