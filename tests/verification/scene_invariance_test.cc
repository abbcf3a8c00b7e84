// What must not change a result: units, the place of the plate, a second run.

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

namespace {

using namespace scene_runs;

const std::string methods_and_study = R"(
[[method]]
name = "strong"
[[method]]
name = "weak1"
[[method]]
name = "weak2"
[[method]]
name = "fem"
element = ["Q1", "Q2"]
[study]
levels = ["16x4"]
)";

std::string scene(const std::string &problem, const std::string &material) {
  return "schema = 1\nbenchmark = \"cantilever\"\n[problem]\njitter = 0.2\n" + problem + "[material]\nnu = 0.33\n" +
         material + methods_and_study;
}

/// Stress divides by a spacing, about a thirtieth of the plate's length.
double amplification(const std::string &error) {
  return error.starts_with("stress") || error.starts_with("energy") ? 30 : 1;
}

/// Errors of the same cells in two runs: `tolerance` relative to their size, or `rounding` of the solution's.
void expect_same_errors(const std::vector<reports::Cell> &a, const std::vector<reports::Cell> &b, double tolerance,
                        double rounding = 0) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].status, reports::Status::ok) << name_of(a[i]);
    ASSERT_EQ(b[i].status, reports::Status::ok) << name_of(b[i]);
    for (const auto &[name, value] : a[i].errors) {
      // log10 E is a difference of two norms: its relative error is larger by the inverse of E.
      const bool logarithm = name.find("log10") != std::string::npos;
      const double allowed =
          logarithm ? (tolerance + rounding) / std::pow(10, value) : tolerance * value + rounding * amplification(name);
      EXPECT_NEAR(value, error_of(b[i], name), allowed) << name_of(a[i]) << ", " << name;
    }
  }
}

TEST(SceneInvariance, units) {
  const auto with_units =
      run(read(scene("length = \"1 m\"\nwidth = \"20 cm\"\nforce = \"1 kN/mm\"\n", "E = \"226.9 GPa\"\n")));
  const auto si = run(read(scene("length = 1\nwidth = 0.2\nforce = 1e6\n", "E = 226.9e9\n")));
  const auto millimetres = run(read(scene("length = 1000\nwidth = 200\nforce = 1000\n", "E = 226900\n")));
  expect_same_errors(with_units, si, 1e-9);
  expect_same_errors(with_units, millimetres, 1e-9);
}

TEST(SceneInvariance, units_with_body_force) {
  const std::string effects = "solution = \"trigonometric\"\n[effects]\nelasticity = true\nbody_force = true\n";
  const auto si = run(read(scene("length = 1\nwidth = 0.2\nforce = 1e6\n" + effects, "E = 226.9e9\n")));
  const auto millimetres = run(read(scene("length = 1000\nwidth = 200\nforce = 1000\n" + effects, "E = 226900\n")));
  expect_same_errors(si, millimetres, 1e-9);
}

// At 1e6 m a coordinate is known to 1.2e-10 m, 2e-9 of a spacing: that much of the solution may change, and some times
// more where shape functions divide it by short distances. The errors of the coarse methods keep six digits.
TEST(SceneInvariance, place_of_the_plate) {
  const auto here = run(read(scene("", "")));
  for (const auto *origin : {"[1e6, 1e6]", "[-1e6, 1e6]", "[\"1000 km\", 0]"})
    expect_same_errors(here, run(read(scene("origin = " + std::string(origin) + "\n", ""))), 1e-6, 1e-8);
}

TEST(SceneInvariance, an_exact_order_is_exact_to_1e_6_far_away) {
  const std::string text = R"(
schema = 1
benchmark = "cantilever"
[problem]
origin = [1e6, -1e6]
jitter = [0, 0.2]
[[method]]
name = "strong"
order = 3
[[method]]
name = "weak1"
order = 3
[[method]]
name = "weak2"
order = 3
[[method]]
name = "fem"
element = "Q3"
[study]
levels = ["16x4", "31x7"]
)";
  for (const auto &cell : run(read(text)))
    EXPECT_LE(l2(cell), 1e-6) << name_of(cell);
}

TEST(SceneInvariance, a_second_run_gives_the_same_bits) {
  const auto scene_read = read(scene("", ""));
  study::RunOptions options;
  options.write_series = false;
  const auto first = study::run_scene(scene_read, study::shipped_catalogue(), options);
  options.isolate = true;
  const auto second = study::run_scene(scene_read, study::shipped_catalogue(), options);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].errors, second[i].errors) << name_of(first[i]);
    EXPECT_EQ(first[i].quantities, second[i].quantities) << name_of(first[i]);
    EXPECT_FALSE(first[i].errors.empty());
  }
}

TEST(SceneInvariance, the_seed_decides_the_particles) {
  const auto text = scene("", "");
  const auto first = run(read(text, {"study.seed=1"}));
  const auto again = run(read(text, {"study.seed=1"}));
  const auto other = run(read(text, {"study.seed=2"}));
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].errors, again[i].errors);
    EXPECT_NE(first[i].errors, other[i].errors);
  }
}

} // namespace
