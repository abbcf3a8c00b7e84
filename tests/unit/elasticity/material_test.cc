// Elastic constants of plane stress and plane strain.

#include "meshless/elasticity/material.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace meshless::elasticity;

TEST(Material, plane_stress_solves_hookes_law_with_no_stress_across) {
  for (const double nu : {-.9, -.2, 0., .25, .33, .499999, .5}) {
    const double E = 226.9e9;
    const Material d(E, nu, PlaneModel::plane_stress);
    // Tension along one axis: eps = (1, -nu), sigma = (E, 0).
    EXPECT_NEAR(d.axial() - nu * d.coupling(), E, 1e-14 * E);
    EXPECT_NEAR(d.coupling() - nu * d.axial(), 0, 1e-14 * d.axial());
    EXPECT_DOUBLE_EQ(d.shear(), E / 2 / (1 + nu));
    EXPECT_EQ(d.plane_modulus(), E);
  }
}

TEST(Material, plane_strain_solves_hookes_law_with_no_strain_across) {
  for (const double nu : {-.9, -.2, 0., .25, .33, .4999, .499999}) {
    const double E = 2;
    const Material d(E, nu, PlaneModel::plane_strain);
    // sigma_33 = nu (sigma_11 + sigma_22), so E eps_11 = sigma_11 - nu sigma_22 - nu sigma_33 for eps = (1, 0).
    const double s11 = d.axial();
    const double s22 = d.coupling();
    const double s33 = nu * (s11 + s22);
    EXPECT_NEAR(s11 - nu * (s22 + s33), E, 1e-14 * s11);
    EXPECT_NEAR(s22 - nu * (s11 + s33), 0, 1e-14 * s11);
    // Lame: lambda + 2 mu and lambda.
    EXPECT_NEAR(d.axial() - d.coupling(), 2 * d.shear(), 1e-14 * s11);
    EXPECT_NEAR(d.plane_modulus(), E / (1 - nu * nu), 1e-15 * E / (1 - nu * nu) * 4);
  }
}

TEST(Material, nearly_incompressible_constants_keep_their_digits) {
  // lambda = E nu / ((1 + nu) (1 - 2 nu)): only 1 - 2 nu cancels, and that is exact.
  const double nu = .5 - std::ldexp(1, -30);
  const Material d(1, nu, PlaneModel::plane_strain);
  const long double exact = nu / ((1.0L + nu) * std::ldexp(1.0L, -29));
  EXPECT_NEAR(d.coupling(), static_cast<double>(exact), 1e-15 * d.coupling());
}

TEST(Material, keeps_what_it_is_given) {
  const Material d(3, .2, PlaneModel::plane_strain);
  EXPECT_EQ(d.youngs_modulus(), 3);
  EXPECT_EQ(d.poisson_ratio(), .2);
  EXPECT_EQ(d.model(), PlaneModel::plane_strain);
}

TEST(Material, refuses_what_is_not_elastic) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refused = [](double E, double nu, PlaneModel model) {
    return refusal::message_of<std::invalid_argument>([=] { Material(E, nu, model); });
  };
  for (const auto model : {PlaneModel::plane_stress, PlaneModel::plane_strain}) {
    for (const double E : {0., -1., nan, infinity})
      EXPECT_TRUE(refusal::mentions(refused(E, .3, model), {"Young"})) << E;
    for (const double nu : {-1., -2., .51, nan, infinity})
      EXPECT_TRUE(refusal::mentions(refused(1, nu, model), {"Poisson"})) << nu;
  }
  EXPECT_EQ(refused(1, .5, PlaneModel::plane_stress), "");
  EXPECT_TRUE(refusal::mentions(refused(1, .5, PlaneModel::plane_strain), {"0.5", "plane strain"}));
}

} // namespace
