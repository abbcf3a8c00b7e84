// Growth of perturbations under stress: closed forms, and the acceleration of a row of particles that is really moved.

#include "meshless/kernels/kernel_table.h"
#include "meshless/kernels/stress_growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace meshless::kernels;

SmoothingFunction function_of(const char *name) { return smoothing_function(make_kernel(name, {}), 1); }

/// With h = D only the first neighbours have a part, W''(1), and particles that move against each other grow fastest.
TEST(StressGrowth, of_particles_one_smoothing_length_apart) {
  EXPECT_NEAR(stress_growth(function_of("cubic_spline"), 1).tension, 4, 1e-12);
  EXPECT_NEAR(stress_growth(function_of("new_quartic"), 1).tension, 4 * (-9. / 4 + 19. / 4 - 15. / 8), 1e-12);
  EXPECT_EQ(stress_growth(function_of("cubic_spline"), 1).compression, 0);
}

/// The cubic's neighbours at S = 1/2, 1, 3/2 have W'' = -1/2, 1, 1/2: with c = cos(k D),
/// G = -(1 - c) / 2 + (2 - 2 c^2) + (1 - 4 c^3 + 3 c) / 2.
TEST(StressGrowth, is_the_largest_over_all_waves) {
  double largest = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double c = -1 + i / 50000.;
    largest = std::max(largest, -.5 * (1 - c) + 2 - 2 * c * c + .5 * (1 - 4 * c * c * c + 3 * c));
  }
  EXPECT_NEAR(stress_growth(function_of("cubic_spline"), 2).tension, largest, 1e-4); // a thousand waves
}

/// Under compression a kernel grows whose neighbours all lie where it is curved downwards.
TEST(StressGrowth, in_compression) {
  SmoothingFunction dome{.value = [](double s) { return .75 * (1 - s * s); },
                         .slope = [](double s) { return -1.5 * s; },
                         .curvature = [](double) { return -1.5; },
                         .support = 1};
  const auto growth = stress_growth(dome, 1.2); // one neighbour at S = 5/6
  EXPECT_EQ(growth.tension, 0);
  EXPECT_NEAR(growth.compression, 2 / 1.2 * 1.5 * 2, 1e-12);
}

/// A row of 40 particles moved by 1e-6 cos(k x): the SPH sum itself, for every wave that fits.
TEST(StressGrowth, is_what_the_sum_over_moved_particles_says) {
  for (const char *name : {"cubic_spline", "new_quartic", "quintic", "gauss"})
    for (const double h : {1.1, 1.2, 1.7}) { // none with a neighbour at the edge
      const auto kernel = function_of(name);
      constexpr int n = 40;
      constexpr double moved = 1e-6;
      double tension = 0;
      for (int wave = 1; wave <= n / 2; ++wave) {
        const auto position = [&](int i) { return i + moved * std::cos(2 * std::numbers::pi * wave * i / double(n)); };
        double acceleration = 0; // of particle 0, over 2 sigma / rho
        for (int j = -8; j <= 8; ++j) {
          const double distance = position(0) - position(j);
          if (const double s = std::abs(distance) / h; j != 0 && s < kernel.support)
            acceleration += kernel.slope(s) / (h * h) * (distance > 0 ? 1 : -1);
        }
        tension = std::max(tension, acceleration / moved * h * h);
      }
      // Twenty waves against a thousand.
      EXPECT_NEAR(stress_growth(kernel, h).tension, tension, .01 * tension) << name << ", h = " << h;
    }
}

TEST(StressGrowth, refuses_what_it_cannot_do) {
  SmoothingFunction without = function_of("gauss");
  without.curvature = {};
  EXPECT_THROW(stress_growth(without, 1), std::invalid_argument);
  EXPECT_THROW(stress_growth(function_of("gauss"), 0), std::invalid_argument);
}

} // namespace
