// The cantilever plate of Batra & Zhang (2008), section 4.1, with Q2 elements and about 165 000
// unknowns: seconds by phase. Run with OPENBLAS_NUM_THREADS=1 for one core.

#include "fem_reference/elasticity/plane_elasticity.h"

#include <benchmark/benchmark.h>

namespace {
using namespace fem_reference;
using namespace fem_reference::elasticity;

constexpr double length = 1;
constexpr double width = .2;
constexpr double youngs_modulus = 226.9e9;
constexpr double poisson_ratio = .33;
constexpr double force = 1e6;

/// Equation (4.2) on the left edge.
void clamp(std::span<const Point> points, std::span<Vector> values) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double eta = points[k][1] / width;
    values[k] = {-2 * force / youngs_modulus * (eta - .5) * (2 + poisson_ratio) * eta * (eta - 1),
                 6 * force * poisson_ratio / youngs_modulus * (length / width) * (eta - .5) * (eta - .5)};
  }
}

/// Equation (4.3) on the right edge.
void pull(std::span<const Point> points, std::span<const Vector>, std::span<Vector> values) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double eta = points[k][1] / width;
    values[k] = {0, -6 * force / width * eta * (eta - 1)};
  }
}

void cantilever(benchmark::State &state, LinearSolver solver) {
  const auto cells_x = static_cast<unsigned>(state.range(1));
  const Options options{static_cast<int>(state.range(0)), solver};
  const PlaneProblem problem{mesh::rectangle({0, 0}, {length, width}, cells_x + 1, cells_x / 5 + 1),
                             Material(youngs_modulus, poisson_ratio, PlaneModel::plane_stress),
                             {{0, {{ConditionKind::displacement, ConditionKind::displacement}, clamp, {}}},
                              {1, {{ConditionKind::traction, ConditionKind::traction}, {}, pull}},
                              {2, {}},
                              {3, {}}}};
  Seconds sum;
  for ([[maybe_unused]] auto _ : state) {
    const auto solution = solve(problem, options);
    sum.mesh += solution.seconds().mesh;
    sum.degrees_of_freedom += solution.seconds().degrees_of_freedom;
    sum.assembly += solution.seconds().assembly;
    sum.solve += solution.seconds().solve;
    state.counters["unknowns"] = static_cast<double>(solution.n_dofs());
    state.counters["residual"] = solution.relative_residual();
  }
  using benchmark::Counter;
  state.counters["s_mesh"] = Counter(sum.mesh, Counter::kAvgIterations);
  state.counters["s_dofs"] = Counter(sum.degrees_of_freedom, Counter::kAvgIterations);
  state.counters["s_assembly"] = Counter(sum.assembly, Counter::kAvgIterations);
  state.counters["s_solve"] = Counter(sum.solve, Counter::kAvgIterations);
}

/// Evaluation of the stress at 500 000 points spread over the plate.
void evaluation(benchmark::State &state) {
  const PlaneProblem problem{mesh::rectangle({0, 0}, {length, width}, 321, 65),
                             Material(youngs_modulus, poisson_ratio, PlaneModel::plane_stress),
                             {{0, {{ConditionKind::displacement, ConditionKind::displacement}, clamp, {}}},
                              {1, {{ConditionKind::traction, ConditionKind::traction}, {}, pull}},
                              {2, {}},
                              {3, {}}}};
  const auto solution = solve(problem, {2, LinearSolver::cholesky});
  std::vector<Point> points;
  for (unsigned k = 0; k < 500000; ++k) // a rank-1 lattice: no order that a cache would like
    points.push_back(
        {(k + .5) / 500000 * length, width * (static_cast<double>((k * 189173ULL) % 500000) + .5) / 500000});
  std::vector<std::array<double, 3>> values(points.size());
  for ([[maybe_unused]] auto _ : state)
    solution.stress(points, values);
}
} // namespace

// Degree and cells along the plate (a fifth of it across): about 165 000 unknowns each.
BENCHMARK_CAPTURE(cantilever, cholesky, LinearSolver::cholesky)
    ->Args({2, 320})
    ->Args({1, 640})
    ->Args({3, 213})
    ->Args({4, 160})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cantilever, multigrid, LinearSolver::multigrid)
    ->Args({2, 320})
    ->Args({2, 640})
    ->Args({2, 1280})
    ->Args({1, 640})
    ->Args({3, 160})
    ->Args({4, 160})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cantilever, umfpack, LinearSolver::umfpack)->Args({2, 320})->Unit(benchmark::kMillisecond);
BENCHMARK(evaluation)->Unit(benchmark::kMillisecond);
