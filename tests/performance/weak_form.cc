// The cantilever of Batra & Zhang 2008 by the three meshless methods, nG = 10, rho = 4, m = 2: seconds
// of a whole solve and of its phases, with all rows computed and with those that a grid repeats copied. Run with
// OPENBLAS_NUM_THREADS=1 for one core.

#include "unit/elasticity/plane_samples.h"

#include <benchmark/benchmark.h>

namespace {

using namespace plane_samples;

using weak_form::IntegrationRule;
using weak_form::RepeatedRows;

void cantilever(benchmark::State &state, Method method, IntegrationRule integration, RepeatedRows repeated_rows) {
  const Cantilever plate;
  const auto particles = plate.particles(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const auto problem = plate.problem();
  SolveSeconds sum;
  for (auto _ : state) {
    const auto solution =
        solve(method, problem, particles, {.integration = integration, .repeated_rows = repeated_rows});
    sum.neighbours += solution.seconds.neighbours;
    sum.basis += solution.seconds.basis;
    sum.assembly += solution.seconds.assembly;
    sum.solve += solution.seconds.solve;
  }
  const auto mean = [](double seconds) { return benchmark::Counter(seconds, benchmark::Counter::kAvgIterations); };
  state.counters["neighbours"] = mean(sum.neighbours);
  state.counters["basis"] = mean(sum.basis);
  state.counters["assembly"] = mean(sum.assembly);
  state.counters["solve"] = mean(sum.solve);
}

void levels(benchmark::internal::Benchmark *b) {
  b->Args({31, 7})->Args({61, 13})->Args({91, 19})->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(cantilever, strong, Method::strong, IntegrationRule::paper, RepeatedRows::computed)->Apply(levels);
BENCHMARK_CAPTURE(cantilever, weak1, Method::weak1, IntegrationRule::paper, RepeatedRows::computed)->Apply(levels);
BENCHMARK_CAPTURE(cantilever, weak2, Method::weak2, IntegrationRule::paper, RepeatedRows::computed)->Apply(levels);
BENCHMARK_CAPTURE(cantilever, weak1_consistent, Method::weak1, IntegrationRule::consistent, RepeatedRows::computed)
    ->Apply(levels);
BENCHMARK_CAPTURE(cantilever, weak1_copied, Method::weak1, IntegrationRule::paper, RepeatedRows::copied)->Apply(levels);
BENCHMARK_CAPTURE(cantilever, weak1_consistent_copied, Method::weak1, IntegrationRule::consistent, RepeatedRows::copied)
    ->Apply(levels);

} // namespace
