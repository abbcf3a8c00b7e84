// The exact solutions that scenes with a geometry of their own may name: Hooke's law and equilibrium by finite
// differences, free boundaries, the stress far away and the concentration factors.

#include "comparisons/problems/exact_solutions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace comparisons::problems;

Vector2 displacement(const ExactSolution &solution, const Point2 &point) {
  Vector2 u;
  solution.displacement({&point, 1}, {&u, 1});
  return u;
}

Stress2 stress(const ExactSolution &solution, const Point2 &point) {
  Stress2 s;
  solution.stress({&point, 1}, {&s, 1});
  return s;
}

/// Central difference of sixth order along axis k; its error is about (h / r)^6 / 140 of the value.
template <typename Function>
auto derivative(Function f, const Point2 &point, std::size_t k, double h) {
  auto result = f(point);
  result = {};
  const double coefficients[] = {0.75, -0.15, 1.0 / 60};
  for (int i = 1; i <= 3; ++i) {
    Point2 forward = point;
    Point2 backward = point;
    forward[k] += i * h;
    backward[k] -= i * h;
    const auto a = f(forward);
    const auto b = f(backward);
    for (std::size_t j = 0; j < result.size(); ++j)
      result[j] += coefficients[i - 1] * (a[j] - b[j]) / h;
  }
  return result;
}

/// Hooke's law and equilibrium at a point, relative to the stress there (1e-8).
void expect_elastic(const ExactSolution &solution, const Material &material, const Point2 &point, double length) {
  const double h = 2e-3 * length;
  const auto u = [&](const Point2 &p) { return displacement(solution, p); };
  const auto s = [&](const Point2 &p) { return stress(solution, p); };
  const auto u_1 = derivative(u, point, 0, h);
  const auto u_2 = derivative(u, point, 1, h);
  const auto s_1 = derivative(s, point, 0, h);
  const auto s_2 = derivative(s, point, 1, h);
  const double e = material.youngs_modulus;
  const double nu = material.poisson_ratio;
  const double mu = e / (2 * (1 + nu));
  const double lambda = material.plane_strain ? e * nu / ((1 + nu) * (1 - 2 * nu)) : e * nu / ((1 + nu) * (1 - nu));
  const Stress2 hooke{(lambda + 2 * mu) * u_1[0] + lambda * u_2[1], lambda * u_1[0] + (lambda + 2 * mu) * u_2[1],
                      mu * (u_1[1] + u_2[0])};
  const auto value = s(point);
  const double scale = std::hypot(value[0], value[1], value[2]);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(hooke[k], value[k], 1e-8 * scale) << "component " << k << " at " << point[0] << ", " << point[1];
  EXPECT_NEAR(s_1[0] + s_2[2], 0, 1e-8 * scale / length) << point[0] << ", " << point[1];
  EXPECT_NEAR(s_1[2] + s_2[1], 0, 1e-8 * scale / length) << point[0] << ", " << point[1];
}

const Material materials[] = {{200e9, 0.3, false}, {70e9, 0.33, true}, {1, 0, false}};

TEST(GeometrySolutions, the_elliptic_hole_is_elastic) {
  for (const auto &material : materials)
    for (const double a : {0.5, 1.0, 2.0, 5.0}) {
      const auto solution = elliptic_hole(a, 1, 1e6, material);
      for (int i = 0; i < 12; ++i) {
        const double t = 0.1 + 2 * std::numbers::pi * i / 12;
        const double r = 1.3 + 0.2 * i;
        expect_elastic(solution, material, {r * a * std::cos(t), r * std::sin(t)}, std::min(a, 1.0) / std::max(a, 1.0));
      }
    }
}

TEST(GeometrySolutions, the_elliptic_hole_is_free_and_concentrates_the_stress) {
  for (const double a : {0.5, 1.0, 2.0, 5.0}) {
    const auto solution = elliptic_hole(a, 1, 3e6, materials[0]);
    for (int i = 0; i < 16; ++i) {
      const double t = 2 * std::numbers::pi * i / 16;
      const auto s = stress(solution, {a * std::cos(t), std::sin(t)});
      Vector2 n{std::cos(t) / a, std::sin(t)};
      const double length = std::hypot(n[0], n[1]);
      n = {n[0] / length, n[1] / length};
      EXPECT_NEAR(s[0] * n[0] + s[2] * n[1], 0, 1e-9 * 3e6) << a << ", " << t;
      EXPECT_NEAR(s[2] * n[0] + s[1] * n[1], 0, 1e-9 * 3e6) << a << ", " << t;
    }
    EXPECT_NEAR(stress(solution, {a, 0})[1] / 3e6, 1 + 2 * a, 1e-9); // Inglis
    EXPECT_NEAR(stress(solution, {0, 1})[0] / 3e6, -1, 1e-9);
    const auto far = stress(solution, {1e5 * a, 2e5 * a});
    EXPECT_NEAR(far[0] / 3e6, 0, 1e-9);
    EXPECT_NEAR(far[1] / 3e6, 1, 1e-9);
    EXPECT_NEAR(far[2] / 3e6, 0, 1e-9);
  }
}

/// Kirsch's solution for the round hole: s22 along y = 0 is 1 + r^-2 / 2 + 3 r^-4 / 2.
TEST(GeometrySolutions, a_round_elliptic_hole_is_kirschs) {
  const auto solution = elliptic_hole(1, 1, 1, materials[1]);
  for (const double r : {1.0, 1.1, 1.5, 2.0, 4.0}) {
    EXPECT_NEAR(stress(solution, {r, 0})[1], 1 + 0.5 / (r * r) + 1.5 / std::pow(r, 4), 1e-12);
    EXPECT_NEAR(stress(solution, {r, 0})[0], 1.5 / (r * r) - 1.5 / std::pow(r, 4), 1e-12);
  }
}

TEST(GeometrySolutions, the_reentrant_corner_is_elastic_and_its_faces_are_free) {
  EXPECT_NEAR(reentrant_corner_exponent(), 0.544483737, 5e-10); // as printed by Szabo & Babuska
  for (const auto &material : materials) {
    const auto solution = reentrant_corner(2e6, material);
    for (int i = 0; i < 12; ++i) {
      const double t = -0.45 * std::numbers::pi + 1.4 * std::numbers::pi * i / 11;
      const double r = 0.2 + 0.07 * i;
      expect_elastic(solution, material, {r * std::cos(t), r * std::sin(t)}, 0.1);
    }
    for (const double r : {0.01, 0.3, 1.0}) {
      const double scale = 2e6 * std::pow(r, -0.46);
      const auto below = stress(solution, {0, -r}); // normal in x
      const auto left = stress(solution, {-r, 0});  // normal in y
      EXPECT_NEAR(below[0], 0, 1e-12 * scale);
      EXPECT_NEAR(below[2], 0, 1e-12 * scale);
      EXPECT_NEAR(left[1], 0, 1e-12 * scale);
      EXPECT_NEAR(left[2], 0, 1e-12 * scale);
    }
  }
}

} // namespace
