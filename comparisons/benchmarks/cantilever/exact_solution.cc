#include "comparisons/benchmarks/cantilever/exact_solution.h"

#include <cmath>
#include <numbers>

namespace comparisons::benchmarks::cantilever {

namespace {

using problems::Material;
using problems::Point2;
using problems::Stress2;
using problems::Vector2;

/// E0 and nu0 of (3.5).
struct PlaneConstants {
  explicit PlaneConstants(const Material &material)
      : modulus(material.plane_strain
                    ? material.youngs_modulus / ((1 - material.poisson_ratio) * (1 + material.poisson_ratio))
                    : material.youngs_modulus),
        ratio(material.plane_strain ? material.poisson_ratio / (1 - material.poisson_ratio) : material.poisson_ratio) {}
  double modulus;
  double ratio;
};

/// Constants of sigma = D eps, (3.4), without the cancellation of 1 - nu0^2 near nu = 1/2.
struct Stiffness {
  explicit Stiffness(const Material &material) {
    const double e = material.youngs_modulus;
    const double nu = material.poisson_ratio;
    shear = e / (2 * (1 + nu));
    coupling = material.plane_strain ? e * nu / ((1 + nu) * (1 - 2 * nu)) : e * nu / ((1 - nu) * (1 + nu));
    axial = coupling + 2 * shear;
  }
  double axial = 0;
  double coupling = 0;
  double shear = 0;

  Stress2 stress(double e11, double e22, double gamma12) const {
    return {axial * e11 + coupling * e22, coupling * e11 + axial * e22, shear * gamma12};
  }
};

/// Makes batch callbacks of functions of x / L2, y / L2 relative to the plate's corner.
template <typename Pointwise>
auto batch(const Plate &plate, Pointwise pointwise) {
  return [plate, pointwise](std::span<const Point2> points, auto values) {
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] =
          pointwise((points[i][0] - plate.origin[0]) / plate.width, (points[i][1] - plate.origin[1]) / plate.width);
  };
}

} // namespace

Solution bending(const Plate &plate, const Material &material) {
  const PlaneConstants constants(material);
  const double c = 2 * plate.force / constants.modulus;
  const double nu = constants.ratio;
  const double l = plate.length / plate.width;
  const double f = plate.force / plate.width;
  Solution solution;
  solution.exact.displacement = batch(plate, [=](double x, double y) {
    return Vector2{-c * (y - 0.5) * (3 * x * (2 * l - x) + (2 + nu) * y * (y - 1)),
                   c * (x * x * (3 * l - x) + 3 * nu * (l - x) * (y - 0.5) * (y - 0.5) + (4 + 5 * nu) / 4 * x)};
  });
  solution.exact.stress = batch(plate, [=](double x, double y) {
    return Stress2{-12 * f * (l - x) * (y - 0.5), 0, -6 * f * y * (y - 1)};
  });
  return solution;
}

Solution linear(const Plate &plate, const Material &material) {
  const double c = plate.force / PlaneConstants(material).modulus;
  const Stiffness stiffness(material);
  const double strain = c / plate.width;
  Solution solution;
  solution.exact.displacement = batch(plate, [=](double x, double y) {
    return Vector2{c * (2 * x + 0.5 * y), c * (x - 1.5 * y)};
  });
  solution.exact.stress =
      batch(plate, [=](double, double) { return stiffness.stress(2 * strain, -1.5 * strain, 1.5 * strain); });
  return solution;
}

Solution trigonometric(const Plate &plate, const Material &material) {
  const double c = plate.force / PlaneConstants(material).modulus;
  const Stiffness d(material);
  const double k = 1.5 * std::numbers::pi * plate.width / plate.length;
  const double strain = c / plate.width;
  const double second = strain / plate.width;
  Solution solution;
  solution.exact.displacement = batch(plate, [=](double x, double y) {
    return Vector2{c * std::sin(k * x) * std::cosh(y), 0.5 * c * std::cos(k * x) * std::exp(y)};
  });
  solution.exact.stress = batch(plate, [=](double x, double y) {
    const double e11 = strain * k * std::cos(k * x) * std::cosh(y);
    const double e22 = 0.5 * strain * std::cos(k * x) * std::exp(y);
    const double gamma = strain * (std::sin(k * x) * std::sinh(y) - 0.5 * k * std::sin(k * x) * std::exp(y));
    return d.stress(e11, e22, gamma);
  });
  // b = -div sigma, with div sigma_1 = A u1,11 + G u1,22 + (B + G) u2,12 and its counterpart.
  solution.body_force = batch(plate, [=](double x, double y) {
    const double u1_11 = -second * k * k * std::sin(k * x) * std::cosh(y);
    const double u1_22 = second * std::sin(k * x) * std::cosh(y);
    const double u1_12 = second * k * std::cos(k * x) * std::sinh(y);
    const double u2_11 = -0.5 * second * k * k * std::cos(k * x) * std::exp(y);
    const double u2_22 = 0.5 * second * std::cos(k * x) * std::exp(y);
    const double u2_12 = -0.5 * second * k * std::sin(k * x) * std::exp(y);
    const double mixed = d.coupling + d.shear;
    return Vector2{-(d.axial * u1_11 + d.shear * u1_22 + mixed * u2_12),
                   -(mixed * u1_12 + d.shear * u2_11 + d.axial * u2_22)};
  });
  return solution;
}

} // namespace comparisons::benchmarks::cantilever
