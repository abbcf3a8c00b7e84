// The exponential function of SIMD packs against the library's in long double.

#include "meshless/linear_algebra/pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace meshless::linear_algebra;

/// Largest relative error over the arguments.
double largest_error(const std::vector<double> &arguments) {
  double largest = 0;
  for (std::size_t i = 0; i < arguments.size(); i += n_lanes) {
    const Pack x([&](auto lane) { return arguments[std::min(i + lane, arguments.size() - 1)]; });
    const Pack y = exponential(x);
    for (int lane = 0; lane < n_lanes; ++lane) {
      const long double exact = std::exp(static_cast<long double>(x[lane]));
      largest = std::max(largest, static_cast<double>(std::abs((y[lane] - exact) / exact)));
    }
  }
  return largest;
}

TEST(Exponential, error_below_the_stated_bound) {
  std::vector<double> dense;
  for (int i = -200000; i <= 200000; ++i)
    dense.push_back(i * 3.5e-3 * (1 + 1e-9)); // all of [-700, 700]
  EXPECT_LT(largest_error(dense), 4e-16);
  std::vector<double> kernels;
  for (int i = 0; i <= 200000; ++i)
    kernels.push_back(-36. * i / 200000); // where kernels with a support of up to 6 h live
  EXPECT_LT(largest_error(kernels), 4e-16);
}

TEST(Exponential, error_below_the_stated_bound_where_the_reduction_changes) {
  // On both sides of x = (k + 1/2) ln 2, where |r| is largest.
  std::vector<double> arguments;
  for (int k = -1000; k < 1000; ++k)
    for (const double offset : {-1e-15, 0., 1e-15})
      arguments.push_back((k + .5) * std::log(2.) * (1 + offset));
  EXPECT_LT(largest_error(arguments), 4e-16);
}

TEST(Exponential, special_arguments) {
  EXPECT_EQ(exponential(Pack(0.))[0], 1);
  EXPECT_EQ(exponential(Pack(-0.))[0], 1);
  EXPECT_EQ(exponential(Pack(5e-324))[0], 1);
  EXPECT_EQ(exponential(.3), std::exp(.3));
}

TEST(Pack, padding_holds_all_points) {
  for (std::size_t n = 0; n < 40; ++n) {
    EXPECT_GE(padded(n), n);
    EXPECT_LT(padded(n), n + n_lanes);
    EXPECT_EQ(padded(n) % n_lanes, 0u);
  }
}

} // namespace
