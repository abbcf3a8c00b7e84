// Particle-steps a second of the transient methods, and the bar beside loops written by hand for the same effects.

#include "meshless/basis/derivative_operators.h"
#include "meshless/basis/ssph.h"
#include "meshless/dynamics/elastic_bar.h"
#include "meshless/hydrodynamics/gas_flow.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <optional>
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

dynamics::BarOptions bar_options(int n) {
  dynamics::BarOptions options;
  for (int i = 0; i < n; ++i)
    options.positions.push_back(i);
  options.operators = [](std::span<const double> places) {
    std::vector<cloud::Point<1>> points;
    for (const double x : places)
      points.push_back({x});
    const cloud::Particles<1> particles(points, std::vector<double>(points.size(), 1.2));
    const auto basis = basis::make_ssph<1>(2, kernels::make_kernel("revised_super_gauss", {}, 1.6));
    auto rows = basis::make_derivative_operators<1>(*basis, particles, {.gradient = true, .hessian = true});
    return dynamics::LineOperators{std::move(rows.gradient.front()), std::move(rows.hessian.front())};
  };
  options.right_stress = [](double t) { return t < 50 ? -1.0 : 0.0; };
  return options;
}

void rate(benchmark::State &state, int n) {
  state.counters["particle_steps"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * n, benchmark::Counter::kIsRate);
}

/// Elasticity and inertia, and with the argument viscosity and damping.
void bar(benchmark::State &state) {
  const auto n = static_cast<int>(state.range(1));
  auto options = bar_options(n);
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

/// The same work by hand: five diagonals, nothing else known of.
template <int further_effects>
void bar_by_hand(benchmark::State &state) {
  const auto n = static_cast<int>(state.range(0));
  const auto size = static_cast<std::size_t>(n);
  constexpr int w = 2;
  const auto options = bar_options(n);
  const auto rows = options.operators(options.positions);
  std::vector<double> diagonals(5 * size, 0.0);
  for (std::size_t i = 0; i < size; ++i)
    for (auto e = rows.second.offsets()[i]; e < rows.second.offsets()[i + 1]; ++e) {
      const auto j = rows.second.columns()[static_cast<std::size_t>(e)];
      diagonals[static_cast<std::size_t>(j - static_cast<std::int64_t>(i) + w) * size + i] =
          rows.second.values()[static_cast<std::size_t>(e)];
    }
  std::vector<double> u_all(size + 2 * w, 0.0);
  std::vector<double> q_all = u_all;
  std::vector<double> v_all(size, 0.0);
  double *u = u_all.data() + w;
  double *q = q_all.data() + w;
  double *v = v_all.data();
  const double *d = diagonals.data();
  double time = 0;
  const double dt = 0.8;
  for (auto _ : state) {
    const double *x = u;
    if constexpr (further_effects >= 1) {
      for (int i = 0; i < n; ++i)
        q[i] = u[i] + 0.05 * v[i];
      x = q;
    }
    for (int i = 0; i < n; ++i) {
      const double a = d[i] * x[i - 2] + d[n + i] * x[i - 1] + d[2 * n + i] * x[i] + d[3 * n + i] * x[i + 1] +
                       d[4 * n + i] * x[i + 2];
      v[i] = (further_effects >= 2 ? (1 - dt * 1e-6) * v[i] : v[i]) + dt * a;
    }
    for (int i = 0; i < n; ++i)
      u[i] += dt * v[i];
    time += dt;
    u[n - 1] = (time < 50 ? -1.0 : 0.0) + u[n - 2];
    u[0] = u[1];
    benchmark::DoNotOptimize(u_all.data());
    benchmark::ClobberMemory();
  }
  rate(state, n);
}
BENCHMARK(bar_by_hand<0>)->ArgName("n")->Arg(800)->Arg(8000);
BENCHMARK(bar_by_hand<1>)->ArgName("n")->Arg(800)->Arg(8000);
BENCHMARK(bar_by_hand<2>)->ArgName("n")->Arg(800)->Arg(8000);

} // namespace
