// The force of the supports from the stress inside a body: exact stresses, stresses that no support feels, and the
// bound of its error.

#include "comparisons/metrics/force_balance.h"
#include "comparisons/metrics/support_force.h"
#include "unit/metrics/given_stress.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace comparisons;
using metrics_tests::GivenStress;
using problems::Point2;
using problems::Vector2;
using Stress = GivenStress::Stress;

/// Cubic in x, in equilibrium with body_force().
Stress exact(const Point2 &x) { return {2 + x[1] + x[0] * x[0], 1 - x[0] * x[1], .5 + x[0] - x[1] * x[1] * x[1]}; }
Vector2 body_force(const Point2 &x) { return {-2 * x[0] + 3 * x[1] * x[1], x[0] - 1}; }

/// The rectangle 0 <= x1 <= 2, 0 <= x2 <= 1 under the stress `exact`: the left side held, the bottom in x2 alone.
problems::PlaneStatement rectangle() {
  problems::PlaneStatement statement;
  statement.regions = {{"",
                        {1, .3, false},
                        {{{0, 0}, {2, 0}, 0, "bottom"},
                         {{2, 0}, {2, 1}, 1, "right"},
                         {{2, 1}, {0, 1}, 2, "top"},
                         {{0, 1}, {0, 0}, 3, "left"}}}};
  for (int id = 0; id < 4; ++id) {
    auto &condition = statement.conditions[id];
    condition.traction = [](std::span<const Point2> x, std::span<const Vector2> n, std::span<Vector2> t) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        const auto s = exact(x[i]);
        t[i] = {s[0] * n[i][0] + s[2] * n[i][1], s[2] * n[i][0] + s[1] * n[i][1]};
      }
    };
  }
  statement.conditions.at(3).displacement_prescribed = {true, true};
  statement.conditions.at(0).displacement_prescribed = {false, true};
  statement.body_force = [](std::span<const Point2> x, std::span<Vector2> b) {
    for (std::size_t i = 0; i < x.size(); ++i)
      b[i] = body_force(x[i]);
  };
  return statement;
}

/// n x n cells of 4 x 4 Gauss points.
problems::Quadrature area(int n) {
  const auto gauss = meshless::linear_algebra::gauss_legendre(4);
  problems::Quadrature result;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (std::size_t p = 0; p < 4; ++p)
        for (std::size_t q = 0; q < 4; ++q) {
          result.points.push_back({2 * (i + gauss.points[p]) / n, (j + gauss.points[q]) / n});
          result.weights.push_back(2 * gauss.weights[p] * gauss.weights[q] / (n * n));
        }
  return result;
}

std::array<double, 2> force(const methods::Solution &solution, const problems::PlaneStatement &statement,
                            const problems::Quadrature &quadrature) {
  const auto found = metrics::support_force(solution, statement, problems::boundary_quadrature(statement), quadrature);
  return {found[0].value(), found[1].value()};
}

// Left, n = (-1, 0): minus int (sigma11, sigma12) dx2 = -(2.5, .25); bottom, n = (0, -1): minus int sigma22 dx1 = -2.
constexpr double left_1 = -2.5, left_and_bottom_2 = -.25 - 2;

TEST(SupportForce, of_an_exact_stress_is_that_of_the_supports) {
  const auto statement = rectangle();
  const GivenStress stress(exact);
  double before = 0;
  for (const int n : {8, 16, 32}) {
    const auto found = force(stress, statement, area(n));
    // The weight of one straight support is a polynomial of degree 5; that of two has a corner where they meet.
    EXPECT_NEAR(found[0], left_1, 1e-13);
    const double error = std::abs(found[1] - left_and_bottom_2);
    EXPECT_LT(error, 1e-4);
    if (before > 0) {
      EXPECT_LT(error, before / 8) << n; // third order at least
    }
    before = error;
  }
}

TEST(SupportForce, is_the_reaction_of_a_single_support_and_enters_the_balance) {
  const auto statement = rectangle();
  const auto balance = metrics::equilibrium(GivenStress(exact), statement, area(32));
  EXPECT_NEAR(balance.boundary.at(3)[0], left_1, 1e-13);
  EXPECT_NEAR(balance.boundary.at(3)[1], -.25, 1e-12); // two supports: each its integral of the stress
  EXPECT_NEAR(balance.boundary.at(0)[1], -2, 1e-12);
  EXPECT_LT(balance.imbalance, 1e-6);
}

/// A stress in equilibrium by itself, of Airy's function (x1 (2 - x1) x2 (1 - x2))^3: no traction anywhere.
TEST(SupportForce, does_not_feel_a_stress_that_loads_nothing) {
  const auto statement = rectangle();
  const auto cube = [](double p, double p1, double p2) { // p^3, its first and second derivatives
    return std::array<double, 3>{p * p * p, 3 * p * p * p1, 6 * p * p1 * p1 + 3 * p * p * p2};
  };
  const GivenStress stress([&](const Point2 &x) {
    const auto f = cube(x[0] * (2 - x[0]), 2 - 2 * x[0], -2), g = cube(x[1] * (1 - x[1]), 1 - 2 * x[1], -2);
    auto s = exact(x);
    s[0] += 50 * f[0] * g[2];
    s[1] += 50 * f[2] * g[0];
    s[2] -= 50 * f[1] * g[1];
    return s;
  });
  const auto found = force(stress, statement, area(32));
  EXPECT_NEAR(found[0], left_1, 1e-5);
  EXPECT_NEAR(found[1], left_and_bottom_2, 1e-5);
}

/// The stress at the supports may be as wrong as it likes on a small part: what counts is the mean square.
TEST(SupportForce, errs_by_no_more_than_the_stress_in_the_mean_square) {
  const auto statement = rectangle();
  for (const double width : {.4, .2, .1, .05}) {
    // An error of size 1 within `width` of the corner of both supports: its L2 norm is sqrt(pi) / 2 width.
    const GivenStress stress([&](const Point2 &x) {
      auto s = exact(x);
      if (std::hypot(x[0], x[1]) < width)
        for (double &component : s)
          component += 1;
      return s;
    });
    const auto quadrature = area(128);
    const auto found = force(stress, statement, quadrature);
    // |grad w| <= 15 / (8 max r), max r of one support 2, of two at (2, 1) 2 / sqrt(5): times sqrt(2) for two entries.
    const double norm = std::sqrt(2.) * std::sqrt(std::acos(-1.) / 4) * width;
    EXPECT_LE(std::abs(found[0] - left_1), norm * 15 / 16 * std::sqrt(2.));
    EXPECT_LE(std::abs(found[1] - left_and_bottom_2), norm * 15 / 8 * std::sqrt(5.) / 2 * std::sqrt(2.));
    // On the support itself it is as wrong as the part is long.
    const auto boundary = metrics::equilibrium(stress, statement, {}).boundary;
    EXPECT_NEAR(boundary.at(3)[0] - left_1, -width, .01);
    EXPECT_LT(std::abs(found[0] - left_1), .1 * width);
  }
}

} // namespace
