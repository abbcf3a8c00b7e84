// Kernels: integral, slope, edge, SIMD packs, and the table of names.

#include "meshless/kernels/kernel_table.h"
#include "meshless/linear_algebra/gauss_legendre.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace meshless::kernels;
using meshless::linear_algebra::n_lanes;
using meshless::linear_algebra::Pack;

const double root_pi = std::sqrt(std::numbers::pi);

/// Integral of W over its support in 1, 2 or 3 dimensions, in units of h^dim.
template <typename K>
double integral(const K &kernel, int dim) {
  const auto gauss = meshless::linear_algebra::gauss_legendre(40);
  const double surface[] = {2, 2 * std::numbers::pi, 4 * std::numbers::pi};
  double sum = 0;
  for (std::size_t q = 0; q < gauss.points.size(); ++q) {
    const double s = kernel.support() * gauss.points[q];
    sum += gauss.weights[q] * kernel.support() * std::pow(s, dim - 1) * kernel.value(s * s);
  }
  return surface[dim - 1] * sum;
}

/// Integral of s^k e^(-a s^2) from 0 to rho, k even, by parts.
double half_moment(int k, double a, double rho) {
  if (k == 0)
    return .5 * root_pi / std::sqrt(a) * std::erf(std::sqrt(a) * rho);
  return ((k - 1) * half_moment(k - 2, a, rho) - std::pow(rho, k - 1) * std::exp(-a * rho * rho)) / (2 * a);
}

// 40 Gauss points integrate an entire function over these intervals to rounding; a few dozen
// terms of one sign: 1e-14 relative.
constexpr double quadrature_rounding = 1e-14;

TEST(Gauss, integral_has_its_closed_form) {
  for (const double rho : {1., 2., 3., 4., 6.}) {
    const Gauss kernel(rho);
    const double edge = std::exp(-rho * rho);
    const double expected[] = {2 * (half_moment(0, 1, rho) - edge * rho),
                               std::numbers::pi * (1 - edge - edge * rho * rho),
                               4 * std::numbers::pi * (half_moment(2, 1, rho) - edge * std::pow(rho, 3) / 3)};
    for (int dim = 1; dim <= 3; ++dim)
      EXPECT_NEAR(integral(kernel, dim), expected[dim - 1], quadrature_rounding * 40) << dim << " " << rho;
  }
  // Without a cut-off G = 1: the integral tends to sqrt(pi)^dim, here up to e^-36.
  for (int dim = 1; dim <= 3; ++dim)
    EXPECT_NEAR(integral(Gauss(6), dim), std::pow(root_pi, dim), 1e-12);
}

TEST(RevisedSuperGauss, integral_has_its_closed_form) {
  for (const double rho : {1., 2., 3.})
    for (const double a : {1., 1.6, 2.5}) {
      const RevisedSuperGauss kernel(rho, a);
      const double area = rho * rho;
      const double expected[] = {2 * (area * half_moment(0, a, rho) - half_moment(2, a, rho)),
                                 std::numbers::pi * (area / a - (1 - std::exp(-a * area)) / (a * a)),
                                 4 * std::numbers::pi * (area * half_moment(2, a, rho) - half_moment(4, a, rho))};
      for (int dim = 1; dim <= 3; ++dim)
        EXPECT_NEAR(integral(kernel, dim), expected[dim - 1], quadrature_rounding * 40)
            << dim << " " << rho << " " << a;
    }
}

TEST(RevisedSuperGauss, normalisation_of_the_paper) {
  // Zhang & Batra 2008, below (6.10): G = 2/7 in one dimension for rho = 2, a = 1. That drops the
  // terms in erfc(2) and e^-4, as the exact 1/G = 7/2 erf(2) + 2 e^-4 / sqrt(pi) shows: .12 %.
  EXPECT_NEAR(root_pi / integral(RevisedSuperGauss(2, 1), 1), 2. / 7, .0015 * 2 / 7);
  EXPECT_NEAR(integral(RevisedSuperGauss(2, 1), 1) / root_pi, 3.5 * std::erf(2) + 2 * std::exp(-4) / root_pi, 1e-14);
}

class AnyKernel : public testing::TestWithParam<Kernel> {
protected:
  double value(double s_squared) const {
    return std::visit([=](const auto &k) { return k.value(s_squared); }, GetParam());
  }
  double slope(double s_squared) const {
    return std::visit([=](const auto &k) { return k.slope(s_squared); }, GetParam());
  }
  double support() const { return support_of(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Kernels, AnyKernel,
                         testing::Values(Kernel(Gauss(1)), Kernel(Gauss(4)), Kernel(RevisedSuperGauss(2, 1.6)),
                                         Kernel(RevisedSuperGauss(3, 1))));

TEST_P(AnyKernel, slope_is_the_derivative_of_the_value) {
  // Taylor remainder W(s + e) - W(s) - e s slope(s^2) = e^2 W''/2 + O(e^3): order 2 in e.
  for (const double part : {.0, .21, .43, .9}) {
    const double s = part * support();
    const auto remainder = [&](double e) {
      return std::abs(value((s + e) * (s + e)) - value(s * s) - e * s * slope(s * s));
    };
    // Close to an inflection point of W the cubic term takes over: the order is then 3.
    const double order = std::log2(remainder(2e-4) / remainder(1e-4));
    EXPECT_GT(order, 1.98) << s;
    EXPECT_LT(order, 3.02) << s;
    // Central differences: e^2 W'''/6 <= 2e-8 for |W'''| <= 100 at e = 3e-5, rounding 1e-16 / e.
    const double e = 3e-5;
    EXPECT_NEAR((value((s + e) * (s + e)) - value((s - e) * (s - e))) / (2 * e), s * slope(s * s), 2e-8) << s;
  }
}

TEST_P(AnyKernel, falls_from_the_centre_to_zero_at_the_edge) {
  const double edge = support() * support();
  EXPECT_NEAR(value(edge), 0, 1e-16);
  double last = value(0);
  for (int i = 1; i <= 200; ++i) {
    const double s = support() * i / 200;
    EXPECT_LT(value(s * s), last);
    EXPECT_LT(slope(s * s), 0);
    EXPECT_GE(value(s * s), i < 200 ? 1e-300 : -1e-16);
    last = value(s * s);
  }
}

TEST_P(AnyKernel, packs_give_the_values_of_scalars) {
  const double edge = support() * support();
  for (int i = 0; i <= 1000; ++i) {
    const double first = edge * i / 1000;
    const Pack s_squared([&](auto lane) { return first * (1 - .01 * static_cast<double>(lane)); });
    const Pack values = std::visit([&](const auto &k) { return k.value(s_squared); }, GetParam());
    const Pack slopes = std::visit([&](const auto &k) { return k.slope(s_squared); }, GetParam());
    for (int lane = 0; lane < n_lanes; ++lane) {
      const double x = s_squared[lane];
      // 4e-16 of the exponential function and a few roundings, relative to the largest value and slope.
      EXPECT_NEAR(values[lane], value(x), 1e-15 * value(0));
      EXPECT_NEAR(slopes[lane], slope(x), 1e-15 * std::abs(slope(0)));
    }
  }
}

TEST(KernelTable, makes_what_it_lists) {
  EXPECT_EQ(kernel_table().size(), std::variant_size_v<Kernel>);
  for (std::size_t i = 0; i < kernel_table().size(); ++i) {
    const auto &entry = kernel_table()[i];
    EXPECT_FALSE(entry.meaning.empty());
    const double support = entry.free_support ? 2.5 : entry.support;
    const auto kernel = make_kernel(entry.name, support);
    EXPECT_EQ(kernel.index(), i);
    EXPECT_EQ(support_of(kernel), support);
    if (entry.parameter.empty())
      continue;
    const auto value = [](const Kernel &k) { return std::visit([](const auto &each) { return each.value(1.3); }, k); };
    EXPECT_EQ(value(kernel), value(make_kernel(entry.name, support, entry.default_parameter)));
    EXPECT_NE(value(kernel), value(make_kernel(entry.name, support, entry.default_parameter + 1)));
  }
}

TEST(KernelTable, lists_the_names_when_there_is_no_such_kernel) {
  const auto message = refusal::message_of<std::invalid_argument>([] { make_kernel("gaus", 2); });
  EXPECT_TRUE(refusal::mentions(message, {"'gaus'"}));
  for (const auto &entry : kernel_table())
    EXPECT_TRUE(refusal::mentions(message, {entry.name}));
}

TEST(KernelTable, refuses_what_is_not_positive) {
  for (const double bad : {0., -1., std::nan("")}) {
    for (const auto &entry : kernel_table())
      EXPECT_THROW(make_kernel(entry.name, bad), std::invalid_argument);
    EXPECT_THROW(make_kernel("revised_super_gauss", 2, bad), std::invalid_argument);
  }
}

} // namespace
