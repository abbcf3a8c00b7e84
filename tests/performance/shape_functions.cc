// SSPH shape functions per point: batches of 64 points in one local subdomain, as the weak form asks
// for them, and arbitrary points through GroupedEvaluation.

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/ssph.h"
#include "unit/cloud/sample_clouds.h"

#include <benchmark/benchmark.h>

namespace {

using namespace meshless;

template <int dim>
cloud::Particles<dim> unit_spacing() {
  std::array<int, dim> n;
  n.fill(dim == 3 ? 15 : 31);
  cloud::Point<dim> high;
  high.fill(n[0] - 1);
  auto points = sample_clouds::jittered_grid<dim>(n, cloud::Point<dim>{}, high, .25, 1);
  std::vector<double> h(points.size(), 1);
  return {std::move(points), std::move(h)};
}

/// 64 points within one spacing of the middle of the cloud.
template <int dim>
void batch(benchmark::State &state, basis::Wanted wanted) {
  const int order = static_cast<int>(state.range(0));
  const auto particles = unit_spacing<dim>();
  const auto basis = basis::make_ssph<dim>(order, kernels::Gauss(order + 2));
  const cloud::CandidateSearch<dim> search(particles, basis->support());
  cloud::Point<dim> low;
  cloud::Point<dim> high;
  cloud::Point<dim> centre;
  centre.fill(dim == 3 ? 7 : 15);
  for (int k = 0; k < dim; ++k) {
    low[k] = centre[k] - .7;
    high[k] = centre[k] + .7;
  }
  const auto points = sample_clouds::random_points<dim>(64, low, high, 2);
  std::vector<cloud::Index> candidates;
  search.collect(centre, std::sqrt(dim) * .7, candidates);
  basis::PointBatch<dim> point_batch;
  point_batch.assign(std::span<const cloud::Point<dim>>(points));
  basis::CandidateBatch<dim> candidate_batch;
  candidate_batch.assign(particles, candidates, centre);
  basis::ShapeFunctionValues<dim> values;
  typename basis::ShapeFunctions<dim>::Workspace workspace;
  for (auto _ : state)
    benchmark::DoNotOptimize(basis->evaluate(point_batch, candidate_batch, wanted, values, workspace));
  state.SetItemsProcessed(state.iterations() * 64);
  state.counters["candidates"] = static_cast<double>(candidates.size());
  state.counters["seconds_per_point"] =
      benchmark::Counter(64, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void grouped(benchmark::State &state) {
  const auto particles = unit_spacing<2>();
  const auto basis = basis::make_ssph<2>(2, kernels::Gauss(4));
  const cloud::CandidateSearch<2> search(particles, basis->support());
  const basis::GroupedEvaluation<2> evaluation(*basis, search);
  const auto points = sample_clouds::random_points<2>(static_cast<std::size_t>(state.range(0)), {0, 0}, {30, 30}, 3);
  for (auto _ : state)
    evaluation.visit(points, {.value = true},
                     [](const auto &group) { benchmark::DoNotOptimize(group.values.value(0)); });
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

constexpr basis::Wanted value{.value = true};
constexpr basis::Wanted weak1{.gradient = true};
constexpr basis::Wanted weak2{.differentiated_gradient = true};
constexpr basis::Wanted strong{.value = true, .gradient = true, .hessian = true};

constexpr auto *batch_1d = &batch<1>;
constexpr auto *batch_2d = &batch<2>;
constexpr auto *batch_3d = &batch<3>;

BENCHMARK_CAPTURE(batch_2d, value, value)->DenseRange(1, 4)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(batch_2d, weak1, weak1)->DenseRange(1, 4)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(batch_2d, weak2, weak2)->DenseRange(1, 4)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(batch_2d, strong, strong)->DenseRange(2, 4)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(batch_1d, weak1, weak1)->Arg(2)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(batch_3d, weak1, weak1)->DenseRange(1, 3)->Unit(benchmark::kMicrosecond);
BENCHMARK(grouped)->Arg(1000)->Arg(20000)->Unit(benchmark::kMillisecond);

} // namespace
