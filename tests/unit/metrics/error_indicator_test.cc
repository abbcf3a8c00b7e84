#include "comparisons/metrics/error_indicator.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace metrics = comparisons::metrics;

TEST(Effectivity, is_the_indicator_over_the_error_of_stress) {
  EXPECT_DOUBLE_EQ(metrics::effectivity(.06, {{"stress_l2_relative", .04}, {"displacement_l2_relative", 1}}).value(),
                   1.5);
}

TEST(Effectivity, is_not_known_without_an_exact_stress_or_where_only_rounding_is_left) {
  EXPECT_FALSE(metrics::effectivity(.06, {{"displacement_l2_relative", .1}}).has_value());
  EXPECT_FALSE(metrics::effectivity(.06, {{"stress_l2_relative", 3e-15}}).has_value());
  EXPECT_FALSE(metrics::effectivity(.06, {{"stress_l2_relative", std::nan("")}}).has_value());
}

} // namespace
