// Neighbour search on jittered grids: cell lists, k-d tree, and the candidates of one local subdomain.

#include "meshless/cloud/candidate_search.h"
#include "meshless/cloud/cell_list.h"
#include "meshless/cloud/point_tree.h"
#include "unit/cloud/sample_clouds.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

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

/// A million random points, about 30 neighbours each in the plane and 60 in space: sorted by cells, then all lists.
/// Counters: seconds of the sorting, lists a second without and with it.
template <int dim>
void million_random(benchmark::State &state) {
  constexpr std::size_t n = 1'000'000;
  Point<dim> high;
  high.fill(1);
  const auto points = sample_clouds::random_points<dim>(n, Point<dim>{}, high, 5);
  const double ball = dim == 2 ? 30 : 60;
  const double radius =
      dim == 2 ? std::sqrt(ball / n / std::numbers::pi) : std::cbrt(ball / n * .75 / std::numbers::pi);
  std::vector<Point<dim>> sorted(n);
  double sorting = 0;
  double searching = 0;
  std::size_t entries = 0;
  using Clock = std::chrono::steady_clock;
  for (auto _ : state) {
    const auto begin = Clock::now();
    {
      const CellList<dim> cells(points, radius);
      for (std::size_t i = 0; i < n; ++i)
        sorted[i] = points[static_cast<std::size_t>(cells.order()[i])];
    }
    const auto middle = Clock::now();
    const CellList<dim> cells(sorted, radius);
    entries = cells.all_within(radius).n_entries();
    sorting += std::chrono::duration<double>(middle - begin).count();
    searching += std::chrono::duration<double>(Clock::now() - middle).count();
  }
  const auto k = static_cast<double>(state.iterations());
  state.counters["neighbours"] = static_cast<double>(entries) / n;
  state.counters["sorting_seconds"] = sorting / k;
  state.counters["lists_per_second"] = k * n / searching;
  state.counters["with_sorting"] = k * n / (searching + sorting);
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

/// Particles around a point, graded over a factor of a thousand: n rings of n.
Particles<2> rings(std::int64_t n) {
  std::vector<Point<2>> points;
  std::vector<double> h;
  const double angle = 2 * std::numbers::pi / static_cast<double>(n);
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = 0; j < n; ++j) {
      const double r = std::pow(1e3, static_cast<double>(i) / static_cast<double>(n - 1));
      points.push_back({r * std::cos(angle * static_cast<double>(j)), r * std::sin(angle * static_cast<double>(j))});
      h.push_back(angle * r);
    }
  return {std::move(points), std::move(h)};
}

void graded_candidates(benchmark::State &state) {
  const auto particles = rings(state.range(0));
  const CandidateSearch<2> search(particles, support);
  std::vector<Index> found;
  for (auto _ : state)
    for (std::size_t i = 0; i < particles.size(); ++i) {
      search.collect(particles.position(i), particles.smoothing_length(i), found);
      benchmark::DoNotOptimize(found.data());
    }
  count(state, particles.size());
}

/// What one search for all sizes costs: it has to look as far as the largest support reaches.
void graded_candidates_by_tree(benchmark::State &state) {
  const auto particles = rings(state.range(0));
  const PointTree<2> tree(particles.positions());
  std::vector<Index> found;
  for (auto _ : state)
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Point<2> x = particles.position(i);
      const double h = particles.smoothing_length(i);
      found.clear();
      tree.append_within(x, support * particles.largest_smoothing_length() + h, found);
      std::erase_if(found, [&](Index j) {
        const double own = support * particles.smoothing_length(static_cast<std::size_t>(j)) + h;
        return distance_squared<2>(particles.position(static_cast<std::size_t>(j)), x) >= own * own;
      });
      std::sort(found.begin(), found.end());
      benchmark::DoNotOptimize(found.data());
    }
  count(state, particles.size());
}

BENCHMARK(million_random<2>)->Unit(benchmark::kMillisecond);
BENCHMARK(million_random<3>)->Unit(benchmark::kMillisecond);
BENCHMARK(build_cell_list<2>)->Arg(100)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(build_cell_list<3>)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours<2>)->Arg(100)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours<3>)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours_by_tree<2>)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(all_neighbours_by_tree<3>)->Arg(30)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(candidates, equal_lengths, false)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(candidates, varying_lengths, true)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(graded_candidates)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(graded_candidates_by_tree)->Arg(100)->Unit(benchmark::kMillisecond);

} // namespace
