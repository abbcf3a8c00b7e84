// The detonation of TNT with 4000 particles against the exact wave of Taylor behind the front.

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

namespace {

using namespace scene_runs;

TEST(Detonation, the_recommended_kernel_follows_the_taylor_wave) {
  const auto cells = run(read("schema = 1\nbenchmark = \"detonation\"\n[[method]]\nname = \"sph\"\n"
                              "[study]\nlevels = [4000]\n"));
  ASSERT_EQ(cells.size(), 1U);
  const auto &cell = cells.front();
  ASSERT_EQ(cell.status, reports::Status::ok) << cell.reason;
  EXPECT_NEAR(cell.quantities.at("time"), 14e-6, 1e-15);
  // Chapman-Jouguet, 21.0 GPa in the three digits of Liu, Liu & Lam 2003. The front is some spacings of 25 um wide.
  EXPECT_NEAR(cell.quantities.at("peak_pressure"), 21.0e9, 0.015 * 21.0e9);
  EXPECT_NEAR(cell.quantities.at("front_behind"), 0, 1e-4);
  EXPECT_LE(cell.errors.at("pressure_l1"), 0.09e9);
  EXPECT_LE(cell.quantities.at("energy_error"), 1e-12);
}

// Behind the front the error falls with the number of particles, as it does not for the paper's kernel.
TEST(Detonation, the_recommended_kernel_converges_and_the_papers_does_not) {
  const auto cells =
      run(read("schema = 1\nbenchmark = \"detonation\"\n[[method]]\nname = \"sph\"\nlabel = \"recommended\"\n"
               "[[method]]\nname = \"sph\"\nlabel = \"paper\"\nkernel = \"new_quartic\"\n"
               "smoothing_length = 1.5\n[time]\nsnapshots = 1\n[study]\nlevels = [250, 1000]\n"));
  const auto ratio = [&](const char *label) {
    return find(cells, label, "250").errors.at("pressure_l1") / find(cells, label, "1000").errors.at("pressure_l1");
  };
  EXPECT_GT(ratio("recommended"), 2); // a factor of four in the spacing, order one but for the front
  EXPECT_LT(ratio("paper"), 1.5);
}

} // namespace
