// The bar wave at c dt = D, where linear elements with lumped mass solve the wave equation exactly at their vertices.

#include "fem_reference/rod/explicit_bar.h"

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace {

using namespace scene_runs;

/// Stress of the pulse -1 on 0 < t < duration at x = length, wave speed 1, both ends free, by images: the wave from the
/// right end comes back with the other sign from the left one, and with its own after both.
double pulse(double x, double t, double length, double duration) {
  const auto load = [=](double s) { return s > 0 && s < duration ? -1.0 : 0.0; };
  double sum = 0;
  for (int passes = 0; passes <= t / (2 * length); ++passes)
    sum += load(t - 2 * passes * length - (length - x)) - load(t - 2 * passes * length - (length + x));
  return sum;
}

/// Largest error of the stress over all elements and steps.
double largest_error(double cfl, int n_steps, const std::function<double(double, double)> &load) {
  constexpr int cells = 100;
  constexpr double duration = 20;
  fem_reference::rod::WaveBar bar;
  for (int i = 0; i <= cells; ++i)
    bar.vertices.push_back(i);
  bar.right_stress = load;
  fem_reference::rod::ExplicitBar waves(bar);
  double largest = 0;
  for (int step = 1; step <= n_steps; ++step) {
    waves.step(cfl);
    const auto stress = waves.stress();
    const auto middles = waves.middles();
    for (std::size_t e = 0; e < stress.size(); ++e)
      largest = std::max(largest, std::abs(stress[e] - pulse(middles[e], step * cfl, cells, duration)));
  }
  return largest;
}

double mean_load(double from, double to) {
  return -std::max(0.0, std::min(to, 20.0) - std::max(from, 0.0)) / (to - from);
}

// Three and a half passes with five reflections: all values are sums of a few numbers of the size of one.
TEST(BarWave, finite_elements_at_a_courant_number_of_one_are_exact) {
  EXPECT_LE(largest_error(1, 350, mean_load), 1e-10);
}

TEST(BarWave, finite_elements_are_not_exact_with_another_step_or_without_half_loads) {
  EXPECT_GT(largest_error(0.8, 350, mean_load), 0.1);
  EXPECT_GT(largest_error(1, 350, [](double from, double to) { return to > 0 && from + to < 40 ? -1.0 : 0.0; }), 0.1);
}

TEST(BarWave, the_shipped_scene_with_a_courant_number_of_one_has_exact_elements) {
  const auto file = std::filesystem::path(PETROV_SOURCE_DIR) / "comparisons/benchmarks/bar_wave/cfl_one.toml";
  const auto read = [&](const Overrides &overrides) {
    auto result = scene::read_scene(file, overrides, study::vocabulary_of(study::shipped_catalogue()));
    if (!result.scene)
      throw std::runtime_error(scene::to_text(result.diagnostics));
    return std::move(*result.scene);
  };
  for (const auto &cell : run(read({}))) {
    ASSERT_EQ(cell.status, reports::Status::ok) << name_of(cell);
    if (cell.method != "fem") {
      EXPECT_GT(cell.errors.at("stress_l1"), 1e-3) << name_of(cell);
      continue;
    }
    EXPECT_LE(cell.errors.at("stress_l1"), 1e-10) << name_of(cell);
    for (const int snapshot : {1, 2, 3, 4})
      EXPECT_LE(cell.quantities.at("stress_l1_snapshot_" + std::to_string(snapshot)), 1e-10) << name_of(cell);
  }
  for (const auto &cell : run(read({"time.cfl=0.9", "study.levels=[201]"})))
    EXPECT_GT(cell.errors.at("stress_l1"), 1e-3) << name_of(cell);
}

} // namespace
