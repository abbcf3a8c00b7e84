// Forces on the boundary by integrals of the stress: balance of an exact field, and an imbalance of known size.

#include "comparisons/metrics/force_balance.h"
#include "comparisons/problems/boundary_quadrature.h"
#include "unit/metrics/given_stress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace comparisons;
using metrics_tests::GivenStress;
using problems::Point2;
using problems::Vector2;

constexpr double pi = std::numbers::pi;

/// sigma11 = a + b x2, sigma22 = c, sigma12 = d: in equilibrium without body force, times a factor.
GivenStress linear_stress(double factor) {
  return GivenStress([factor](const Point2 &x) -> GivenStress::Stress {
    return {factor * (2 + 3 * x[1]), factor * -1, factor * .5};
  });
}

/// Quarter ring between the radii 1 and 2: bottom held, the rest loaded by the tractions of the field.
problems::PlaneStatement quarter_ring() {
  problems::PlaneStatement statement;
  const problems::Arc inner{{0, 0}, false};
  const problems::Arc outer{{0, 0}, true};
  statement.regions = {{"",
                        {1, .3, false},
                        {{{1, 0}, {2, 0}, 0, "bottom"},
                         {{2, 0}, {0, 2}, 1, "outer", outer},
                         {{0, 2}, {0, 1}, 2, "left"},
                         {{0, 1}, {1, 0}, 3, "inner", inner}}}};
  problems::BoundaryCondition held;
  held.displacement_prescribed = {true, true};
  problems::BoundaryCondition loaded;
  loaded.traction = [](std::span<const Point2> x, std::span<const Vector2> n, std::span<Vector2> t) {
    for (std::size_t i = 0; i < x.size(); ++i)
      t[i] = {(2 + 3 * x[i][1]) * n[i][0] + .5 * n[i][1], .5 * n[i][0] - n[i][1]};
  };
  statement.conditions = {{0, held}, {1, loaded}, {2, loaded}, {3, loaded}};
  return statement;
}

TEST(BoundaryQuadrature, lengths_and_normals_of_lines_and_arcs) {
  const auto boundary = problems::boundary_quadrature(quarter_ring());
  const double lengths[] = {1, pi, 1, pi / 2};
  ASSERT_EQ(boundary.size(), 4u);
  std::array<double, 2> closed{};
  for (const auto &[id, points] : boundary) {
    double length = 0;
    for (std::size_t q = 0; q < points.weights.size(); ++q) {
      length += points.weights[q];
      for (std::size_t k = 0; k < 2; ++k)
        closed[k] += points.weights[q] * points.normals[q][k];
    }
    EXPECT_NEAR(length, lengths[id], 1e-13);
  }
  // The integral of the normal over a closed curve is zero (Gauss rule of ten-thousandths of a turn: rounding).
  EXPECT_NEAR(closed[0], 0, 1e-13);
  EXPECT_NEAR(closed[1], 0, 1e-13);
  for (std::size_t q = 0; q < boundary.at(3).points.size(); ++q) { // the inner arc: out is towards the centre
    EXPECT_NEAR(boundary.at(3).normals[q][0], -boundary.at(3).points[q][0], 1e-14);
    EXPECT_NEAR(boundary.at(3).normals[q][1], -boundary.at(3).points[q][1], 1e-14);
  }
}

TEST(ForceBalance, an_exact_stress_balances_its_loads) {
  const auto statement = quarter_ring();
  const auto exact = metrics::equilibrium(linear_stress(1), statement, {});
  EXPECT_LT(exact.imbalance, 1e-13);
  // Bottom, normal (0, -1): the support's force is minus (sigma12, sigma22) times the length.
  EXPECT_NEAR(exact.boundary.at(0)[0], -.5, 1e-13);
  EXPECT_NEAR(exact.boundary.at(0)[1], 1, 1e-13);
}

TEST(ForceBalance, a_wrong_stress_leaves_its_share) {
  const auto statement = quarter_ring();
  const auto wrong = metrics::equilibrium(linear_stress(1.1), statement, {});
  // The magnitude of the tractions on the arcs and on the line x1 = 0, by Simpson's rule.
  const auto traction = [](double x2, double n1, double n2) {
    return std::hypot((2 + 3 * x2) * n1 + .5 * n2, .5 * n1 - n2);
  };
  const auto all = [&](double t) {
    const double c = std::cos(t * pi / 2);
    const double s = std::sin(t * pi / 2);
    return (2 * traction(2 * s, c, s) + traction(s, c, s)) * pi / 2 + traction(1 + t, -1, 0);
  };
  double loads = 0;
  constexpr int n = 2000;
  for (int i = 0; i < n; ++i)
    loads += (all(double(i) / n) + 4 * all((i + .5) / n) + all((i + 1.) / n)) / (6 * n);
  // Only the reaction comes from the solution: a tenth of it is left over.
  EXPECT_NEAR(wrong.imbalance, .1 * std::hypot(.5, 1) / loads, 1e-12);
}

/// By the equations of a method with a penalty alpha the bottom is held by sigma n - alpha (u - ubar): a stress that is
/// a tenth too large balances with the displacement that takes a tenth back, and only with that.
TEST(ForceBalance, the_penalty_is_a_part_of_the_force_of_a_support) {
  auto statement = quarter_ring();
  statement.conditions.at(0).displacement = [](std::span<const Point2>, std::span<Vector2> u) {
    for (auto &value : u)
      value = {.3, -.2};
  };
  constexpr double alpha = 1e4;
  const auto stress = [](const Point2 &x) -> GivenStress::Stress { return {1.1 * (2 + 3 * x[1]), -1.1, 1.1 * .5}; };
  const auto with = [&](const Vector2 &u) {
    return metrics::equilibrium(GivenStress(stress, alpha, u), statement, {});
  };
  // sigma n = (-.5, 1) along the bottom, of length 1.
  const auto balanced = with({.3 - .1 * .5 / alpha, -.2 + .1 / alpha});
  const auto at_rest = with({.3, -.2});
  ASSERT_TRUE(balanced.discrete_imbalance && at_rest.discrete_imbalance);
  EXPECT_LT(*balanced.discrete_imbalance, 1e-12);
  EXPECT_NEAR(*at_rest.discrete_imbalance, at_rest.imbalance, 1e-12);
  EXPECT_GT(at_rest.imbalance, 1e-3);
  EXPECT_FALSE(metrics::equilibrium(GivenStress(stress), statement, {}).discrete_imbalance);
}

/// Loads that balance on one boundary are loads: a small imbalance beside them is small.
TEST(ForceBalance, loads_that_balance_among_themselves_count) {
  auto statement = quarter_ring();
  auto &outer = statement.conditions.at(1);
  outer.traction = [](std::span<const Point2> x, std::span<const Vector2>, std::span<Vector2> t) {
    for (std::size_t i = 0; i < x.size(); ++i)
      t[i] = {0, 1e6 * (x[i][0] - x[i][1])}; // antisymmetric about the diagonal
  };
  for (const int id : {2, 3})
    statement.conditions.at(id).traction = {};
  const auto result = metrics::equilibrium(linear_stress(1), statement, {});
  // The integral of 2e6 |cos t - sin t| over the arc of radius 2 is 8e6 (sqrt 2 - 1).
  // The kink at the diagonal costs the quadrature some digits.
  EXPECT_NEAR(result.imbalance / std::hypot(.5, 1) * 8e6 * (std::sqrt(2) - 1), 1, 1e-4);
}

/// Held all around, nothing is applied: the scale is what the boundary carries, not what is left over.
TEST(ForceBalance, a_body_held_all_around_has_a_scale) {
  auto statement = quarter_ring();
  for (auto &[id, condition] : statement.conditions)
    condition = statement.conditions.at(0);
  for (auto &piece : statement.regions[0].boundary)
    piece.id = 0;
  EXPECT_LT(metrics::equilibrium(linear_stress(1), statement, {}).imbalance, 1e-13);
}

TEST(ForceBalance, a_body_force_counts) {
  auto statement = quarter_ring();
  statement.body_force = [](std::span<const Point2>, std::span<Vector2> b) {
    for (auto &value : b)
      value = {7, 0};
  };
  problems::Quadrature area;
  area.points = {{1.2, .5}, {.5, 1.2}};
  area.weights = {1, 2};
  EXPECT_NEAR(metrics::equilibrium(linear_stress(1), statement, area).body[0], 21, 1e-13);
}

} // namespace
