// Particle-steps a second of the transient methods.

#include "performance/unit_bar.h"

#include "meshless/hydrodynamics/gas_flow.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace {

using namespace meshless;

/// A sound wave over 4000 particles, weak enough to run for ever; the work of a step is that of a shock tube.
void gas(benchmark::State &state) {
  using namespace hydrodynamics;
  constexpr std::size_t n = 4000;
  GasParticles particles;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / n;
    particles.position.push_back(x);
    particles.mass.push_back(1.0 / n);
    particles.velocity.push_back(1e-6 * std::sin(6.283185307179586 * x));
    particles.density.push_back(1);
    particles.energy.push_back(2.5);
  }
  GasOptions options{.kernel = kernels::make_kernel("cubic_spline", {}), .equation_of_state = IdealGas{1.4}};
  options.adaptive = state.range(0) == 1;
  options.fixed_length = 1.5 / n;
  if (state.range(1) == 1)
    options.viscosity = effects::MonaghanViscosity{};
  options.ends = {End::mirror, End::mirror};
  options.walls = {0, 1};
  GasFlow flow(particles, options);
  const double dt = 0.1 * flow.stable_step();
  for (auto _ : state)
    flow.step(dt);
  state.counters["particle_steps"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * n, benchmark::Counter::kIsRate);
}
// Adaptive h without viscosity is not stable: its terms of grad h are left out.
BENCHMARK(gas)->ArgNames({"adaptive", "viscosity"})->Args({0, 0})->Args({0, 1})->Args({1, 1});

void rate(benchmark::State &state, int n) {
  state.counters["particle_steps"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * n, benchmark::Counter::kIsRate);
}

/// Elasticity and inertia, and with the argument viscosity and damping.
void bar(benchmark::State &state) {
  const auto n = static_cast<int>(state.range(1));
  auto options = performance::bar_options(n);
  if (state.range(0) >= 1)
    options.viscosity = effects::LinearViscosity{0.05};
  if (state.range(0) >= 2)
    options.damping = effects::Damping{1e-6};
  dynamics::ElasticBar waves(options);
  for (auto _ : state)
    waves.step(0.8);
  rate(state, n);
}
BENCHMARK(bar)->ArgNames({"further_effects", "n"})->ArgsProduct({{0, 1, 2}, {800, 8000}});

} // namespace
