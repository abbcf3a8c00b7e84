// Shock tubes through scenes: errors beside those of other programs for the same schemes.

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

namespace {

using namespace scene_runs;

std::string tube(const std::string &methods, const std::string &time) {
  return "schema = 1\nbenchmark = \"shock_tube\"\n" + methods + "[time]\n" + time +
         "\n[study]\nlevels = [400]\nrepeats = 1\n";
}

void expect_errors(const reports::Cell &cell, const std::array<double, 4> &expected, double tolerance) {
  ASSERT_EQ(cell.status, reports::Status::ok) << name_of(cell);
  constexpr std::array names{"density_l1", "pressure_l1", "velocity_l1", "energy_l1"};
  for (std::size_t k = 0; k < names.size(); ++k)
    EXPECT_NEAR(error_of(cell, names[k]) / expected[k], 1, tolerance) << name_of(cell) << " " << names[k];
}

// Independent prototypes of the same schemes on 400 cells or particles, to two digits; they differ in what their
// authors left open (limits of the step, norm by centres or means), which moves errors by some per cent.

TEST(ShockTube, FirstOrderElementsErrAsAnotherProgramsDo) {
  const auto cells = run(read(tube("[[method]]\nname = \"fem\"\nelement = \"P0\"\n", "cfl = 0.4")));
  expect_errors(cells.front(), {.0077, .0074, .0116, .0169}, 0.1);
}

TEST(ShockTube, LimitedElementsErrByAThirdOfParticles) {
  const auto cells = run(read(tube("[[method]]\nname = \"fem\"\n[[method]]\nname = \"sph\"\n", "cfl = 0.9")));
  EXPECT_LE(error_of(cells.front(), "density_l1"), .0025);
  EXPECT_LT(3 * error_of(cells.front(), "density_l1"), error_of(cells.back(), "density_l1"));
}

TEST(ShockTube, ParticlesErrAsAnotherProgramsDo) {
  const auto cells = run(read(tube("[[method]]\nname = \"sph\"\n", "cfl = 0.3")));
  expect_errors(cells.front(), {.0059, .0066, .0108, .0132}, 0.1);
  EXPECT_EQ(cells.front().quantities.at("mass_error"), 0);
  EXPECT_LE(cells.front().quantities.at("momentum_error"), 1e-14);
  EXPECT_LE(cells.front().quantities.at("energy_error"), 1e-13);
}

} // namespace
