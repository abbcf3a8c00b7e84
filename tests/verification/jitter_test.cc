// Irregular particles: the default weak1 on twenty clouds moved by up to 30 % of the spacing, against the uniform one.

#include "sanitized.h"
#include "verification/scene_runs.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace {

using namespace scene_runs;
using namespace comparisons;

/// weak1 with orders 2 and 3 as it is by default, on 31 x 7 and 61 x 13 particles.
std::vector<reports::Cell> cells_of(const std::string &problem, double jitter, int seed) {
  return run(read(fmt::format("schema = 1\nbenchmark = \"cantilever\"\n[problem]\njitter = {}\n{}"
                              "[[method]]\nname = \"weak1\"\norder = [2, 3]\n[study]\nlevels = [\"31x7\", \"61x13\"]\n"
                              "seed = {}\n",
                              jitter, problem, seed)));
}

// The worst of the twenty plates with a hole, with less than 30 % too, is in `petrov verify`.
TEST(Jitter, worst_of_twenty_cantilevers_is_within_ten_times_the_uniform_one) {
  struct {
    const char *problem;
    double rounding; // errors of this size are the solver's: the bending solution is in the space of order 3
  } const problems[] = {{"solution = \"bending\"\n", 1e-9},
                        {"solution = \"trigonometric\"\n[effects]\nelasticity = true\nbody_force = true\n", 0}};
  for (const auto &[problem, rounding] : problems) {
    const auto uniform = cells_of(problem, 0, 1);
    for (int seed = 1; seed <= sanitized::repetitions(20); ++seed) {
      const auto moved = cells_of(problem, .3, seed);
      ASSERT_EQ(moved.size(), 4u);
      for (std::size_t i = 0; i < moved.size(); ++i)
        EXPECT_LT(l2(moved[i]), 10 * l2(uniform[i]) + rounding) << problem << name_of(moved[i]) << ", seed " << seed;
    }
  }
}

} // namespace
