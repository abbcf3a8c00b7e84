// Neighbour search on jittered grids: cell list, k-d tree, and the candidates of one local subdomain.

#include "meshless/cloud/candidate_search.h"
#include "meshless/cloud/cell_list.h"
#include "meshless/cloud/point_tree.h"
#include "unit/cloud/sample_clouds.h"

#include <benchmark/benchmark.h>

namespace {

using namespace meshless::cloud;

constexpr double support = 4; // in units of the spacing

template <int dim>
std::vector<Point<dim>> cloud_of(std::int64_t n) {
  std::array<int, dim> sides;
  sides.fill(static_cast<int>(n));
  Point<dim> high;
  high.fill(static_cast<double>(n - 1)); // spacing 1
  return sample_clouds::jittered_grid<dim>(sides, Point<dim>{}, high, .25, 1);
}

void count(benchmark::State &state, std::size_t n_particles) {
  state.counters["particles"] = static_cast<double>(n_particles);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n_particles));
}

template <int dim>
void build_cell_list(benchmark::State &state) {
  const auto points = cloud_of<dim>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(CellList<dim>(points, support / 2));
  count(state, points.size());
}

template <int dim>
void all_neighbours(benchmark::State &state) {
  const auto points = cloud_of<dim>(state.range(0));
  const CellList<dim> cells(points, support / 2);
  for (auto _ : state)
    benchmark::DoNotOptimize(cells.all_within(support));
  count(state, points.size());
}

template <int dim>
void all_neighbours_by_tree(benchmark::State &state) {
  const auto points = cloud_of<dim>(state.range(0));
  const PointTree<dim> tree(points);
  std::vector<Index> found;
  for (auto _ : state)
    for (const auto &x : points) {
      found.clear();
      tree.append_within(x, support, found);
      benchmark::DoNotOptimize(found.data());
    }
  count(state, points.size());
}

void candidates(benchmark::State &state, bool varying) {
  const auto points = cloud_of<2>(state.range(0));
  sample_clouds::Uniform random(2);
  std::vector<double> h(points.size(), 1);
  if (varying)
    for (double &length : h)
      length = random.between(.8, 1.2);
  const Particles<2> particles(points, h);
  const CandidateSearch<2> search(particles, support);
  std::vector<Index> found;
  for (auto _ : state)
    for (const auto &x : points) {
      search.collect(x, 1, found);
      benchmark::DoNotOptimize(found.data());
    }
  count(state, points.size());
}

BENCHMARK(build_cell_list<2>)->Arg(100)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(build_cell_list<3>)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours<2>)->Arg(100)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours<3>)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours_by_tree<2>)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours_by_tree<3>)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(candidates, equal_lengths, false)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(candidates, varying_lengths, true)->Arg(100)->Unit(benchmark::kMillisecond);

} // namespace
