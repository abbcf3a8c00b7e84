#include "comparisons/benchmarks/plate_with_hole/exact_solution.h"

#include <cmath>

namespace comparisons::benchmarks::plate_with_hole {

namespace {

using problems::Point2;
using problems::Stress2;
using problems::Vector2;

/// b / r, and cosine and sine of theta, 2 theta, 3 theta, 4 theta.
struct Polar {
  Polar(const Point2 &x, double radius) : r(std::hypot(x[0], x[1])), ratio(radius / r) {
    const double c = x[0] / r;
    const double s = x[1] / r;
    cosine[1] = c;
    sine[1] = s;
    for (int k = 2; k <= 4; ++k) {
      cosine[k] = cosine[k - 1] * c - sine[k - 1] * s;
      sine[k] = sine[k - 1] * c + cosine[k - 1] * s;
    }
  }
  double r;
  double ratio;
  double cosine[5];
  double sine[5];
};

} // namespace

problems::ExactSolution kirsch(double radius, double stress, const problems::Material &material) {
  const double nu = material.poisson_ratio;
  const double nu_bar = material.plane_strain ? nu / (1 - nu) : nu;
  const double e_bar =
      material.plane_strain ? material.youngs_modulus / ((1 - nu) * (1 + nu)) : material.youngs_modulus;
  const double factor = stress / e_bar;
  problems::ExactSolution exact;
  exact.displacement = [=](std::span<const Point2> points, std::span<Vector2> values) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Polar p(points[i], radius);
      const double q = p.ratio * p.ratio;
      const double third = 0.5 * (1 + nu_bar) * q * (1 - q);
      values[i] = {factor * p.r * ((1 + 2 * q) * p.cosine[1] + third * p.cosine[3]),
                   factor * p.r * ((-nu_bar - (1 - nu_bar) * q) * p.sine[1] + third * p.sine[3])};
    }
  };
  exact.stress = [=](std::span<const Point2> points, std::span<Stress2> values) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Polar p(points[i], radius);
      const double q = p.ratio * p.ratio;
      const double fourth = q * (1.5 * q - 1);
      values[i] = {stress * (1 - 1.5 * q * p.cosine[2] + fourth * p.cosine[4]),
                   stress * (-0.5 * q * p.cosine[2] - fourth * p.cosine[4]),
                   stress * (-0.5 * q * p.sine[2] + fourth * p.sine[4])};
    }
  };
  return exact;
}

} // namespace comparisons::benchmarks::plate_with_hole
