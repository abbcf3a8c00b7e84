// Every kernel of the table: normalisation, derivatives, and the properties that the table states.

#include "meshless/kernels/kernel_table.h"
#include "meshless/linear_algebra/gauss_legendre.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace meshless::kernels;
using meshless::linear_algebra::n_lanes;
using meshless::linear_algebra::Pack;

class TabulatedKernel : public testing::TestWithParam<KernelDescription> {
protected:
  double value(double s) const {
    return std::visit([=](const auto &k) { return k.value(s * s); }, kernel);
  }
  /// W', 0 at the centre by agreement.
  double derivative(double s) const {
    return std::visit([=](const auto &k) { return s * k.slope(s * s); }, kernel);
  }
  double curvature(double s) const {
    return std::visit([=](const auto &k) { return k.curvature(s * s); }, kernel);
  }

  /// Distances inside the support, away from the breaks.
  std::vector<double> samples() const {
    std::vector<double> result;
    const auto breaks = breaks_of(kernel);
    for (int i = 1; i < 40; ++i) {
      const double s = support_of(kernel) * i / 40;
      if (std::none_of(breaks.begin(), breaks.end(), [=](double b) { return std::abs(b - s) < 1e-3; }))
        result.push_back(s);
    }
    return result;
  }

  Kernel kernel = make_kernel(GetParam().name, {});
};
INSTANTIATE_TEST_SUITE_P(Table, TabulatedKernel, testing::ValuesIn(kernel_table().begin(), kernel_table().end()),
                         [](const auto &kernel) { return std::string(kernel.param.name); });

TEST_P(TabulatedKernel, has_the_integral_one) {
  auto ends = breaks_of(kernel);
  ends.insert(ends.begin(), 0);
  ends.push_back(support_of(kernel));
  const auto gauss = meshless::linear_algebra::gauss_legendre(60);
  for (int dim = 1; dim <= 3; ++dim) {
    double integral = 0;
    for (std::size_t piece = 1; piece < ends.size(); ++piece)
      for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const double width = ends[piece] - ends[piece - 1];
        const double s = ends[piece - 1] + width * gauss.points[q];
        integral += gauss.weights[q] * width * std::pow(s, dim - 1) * value(s);
      }
    // 60 points integrate all of them to rounding: a few dozen terms.
    EXPECT_NEAR(sphere_surface(dim) * integral * normalisation_of(kernel, dim), 1, 1e-14) << dim;
  }
}

TEST_P(TabulatedKernel, derivatives_are_those_of_the_value) {
  // Central differences: e^2 / 6 times the next derivative (below 400) and rounding 1e-16 W(0) / e.
  const double e = 1e-5;
  const double tolerance = 1e-8 + 1e-16 * std::abs(value(0)) / e;
  for (const double s : samples()) {
    EXPECT_NEAR((value(s + e) - value(s - e)) / (2 * e), derivative(s), tolerance) << s;
    EXPECT_NEAR((derivative(s + e) - derivative(s - e)) / (2 * e), curvature(s), tolerance) << s;
  }
}

TEST_P(TabulatedKernel, centre_is_as_stated) {
  // The limit of W' at the centre, by the slope W'/s and by the value.
  const double e = 1e-6;
  const double limit = (value(e) - value(0)) / e;
  EXPECT_EQ(std::abs(limit) > .1, GetParam().kink);
  EXPECT_EQ(derivative(0), 0);
  EXPECT_TRUE(std::isfinite(curvature(0)));
  if (!GetParam().kink) {
    EXPECT_NEAR(std::visit([](const auto &k) { return k.slope(0.); }, kernel), curvature(0),
                1e-15 * std::abs(curvature(0)))
        << "W'/s tends to W''(0)";
  }
}

TEST_P(TabulatedKernel, sign_and_monotony_are_as_stated) {
  double smallest = value(0);
  double steepest_rise = -1;
  for (int i = 1; i < 2000; ++i) {
    const double s = support_of(kernel) * i / 2000;
    smallest = std::min(smallest, value(s));
    steepest_rise = std::max(steepest_rise, derivative(s));
  }
  EXPECT_EQ(smallest >= 0, GetParam().non_negative) << smallest;
  EXPECT_EQ(steepest_rise <= 0, GetParam().monotone) << steepest_rise;
}

TEST_P(TabulatedKernel, edge_is_as_smooth_as_stated) {
  const double edge = support_of(kernel);
  const double e = 1e-3;
  // Derivatives 0 to 2 at the edge, 3 to 5 by differences that are exact for these polynomials up to e.
  const double third = (curvature(edge) - curvature(edge - e)) / e;
  const double fourth = (curvature(edge) - 2 * curvature(edge - e) + curvature(edge - 2 * e)) / (e * e);
  const double fifth =
      (curvature(edge) - 3 * curvature(edge - e) + 3 * curvature(edge - 2 * e) - curvature(edge - 3 * e)) / (e * e * e);
  const double derivatives[] = {value(edge), derivative(edge), curvature(edge), third, fourth, fifth};
  int smoothness = -1;
  // 120 e (quintic) is what the differences leave of a vanishing derivative; the super Gauss jumps by 1.5e-6.
  const double zero[] = {1e-14 * value(0), 1e-14 * value(0), 1e-14 * value(0), .1, .3, .3};
  while (smoothness < 5 && std::abs(derivatives[smoothness + 1]) <= zero[smoothness + 1])
    ++smoothness;
  EXPECT_EQ(smoothness, GetParam().edge_smoothness);
}

TEST_P(TabulatedKernel, packs_give_the_values_of_scalars) {
  const double edge = support_of(kernel) * support_of(kernel);
  for (int i = 0; i <= 500; ++i) {
    const double first = edge * i / 500;
    const Pack s_squared([&](auto lane) { return first * (1 - .01 * static_cast<double>(lane)); });
    std::visit(
        [&](const auto &k) {
          const Pack values = k.value(s_squared);
          const Pack slopes = k.slope(s_squared);
          const Pack curvatures = k.curvature(s_squared);
          for (int lane = 0; lane < n_lanes; ++lane) {
            const double x = s_squared[lane];
            // 4e-16 of the exponential function and a few roundings of powers up to (3 - s)^5.
            EXPECT_NEAR(values[lane], k.value(x), 4e-15 * k.value(0.));
            EXPECT_NEAR(slopes[lane], k.slope(x), 4e-15 * (std::abs(k.slope(x)) + std::abs(k.slope(0.))));
            EXPECT_NEAR(curvatures[lane], k.curvature(x), 1e-14 * (1 + std::abs(k.curvature(0.))));
          }
        },
        kernel);
  }
}

TEST(Normalisation, is_the_published_one) {
  struct Published {
    const char *kernel;
    std::optional<double> parameter;
    std::array<double, 3> factor; ///< 0: not given
  };
  // Zhang & Batra 2008, below (6.2) and (6.9), G in six digits; the rest by an independent computation.
  const Published all[] = {
      {"linear", {}, {1, .477465, .238732}},
      {"quadratic", {}, {.75, .477465, .298416}},
      {"cubic_spline", {}, {2. / 3, .454728, .318310}},
      {"quartic", {}, {.625, .397887, .261114}},
      {"revised_gauss", {}, {1.04823, 1.10081, 1.18516}},
      {"revised_super_gauss", 1, {.28536, .33131, .39211}},
      {"revised_super_gauss", 1.2, {.30558, 0, 0}},
      {"revised_super_gauss", 1.4, {.32476, 0, 0}},
      {"revised_super_gauss", 1.6, {.34301, 0, 0}},
      {"dome", {}, {.75, .636620, .596831}},
      {"quintic", {}, {.00833333, .00466144, .00265258}},
      {"new_quartic", {}, {1, .682093, .482056}},
  };
  for (const auto &entry : all)
    for (int dim = 1; dim <= 3; ++dim)
      if (const double expected = entry.factor[static_cast<std::size_t>(dim - 1)]; expected > 0) {
        // Half a unit of the last digit given.
        const double digit = expected < .1 ? 5e-9 : entry.parameter || expected > 1.01 ? 5e-6 : 5e-7;
        EXPECT_NEAR(published_normalisation_of(make_kernel(entry.kernel, {}, entry.parameter), dim), expected, digit)
            << entry.kernel << " " << dim;
      }
}

TEST(KernelTable, gives_a_fixed_support_or_refuses) {
  for (const auto &entry : kernel_table()) {
    EXPECT_EQ(support_of(make_kernel(entry.name, {})), entry.support);
    EXPECT_EQ(support_of(make_kernel(entry.name, entry.support)), entry.support);
    EXPECT_EQ(describe(make_kernel(entry.name, {})).name, entry.name);
    const auto message = refusal::message_of<std::invalid_argument>([&] { make_kernel(entry.name, 2.75); });
    if (entry.free_support) {
      EXPECT_EQ(message, "");
    } else {
      EXPECT_TRUE(refusal::mentions(message, {entry.name, "2.75 h", "leave it out"}));
    }
    if (entry.parameter.empty()) {
      EXPECT_TRUE(refusal::mentions(
          refusal::message_of<std::invalid_argument>([&] { make_kernel(entry.name, {}, 1.); }), {"has no parameter"}));
    }
  }
}

TEST(RevisedGauss, is_gauss_cut_off_at_two) {
  const RevisedGauss revised;
  const Gauss gauss(2);
  for (double s_squared = 0; s_squared < 4; s_squared += .3)
    EXPECT_EQ(revised.value(s_squared), gauss.value(s_squared));
}

} // namespace
