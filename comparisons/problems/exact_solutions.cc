#include "comparisons/problems/exact_solutions.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace comparisons::problems {

namespace {

using Complex = std::complex<double>;

double shear_modulus(const Material &material) { return material.youngs_modulus / (2 * (1 + material.poisson_ratio)); }

/// Kolosov's constant.
double kappa(const Material &material) {
  const double nu = material.poisson_ratio;
  return material.plane_strain ? 3 - 4 * nu : (3 - nu) / (1 + nu);
}

/// A displacement and a stress by one function of the point each.
template <typename Displacement, typename Stress>
ExactSolution by_point(Displacement displacement, Stress stress) {
  ExactSolution solution;
  solution.displacement = [displacement](std::span<const Point2> points, std::span<Vector2> values) {
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = displacement(points[i]);
  };
  solution.stress = [stress](std::span<const Point2> points, std::span<Stress2> values) {
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = stress(points[i]);
  };
  return solution;
}

/// The potentials of the elliptic hole and their derivatives by zeta at a point.
struct EllipsePotentials {
  EllipsePotentials(double a, double b, double s, const Point2 &point) {
    const double r = (a + b) / 2;
    const double m = (a - b) / (a + b);
    z = {point[0], point[1]};
    const Complex root = std::sqrt(z * z - 4 * r * r * m);
    const Complex zeta_1 = (z + root) / (2 * r);
    const Complex zeta_2 = (z - root) / (2 * r);
    const Complex zeta = std::abs(zeta_1) >= std::abs(zeta_2) ? zeta_1 : zeta_2;
    const Complex square = zeta * zeta;
    map_1 = r * (1.0 - m / square);
    map_2 = 2 * r * m / (square * zeta);
    phi = s * r / 4 * (zeta - (2 + m) / zeta);
    phi_1 = s * r / 4 * (1.0 + (2 + m) / square);
    phi_2 = -s * r / 2 * (2 + m) / (square * zeta);
    const double c = 1 + m + m * m;
    const Complex denominator = zeta * (square - m);
    const Complex numerator = 1.0 + c * square;
    psi = s * r / 2 * (zeta - numerator / denominator);
    psi_1 =
        s * r / 2 * (1.0 - (2 * c * zeta * denominator - numerator * (3.0 * square - m)) / (denominator * denominator));
  }
  Complex z, map_1, map_2, phi, phi_1, phi_2, psi, psi_1;
};

} // namespace

ExactSolution elliptic_hole(double a, double b, double stress, const Material &material) {
  const double mu = shear_modulus(material);
  const double k = kappa(material);
  return by_point(
      [=](const Point2 &point) {
        const EllipsePotentials p(a, b, stress, point);
        const Complex u = (k * p.phi - p.z * std::conj(p.phi_1 / p.map_1) - std::conj(p.psi)) / (2 * mu);
        return Vector2{u.real(), u.imag()};
      },
      [=](const Point2 &point) {
        const EllipsePotentials p(a, b, stress, point);
        const double sum = 4 * (p.phi_1 / p.map_1).real();
        const Complex second = (p.phi_2 * p.map_1 - p.phi_1 * p.map_2) / (p.map_1 * p.map_1 * p.map_1);
        const Complex difference = 2.0 * (std::conj(p.z) * second + p.psi_1 / p.map_1);
        return Stress2{(sum - difference.real()) / 2, (sum + difference.real()) / 2, difference.imag() / 2};
      });
}

double reentrant_corner_exponent() {
  double lambda = 0.5445;
  const double w = 1.5 * std::numbers::pi;
  for (int i = 0; i < 20; ++i)
    lambda -= (std::sin(w * lambda) - lambda) / (w * std::cos(w * lambda) - 1);
  return lambda;
}

ExactSolution reentrant_corner(double stress, const Material &material) {
  const double l = reentrant_corner_exponent();
  const double half = 0.75 * std::numbers::pi;
  const double q = (2 * std::cos((l - 1) * half) * std::sin(half) - (l - 1) * std::sin((l - 2) * half)) /
                   ((l + 1) * std::sin(l * half));
  const double mu = shear_modulus(material);
  const double k = kappa(material);
  // Polar coordinates with the angle from the bisector of the plane that is left.
  const auto polar = [](const Point2 &p) {
    const Complex turned = Complex(p[0], p[1]) * std::polar(1.0, -std::numbers::pi / 4);
    return std::pair{std::abs(turned), std::arg(turned)};
  };
  const double c = std::numbers::sqrt2 / 2; // cosine and sine of 45 degrees
  return by_point(
      [=](const Point2 &point) {
        const auto [r, t] = polar(point);
        const double factor = stress / l * std::pow(r, l) / (2 * mu);
        const double u = factor * ((k - q * (l + 1)) * std::cos(l * t) - l * std::cos((l - 2) * t));
        const double v = factor * ((k + q * (l + 1)) * std::sin(l * t) + l * std::sin((l - 2) * t));
        return Vector2{c * (u - v), c * (u + v)};
      },
      [=](const Point2 &point) {
        const auto [r, t] = polar(point);
        const double factor = stress * std::pow(r, l - 1);
        const double c1 = std::cos((l - 1) * t);
        const double c3 = std::cos((l - 3) * t);
        const double s11 = factor * ((2 - q * (l + 1)) * c1 - (l - 1) * c3);
        const double s22 = factor * ((2 + q * (l + 1)) * c1 + (l - 1) * c3);
        const double s12 = factor * ((l - 1) * std::sin((l - 3) * t) + q * (l + 1) * std::sin((l - 1) * t));
        return Stress2{(s11 + s22) / 2 - s12, (s11 + s22) / 2 + s12, (s11 - s22) / 2};
      });
}

} // namespace comparisons::problems
