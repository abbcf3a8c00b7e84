// What the general gas costs beside loops written by hand for just the effects of a scene: `ratio` - 1 is to be below 5
// %. The scene is a shock tube with the states of Liu, Liu & Lam 2003 from its start, anew in every turn, so that the
// gas without viscosity is stable as long as it is watched.

#include "performance/gas_by_hand.h"
#include "performance/turns.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace meshless::hydrodynamics;
using performance::median;

constexpr double eta = 1.5;
constexpr double gamma_of_air = 1.4;

GasParticles shock_tube(std::size_t n) {
  GasParticles particles;
  const auto fill = [&](std::size_t count, double from, double density, double pressure) {
    const double spacing = 0.6 / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
      particles.position.push_back(from + (static_cast<double>(i) + 0.5) * spacing);
      particles.mass.push_back(density * spacing);
      particles.velocity.push_back(0);
      particles.density.push_back(density);
      particles.energy.push_back(pressure / ((gamma_of_air - 1) * density));
    }
  };
  fill(n * 4 / 5, -0.6, 1, 1);
  fill(n / 5, 0, 0.25, 0.1795);
  return particles;
}

template <int further_effects>
void gas_over_by_hand(benchmark::State &state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  performance::Turns turns;
  const int batch = static_cast<int>(80000 / n);
  for (auto _ : state)
    for (int turn = 0; turn < 150; ++turn) {
      // Sizes beside n: how the arrays lie to each other moves either loop, which is no cost of the general one.
      const auto particles = shock_tube(n + 40 * static_cast<std::size_t>(turn % 8));
      GasOptions options{.kernel = meshless::kernels::make_kernel("cubic_spline", {}),
                         .equation_of_state = IdealGas{gamma_of_air}};
      options.smoothing = eta;
      if (further_effects >= 1)
        options.viscosity = meshless::effects::MonaghanViscosity{};
      if (further_effects >= 2)
        options.conduction = meshless::effects::HeatConduction{};
      GasFlow general(particles, options);
      performance::GasByHand<further_effects> by_hand(particles, general, eta, gamma_of_air);
      const double dt = 0.1 * general.stable_step();
      turns.take(
          batch, [&] { general.step(dt); }, [&] { by_hand.step(dt); });
      for (std::size_t i = 0; i < particles.mass.size(); ++i)
        turns.difference = std::max({turns.difference, std::abs(general.position()[i] - by_hand.position(i)),
                                     std::abs(general.energy()[i] - by_hand.energy(i))});
    }
  if (!(turns.difference <= 1e-9)) // of rounding; loops that compute something else prove nothing
    state.SkipWithError("the two do not compute the same");
  state.counters["general_ns_a_particle"] = 1e9 * median(turns.general) / static_cast<double>(n);
  state.counters["by_hand_ns_a_particle"] = 1e9 * median(turns.by_hand) / static_cast<double>(n);
  state.counters["ratio"] = median(turns.ratio);
  state.counters["difference"] = turns.difference;
}
BENCHMARK(gas_over_by_hand<0>)->ArgName("n")->Arg(400)->Arg(4000)->Iterations(1);
BENCHMARK(gas_over_by_hand<1>)->ArgName("n")->Arg(400)->Arg(4000)->Iterations(1);
BENCHMARK(gas_over_by_hand<2>)->ArgName("n")->Arg(400)->Arg(4000)->Iterations(1);

} // namespace
