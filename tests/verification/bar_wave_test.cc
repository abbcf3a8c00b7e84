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

/// What central differences conserve without loads: v M v / 2 + u(n) K u(n - 1) / 2 with v = (u(n) - u(n - 1)) / dt; of
/// elements with unit length, density and modulus.
double modified_energy(fem_reference::rod::ExplicitBar &bar, double dt) {
  const auto state = bar.state();
  const auto &u = state.at(0).second;
  const auto &v = state.at(1).second;
  double sum = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    sum += (i == 0 || i + 1 == u.size() ? .25 : .5) * v[i] * v[i];
    if (i > 0) {
      const double strain = u[i] - u[i - 1];
      sum += .5 * strain * (strain - dt * (v[i] - v[i - 1]));
    }
  }
  return sum;
}

// The pulse leaves the bar with a velocity of .2, so that displacements reach 1.6e5 and a step rounds each of the 100
// by up to 1.5e-11, at random. Times nodal forces of .05 in the mean that is 2e-12 a step, 2e-9 in a million of random
// signs, a standard deviation of 1e-10 of the energy of 20.
TEST(BarWave, the_modified_energy_of_finite_elements_stays_for_a_million_steps) {
  fem_reference::rod::WaveBar bar;
  for (int i = 0; i <= 100; ++i)
    bar.vertices.push_back(i);
  bar.right_stress = mean_load;
  fem_reference::rod::ExplicitBar waves(bar);
  constexpr double dt = .8;
  for (int step = 0; step < 1000; ++step)
    waves.step(dt);
  const double before = modified_energy(waves, dt);
  for (int step = 0; step < 1000000; ++step)
    waves.step(dt);
  EXPECT_NEAR(modified_energy(waves, dt) / before, 1, 1e-9);
  EXPECT_NEAR(before, waves.work(), 1e-9 * before);       // the loads' work by the mean velocity is exact
  EXPECT_GT(std::abs(waves.energy() / before - 1), 1e-4); // the energy of one instant is not conserved
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
