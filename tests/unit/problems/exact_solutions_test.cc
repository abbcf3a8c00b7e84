// Every exact solution that the project ships satisfies Hooke's law and equilibrium, by finite differences.

#include "comparisons/benchmarks/cantilever/exact_solution.h"
#include "comparisons/benchmarks/plate_with_hole/exact_solution.h"
#include "comparisons/problems/exact_solutions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace comparisons::problems;
namespace cantilever = comparisons::benchmarks::cantilever;
namespace plate_with_hole = comparisons::benchmarks::plate_with_hole;

struct Case {
  std::string name;
  Material material;
  ExactSolution exact;
  VectorField body_force; ///< empty: none
  std::vector<Point2> points;
  /// Length over which the solution changes, m.
  double length;
};

std::vector<Point2> around_the_hole() {
  std::vector<Point2> points;
  for (const double r : {1., 1.1, 1.7, 3., 9.})
    for (int k = 0; k < 16; ++k) {
      const double angle = .1 + 2 * M_PI * k / 16;
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
  return points;
}

/// The table: a new exact solution gets a line here.
std::vector<Case> all_solutions() {
  std::vector<Case> cases;
  const cantilever::Plate plate{1, .2, 1e6, {.3, -.1}};
  const std::vector<Point2> in_plate{{.35, -.08}, {.7, 0}, {1.2, .09}, {.31, .05}, {.9, -.02}};
  for (const bool plane_strain : {false, true})
    for (const double nu : {0., .33, .49}) {
      const Material material{226.9e9, nu, plane_strain};
      const std::string model = (plane_strain ? ", plane strain, nu = " : ", plane stress, nu = ") + std::to_string(nu);
      const auto add_cantilever = [&](const std::string &name, const cantilever::Solution &solution) {
        cases.push_back({name + model, material, solution.exact, solution.body_force, in_plate, plate.width});
      };
      add_cantilever("cantilever bending", cantilever::bending(plate, material));
      add_cantilever("cantilever linear", cantilever::linear(plate, material));
      add_cantilever("cantilever trigonometric", cantilever::trigonometric(plate, material));
      cases.push_back(
          {"Kirsch" + model, material, plate_with_hole::kirsch(1, 1e9, material), {}, around_the_hole(), 1});
    }
  return cases;
}

/// Central difference of sixth order of component `c` of a field along axis k.
template <typename Value, typename Field>
Value slope(const Field &field, const Point2 &x, std::size_t k, double step) {
  constexpr std::array<double, 3> weights{45. / 60, -9. / 60, 1. / 60};
  Value result{};
  for (std::size_t m = 0; m < 3; ++m)
    for (const double sign : {1., -1.}) {
      std::array<Point2, 1> point{x};
      point[0][k] += sign * double(m + 1) * step;
      std::array<Value, 1> value{};
      field(point, value);
      for (std::size_t c = 0; c < value[0].size(); ++c)
        result[c] += sign * weights[m] * value[0][c] / step;
    }
  return result;
}

/// Truncation is of the order (step / length)^6 = 1e-12 times some hundred, rounding 1e-16 length / step = 1e-14 of the
/// displacement, which is up to 1e4 strains times the length in the slender plate: below 1e-9 of the stress.
constexpr double relative_step = .01;
constexpr double tolerance = 1e-8;

TEST(ExactSolutions, satisfy_hookes_law) {
  for (const auto &test : all_solutions()) {
    const double nu = test.material.poisson_ratio;
    const double shear = test.material.youngs_modulus / (2 * (1 + nu));
    const double lambda = test.material.plane_strain ? 2 * shear * nu / (1 - 2 * nu) : 2 * shear * nu / (1 - nu);
    double largest = 0;
    std::vector<Stress2> stress(test.points.size());
    test.exact.stress(test.points, stress);
    for (const auto &s : stress)
      for (const double component : s)
        largest = std::max(largest, std::abs(component));
    ASSERT_GT(largest, 0) << test.name;
    for (std::size_t i = 0; i < test.points.size(); ++i) {
      const auto u_1 = slope<Vector2>(test.exact.displacement, test.points[i], 0, relative_step * test.length);
      const auto u_2 = slope<Vector2>(test.exact.displacement, test.points[i], 1, relative_step * test.length);
      const double trace = u_1[0] + u_2[1];
      EXPECT_NEAR(stress[i][0], lambda * trace + 2 * shear * u_1[0], tolerance * largest) << test.name;
      EXPECT_NEAR(stress[i][1], lambda * trace + 2 * shear * u_2[1], tolerance * largest) << test.name;
      EXPECT_NEAR(stress[i][2], shear * (u_2[0] + u_1[1]), tolerance * largest) << test.name;
    }
  }
}

TEST(ExactSolutions, are_in_equilibrium) {
  for (const auto &test : all_solutions())
    for (const auto &x : test.points) {
      const auto s_1 = slope<Stress2>(test.exact.stress, x, 0, relative_step * test.length);
      const auto s_2 = slope<Stress2>(test.exact.stress, x, 1, relative_step * test.length);
      std::array<Point2, 1> point{x};
      std::array<Vector2, 1> force{};
      if (test.body_force)
        test.body_force(point, force);
      std::array<Stress2, 1> stress{};
      test.exact.stress(point, stress);
      double scale = std::abs(force[0][0]) + std::abs(force[0][1]);
      for (std::size_t c = 0; c < 3; ++c)
        scale = std::max({scale, std::abs(s_1[c]), std::abs(s_2[c]), std::abs(stress[0][c]) / test.length});
      EXPECT_NEAR(s_1[0] + s_2[2] + force[0][0], 0, tolerance * scale) << test.name << " at " << x[0] << ", " << x[1];
      EXPECT_NEAR(s_1[2] + s_2[1] + force[0][1], 0, tolerance * scale) << test.name << " at " << x[0] << ", " << x[1];
    }
}

TEST(Kirsch, leaves_the_hole_free_and_concentrates_the_stress_threefold) {
  const auto exact = plate_with_hole::kirsch(2, 5, {1, .25, true});
  std::vector<Point2> edge;
  for (int k = 0; k <= 40; ++k)
    edge.push_back({2 * std::cos(.05 * M_PI * k), 2 * std::sin(.05 * M_PI * k)});
  std::vector<Stress2> s(edge.size());
  exact.stress(edge, s);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const auto [x, y] = edge[i];
    EXPECT_NEAR(s[i][0] * x + s[i][2] * y, 0, 1e-13 * 15);
    EXPECT_NEAR(s[i][2] * x + s[i][1] * y, 0, 1e-13 * 15);
    // sigma_tt = sigma0 (1 - 2 cos 2 theta), (4.7) at r = b.
    EXPECT_NEAR(s[i][0] + s[i][1], 5 * (1 - 2 * (x * x - y * y) / 4), 1e-13 * 15);
  }
  // (4.10): sigma_11 on the x2 axis; and u_2 there, Zhang & Batra 2008 below (6.25), with 1/2 b^2 / x2 as printed.
  const std::vector<Point2> axis{{0, 2}, {0, 3}, {0, 8}};
  std::vector<Stress2> on_axis(3);
  std::vector<Vector2> u(3);
  exact.stress(axis, on_axis);
  exact.displacement(axis, u);
  for (std::size_t i = 0; i < 3; ++i) {
    const double q = 4 / (axis[i][1] * axis[i][1]);
    EXPECT_NEAR(on_axis[i][0], 5 * (1 + .5 * q + 1.5 * q * q), 1e-13 * 15);
    const double nu = .25 / .75;
    const double r = axis[i][1];
    const double e = 1 / (1 - .0625);
    EXPECT_NEAR(u[i][1],
                (1 + nu) / e * 5 *
                    (-nu / (1 + nu) * r - (1 - nu) / (1 + nu) * 4 / r - .5 * 4 / r + .5 * 16 / (r * r * r)),
                1e-13 * std::abs(u[i][1]));
    EXPECT_NEAR(u[i][0], 0, 1e-13 * std::abs(u[i][1]));
  }
}

} // namespace
