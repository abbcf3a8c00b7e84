// Gauss-Legendre rules against exact integrals.

#include "meshless/linear_algebra/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace meshless::linear_algebra;

template <typename F>
double integrate(const GaussRule &rule, const F &f) {
  double sum = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    sum += rule.weights[q] * f(rule.points[q]);
  return sum;
}

TEST(GaussLegendre, is_exact_up_to_degree_2n_minus_1) {
  for (const int n : {1, 2, 3, 4, 5, 7, 10, 16, 32, 40, 64, 128}) {
    const auto rule = gauss_legendre(n);
    ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n));
    for (int degree = 0; degree <= 2 * n - 1; ++degree)
      // Nodes and weights to a few roundings, and the power multiplies a node's by its degree.
      EXPECT_NEAR(integrate(rule, [=](double x) { return std::pow(x, degree); }), 1. / (degree + 1),
                  5e-16 * (4 + n / 4))
          << n << " " << degree;
    // The first power that is not integrated: error (n!)^4 / ((2n + 1) ((2n)!)^2).
    if (n <= 7) {
      const double factor = std::pow(std::tgamma(n + 1.), 4) / ((2 * n + 1) * std::pow(std::tgamma(2. * n + 1), 2));
      const double error = 1. / (2 * n + 1) - integrate(rule, [=](double x) { return std::pow(x, 2 * n); });
      EXPECT_NEAR(error, factor, 1e-6 * factor + 5e-16);
    }
  }
}

TEST(GaussLegendre, points_increase_and_lie_symmetric_with_positive_weights) {
  for (int n = 1; n <= 64; ++n) {
    const auto rule = gauss_legendre(n);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const std::size_t mirror = rule.points.size() - 1 - q;
      EXPECT_GT(rule.points[q], q == 0 ? 0. : rule.points[q - 1]);
      EXPECT_LT(rule.points[q], 1);
      EXPECT_GT(rule.weights[q], 0);
      EXPECT_NEAR(rule.points[q] + rule.points[mirror], 1, 3e-16);
      EXPECT_NEAR(rule.weights[q], rule.weights[mirror], 1e-14 * rule.weights[q]);
    }
  }
}

TEST(GaussLegendre, integrates_smooth_functions_to_rounding) {
  // e^x on [0, 1]: the error (n!)^4 e / ((2n + 1) (2n)!^3) is below 1e-19 from n = 8 on; what is left
  // is the rounding of sums of up to 40 terms.
  EXPECT_NEAR(integrate(gauss_legendre(8), [](double x) { return std::exp(x); }), std::numbers::e - 1, 4e-15);
  EXPECT_NEAR(integrate(gauss_legendre(40), [](double x) { return 1 / (1 + x * x); }), std::numbers::pi / 4, 4e-15);
}

TEST(GaussLegendre, cached_rules_stay_where_they_are) {
  const auto &first = cached_gauss_legendre(10);
  for (int n = 1; n < 60; ++n)
    cached_gauss_legendre(n);
  EXPECT_EQ(&first, &cached_gauss_legendre(10));
  EXPECT_EQ(first.points, gauss_legendre(10).points);
  EXPECT_EQ(first.weights, gauss_legendre(10).weights);
}

TEST(GaussLegendre, needs_a_point) {
  for (const int n : {0, -1}) {
    EXPECT_THROW(gauss_legendre(n), std::invalid_argument);
    EXPECT_THROW(cached_gauss_legendre(n), std::invalid_argument);
    EXPECT_THROW(cached_gauss_legendre(n), std::invalid_argument) << "also the second time";
  }
}

} // namespace
