// Constructing conditions of Liu, Liu & Lam 2003: what holds for which kernel, and the kernels rebuilt from them.

#include "meshless/kernels/consistency.h"
#include "meshless/kernels/constructing.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace meshless::kernels;
using refusal::mentions;
using refusal::message_of;

constexpr double pi = std::numbers::pi;

TEST(Conditions, integrals_of_all_kernels_are_one_and_odd_moments_vanish) {
  for (const auto &entry : kernel_table())
    for (int dim = 1; dim <= 3; ++dim) {
      const auto report = check_conditions(smoothing_function(make_kernel(entry.name, {}), dim), dim);
      EXPECT_NEAR(report.moments[0], 1, 1e-12) << entry.name << " " << dim;
      EXPECT_TRUE(report[Condition::normalised].holds) << entry.name;
      EXPECT_TRUE(report[Condition::first_moment].holds) << entry.name;
      EXPECT_TRUE(report[Condition::third_moment].holds) << entry.name;
      EXPECT_TRUE(report[Condition::symmetric].holds) << entry.name;
      // The table states what the quadrature finds.
      EXPECT_EQ(report[Condition::non_negative].holds, entry.non_negative) << entry.name;
      EXPECT_EQ(report[Condition::monotone].holds, entry.monotone) << entry.name;
      EXPECT_EQ(report[Condition::edge_value].holds, entry.edge_smoothness >= 0) << entry.name;
      EXPECT_EQ(report[Condition::edge_slope].holds, entry.edge_smoothness >= 1) << entry.name;
      if (entry.non_negative) {
        EXPECT_FALSE(report[Condition::second_moment].holds) << "of no non-negative function: " << entry.name;
      }
    }
}

TEST(Conditions, second_moments) {
  struct Row {
    const char *kernel;
    std::array<double, 3> moments; ///< exact, in one to three dimensions
  };
  const Row rows[] = {{"dome", {1. / 5, 1. / 3, 3. / 7}},
                      {"cubic_spline", {1. / 3, 31. / 49, 9. / 10}},
                      {"quintic", {1. / 2, 2771. / 2868, 7. / 5}},
                      {"new_quartic", {104. / 315, 30. / 49, 11. / 13}}};
  for (const auto &row : rows)
    for (int dim = 1; dim <= 3; ++dim) {
      const auto report = check_conditions(smoothing_function(make_kernel(row.kernel, {}), dim), dim);
      const double expected = row.moments[static_cast<std::size_t>(dim - 1)];
      EXPECT_NEAR(report.moments[2], expected, 1e-10) << row.kernel << " " << dim;
    }
}

TEST(Conditions, the_new_quartic_is_negative_near_its_edge) {
  const auto report = check_conditions(smoothing_function(NewQuartic(), 1), 1);
  ASSERT_EQ(report.negative.size(), 1u);
  // The root of 1/6 + S/6 - 5 S^2 / 32.
  EXPECT_NEAR(report.negative[0].first, (8 + std::sqrt(304.)) / 15, 1e-12);
  EXPECT_EQ(report.negative[0].second, 2);
  EXPECT_NEAR(report.least_value_at, 1.8, 1e-6); // a minimum: the square root of rounding
  EXPECT_NEAR(report.least_value, -1.583e-3, 5e-7);
  ASSERT_EQ(report.rising.size(), 1u);
  EXPECT_NEAR(report.rising[0].first, 1.8, 1e-11);
  EXPECT_EQ(report.edge_curvature, -.25);
  EXPECT_NEAR(report.centre, 2. / 3, 1e-15);
}

TEST(Conditions, the_printed_cubic_is_a_misprint) {
  // (41) with (2 - S)^2 instead of (2 - S)^3 in its outer part.
  const double factors[] = {1, 15 / (7 * pi), 3 / (2 * pi)};
  const double integrals[] = {37. / 36, 13. / 12, 7. / 6};
  for (int dim = 1; dim <= 3; ++dim) {
    const double factor = factors[dim - 1];
    const SmoothingFunction printed{.value =
                                        [=](double x) {
                                          const double s = std::abs(x);
                                          return factor *
                                                 (s < 1 ? 2. / 3 - s * s + .5 * s * s * s : (2 - s) * (2 - s) / 6);
                                        },
                                    .slope = {},
                                    .curvature = {},
                                    .support = 2,
                                    .breaks = {1}};
    const auto report = check_conditions(printed, dim);
    EXPECT_NEAR(report.moments[0], integrals[dim - 1], 1e-13) << dim;
    EXPECT_FALSE(report[Condition::normalised].holds);
    EXPECT_TRUE(report[Condition::edge_slope].holds) << "by differences, as no slope is given";
  }
}

TEST(Conditions, the_printed_factor_of_the_quintic_in_three_dimensions_is_a_misprint) {
  auto printed = smoothing_function(Quintic(), 3);
  printed.value = [](double s) { return 3 / (359 * pi) * Quintic().value(s * s); };
  EXPECT_NEAR(check_conditions(printed, 3).moments[0], 360. / 359, 1e-13);
}

TEST(Conditions, asymmetric_functions_are_noticed) {
  const SmoothingFunction skewed{.value = [](double s) { return .75 * (1 - s * s) * (1 + .5 * s); },
                                 .slope = {},
                                 .curvature = {},
                                 .support = 1,
                                 .breaks = {}};
  const auto report = check_conditions(skewed, 1);
  EXPECT_TRUE(report[Condition::normalised].holds);
  EXPECT_FALSE(report[Condition::symmetric].holds);
  EXPECT_FALSE(report[Condition::first_moment].holds);
  EXPECT_NEAR(report.moments[1], .1, 1e-14); // 3/8 times the integral of s^2 - s^4
  EXPECT_NEAR(report.edge_slope, -2.25, 1e-10);
}

/// Largest difference of the constructed function and a kernel, over the centre value.
double difference(const ConstructedFunction &constructed, const Kernel &kernel, int dim) {
  const auto expected = smoothing_function(kernel, dim);
  const auto function = constructed.polynomial.smoothing_function();
  double largest = 0;
  for (int i = 0; i <= 300; ++i) {
    const double s = expected.support * i / 300;
    largest = std::max({largest, std::abs(function.value(s) - expected.value(s)),
                        std::abs(function.slope(s) - expected.slope(s)),
                        std::abs(function.curvature(s) - expected.curvature(s))});
  }
  return largest / expected.value(0);
}

// Solved in long double and rounded: a few roundings of terms up to (3 - S)^5 / 66.
constexpr double rounding = 1e-13;

TEST(Construct, dome_cubic_quintic_and_new_quartic) {
  for (int dim = 1; dim <= 3; ++dim) {
    EXPECT_LT(difference(construct({.dim = dim, .degree = 2, .knots = {1}, .edge_derivatives = 1}), Dome(), dim),
              rounding);
    EXPECT_LT(difference(construct({.dim = dim, .degree = 3, .knots = {1, 2}, .zero_centre_derivatives = {1}}),
                         CubicSpline(), dim),
              rounding);
    EXPECT_LT(difference(construct({.dim = dim, .degree = 5, .knots = {1, 2, 3}, .zero_centre_derivatives = {1, 3}}),
                         Quintic(), dim),
              rounding);
    const double peak = smoothing_function(NewQuartic(), dim).value(0);
    EXPECT_LT(difference(construct({.dim = dim, .degree = 4, .knots = {2}, .peak = peak, .edge_derivatives = 2}),
                         NewQuartic(), dim),
              rounding);
  }
}

TEST(Construct, parameters_of_the_pieces) {
  // The paper has b_1 = 1/6, b_2 = -2/3 for the cubic, and 1, -6, 15 for the quintic: in its own form (40) they are the
  // other way round.
  const auto cubic = construct({.degree = 3, .knots = {1, 2}, .zero_centre_derivatives = {1}});
  EXPECT_NEAR(cubic.parameters[0], -2. / 3, 1e-15);
  EXPECT_NEAR(cubic.parameters[1], 1. / 6, 1e-15);
  const auto quintic = construct({.degree = 5, .knots = {1, 2, 3}, .zero_centre_derivatives = {1, 3}});
  const double expected[] = {15, -6, 1};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(quintic.parameters[i] * 120, expected[i], 1e-13);
  // 'Defining the center peak value' instead of the third derivative gives the same with the peak 66/120.
  const auto peaked = construct({.degree = 5, .knots = {1, 2, 3}, .peak = 66. / 120, .zero_centre_derivatives = {1}});
  EXPECT_LT(difference(peaked, Quintic(), 1), rounding);
}

TEST(Construct, the_peak_of_the_new_quartic_is_the_cubics_in_one_and_two_dimensions_only) {
  for (int dim = 1; dim <= 3; ++dim) {
    const double cubic = smoothing_function(CubicSpline(), dim).value(0);
    const double quartic = smoothing_function(NewQuartic(), dim).value(0);
    if (dim < 3) {
      EXPECT_NEAR(cubic, quartic, 1e-15);
    } else {
      EXPECT_GT(quartic / cubic, 1.009);
    }
  }
}

TEST(Construct, a_vanishing_second_moment_costs_the_sign) {
  for (int dim = 1; dim <= 3; ++dim) {
    const auto constructed =
        construct({.dim = dim, .degree = 4, .knots = {2}, .edge_derivatives = 2, .zero_moments = {2}});
    const auto report = check_conditions(constructed.polynomial.smoothing_function(), dim);
    for (const auto condition :
         {Condition::normalised, Condition::second_moment, Condition::edge_value, Condition::edge_slope})
      EXPECT_TRUE(report[condition].holds) << dim;
    EXPECT_FALSE(report[Condition::non_negative].holds);
  }
}

TEST(Construct, refuses_what_does_not_determine_a_function) {
  const auto refused = [](const ConstructingConditions &conditions) {
    return message_of<std::invalid_argument>([&] { construct(conditions); });
  };
  EXPECT_TRUE(mentions(refused({.degree = 4, .knots = {2}, .edge_derivatives = 2}), {"4 unknowns", "3 conditions"}));
  EXPECT_TRUE(
      mentions(refused({.degree = 2, .knots = {1}, .peak = .75, .edge_derivatives = 1}), {"2 unknowns", "3 cond"}));
  EXPECT_TRUE(mentions(refused({.degree = 2, .knots = {}}), {"without a support"}));
  EXPECT_TRUE(mentions(refused({.degree = 3, .knots = {2, 1}}), {"knot 2", "1"}));
  EXPECT_TRUE(mentions(refused({.dim = 4}), {"4 dimensions"}));
  EXPECT_TRUE(mentions(refused({.degree = 3, .knots = {1, 2}, .edge_derivatives = 1}), {"several pieces"}));
  // The third derivative of straight lines vanishes whatever the parameters.
  EXPECT_TRUE(
      mentions(refused({.degree = 1, .knots = {1, 2}, .zero_centre_derivatives = {3}}), {"depend on each other"}));
}

TEST(Consistency, is_restored_at_an_end) {
  std::vector<double> positions;
  std::vector<double> volumes;
  for (int i = 0; i < 12; ++i) {
    positions.push_back(.1 * i + .02 * std::sin(5. * i));
    volumes.push_back(.08 + .003 * i);
  }
  const auto window = [](double s) { return s * s < 4 ? CubicSpline().value(s * s) : 0; };
  for (const bool windowed : {false, true})
    for (int order = 0; order <= 3; ++order)
      for (const double x : {0., .33, .5, 1.1}) {
        const double h = .3;
        const auto restored = restore_consistency(x, positions, volumes, h, order,
                                                  windowed ? std::function<double(double)>(window) : nullptr);
        EXPECT_EQ(restored.coefficients.size(), static_cast<std::size_t>(order) + 1);
        for (int k = 0; k <= order; ++k) {
          double sum = 0;
          double size = 0;
          for (std::size_t j = 0; j < positions.size(); ++j) {
            const double term = restored.weights[j] * volumes[j] * std::pow((x - positions[j]) / h, k);
            sum += term;
            size += std::abs(term);
          }
          // Condition numbers up to 1e6 at the ends, for order 3.
          EXPECT_NEAR(sum, k == 0 ? 1 : 0, 1e-10 * size) << windowed << " " << order << " " << x << " " << k;
        }
      }
  // The paper's warning: at an end the restored function is negative somewhere.
  const auto end = restore_consistency(0, positions, volumes, .3, 1, window);
  EXPECT_LT(*std::min_element(end.weights.begin(), end.weights.end()), 0);
  EXPECT_TRUE(
      mentions(message_of<std::runtime_error>([&] { restore_consistency(0, positions, volumes, .04, 2, window); }),
               {"order 2", "1 particles"}));
  EXPECT_THROW(restore_consistency(0, positions, {}, .3, 1), std::invalid_argument);
}

} // namespace
