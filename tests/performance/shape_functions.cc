// SSPH shape functions per point: batches of 64 points in one local subdomain, as the weak form asks
// for them, arbitrary points through GroupedEvaluation, and a plain program to compare with.

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/ssph.h"
#include "unit/cloud/sample_clouds.h"

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace {

using namespace meshless;

template <int dim>
cloud::Particles<dim> unit_spacing(double h = 1, int side = dim == 3 ? 15 : 31) {
  std::array<int, dim> n;
  n.fill(side);
  cloud::Point<dim> high;
  high.fill(n[0] - 1);
  auto points = sample_clouds::jittered_grid<dim>(n, cloud::Point<dim>{}, high, .25, 1);
  std::vector<double> lengths(points.size(), h);
  return {std::move(points), std::move(lengths)};
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

constexpr basis::Wanted everything{.value = true, .gradient = true, .hessian = true};

/// A support that holds about 30 particles in the plane, 60 in space.
template <int dim>
double smoothing_length(const kernels::Kernel &kernel) {
  const double radius = dim == 2 ? std::sqrt(30 / std::numbers::pi) : std::cbrt(45 / std::numbers::pi);
  return radius / kernels::support_of(kernel);
}

/// As many random points as there are particles in a box 3 spacings inside of the cloud.
template <int dim>
std::vector<cloud::Point<dim>> points_inside(int side) {
  cloud::Point<dim> low;
  cloud::Point<dim> high;
  low.fill(3);
  high.fill(side - 4);
  return sample_clouds::random_points<dim>(static_cast<std::size_t>(std::pow(side - 7, dim)), low, high, 3);
}

/// Value, first and second derivatives at points as sparse as the particles, search included. They are stored in the
/// arrays of the group.
template <int dim>
void all_derivatives(benchmark::State &state, const kernels::Kernel &kernel) {
  const int side = dim == 2 ? 200 : 40;
  const auto particles = unit_spacing<dim>(smoothing_length<dim>(kernel), side);
  const auto basis = basis::make_ssph<dim>(2, kernel);
  const auto points = points_inside<dim>(side);
  const cloud::CandidateSearch<dim> search(particles, basis->support());
  const basis::GroupedEvaluation<dim> evaluation(*basis, search);
  double n_neighbours = 0;
  evaluation.visit(points, {}, [&](const auto &group) {
    for (std::size_t p = 0; p < group.points.size(); ++p)
      n_neighbours += static_cast<double>(group.n_neighbours(p));
  });
  for (auto _ : state)
    evaluation.visit(points, everything,
                     [](const auto &group) { benchmark::DoNotOptimize(group.values.hessian(0, 0)); });
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
  state.counters["neighbours"] = n_neighbours / static_cast<double>(points.size());
}

/// The same without search: the neighbours of every point are known, points follow each other along the curve of
/// GroupedEvaluation, a pack at a time.
template <int dim>
void all_derivatives_at(benchmark::State &state, const kernels::Kernel &kernel) {
  const int side = dim == 2 ? 31 : 15;
  const auto particles = unit_spacing<dim>(smoothing_length<dim>(kernel), side);
  const auto basis = basis::make_ssph<dim>(2, kernel);
  const cloud::CandidateSearch<dim> search(particles, basis->support());
  const auto points = points_inside<dim>(side);
  std::vector<cloud::Point<dim>> sorted;
  std::vector<std::vector<cloud::Index>> lists;
  basis::GroupedEvaluation<dim>(*basis, search).visit(points, {}, [&](const auto &group) {
    for (const std::size_t i : group.points) {
      sorted.push_back(points[i]);
      search.collect(points[i], 0, lists.emplace_back());
    }
  });
  const std::vector<std::span<const cloud::Index>> rows(lists.begin(), lists.end());
  constexpr std::size_t n_lanes = linear_algebra::n_lanes;
  basis::NeighbourPack<dim> pack;
  basis::ShapeFunctionValues<dim> values;
  typename basis::ShapeFunctions<dim>::Workspace workspace;
  double n_neighbours = 0;
  double n_slots = 0;
  for (auto _ : state)
    for (std::size_t begin = 0; begin < sorted.size(); begin += n_lanes) {
      const std::size_t n = std::min(n_lanes, sorted.size() - begin);
      pack.assign(particles, std::span(sorted).subspan(begin, n), std::span(rows).subspan(begin, n));
      benchmark::DoNotOptimize(basis->evaluate_own(pack, everything, values, workspace));
      n_slots += static_cast<double>(n * pack.n_slots());
    }
  for (const auto &list : lists)
    n_neighbours += static_cast<double>(list.size());
  const auto n = static_cast<double>(sorted.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sorted.size()));
  state.counters["neighbours"] = n_neighbours / n;
  state.counters["slots"] = n_slots / n / static_cast<double>(state.iterations());
}

/// Again without search: 16 points at a time around one place that share their candidates.
template <int dim>
void all_derivatives_shared(benchmark::State &state, const kernels::Kernel &kernel) {
  const auto particles = unit_spacing<dim>(smoothing_length<dim>(kernel));
  const auto basis = basis::make_ssph<dim>(2, kernel);
  const cloud::CandidateSearch<dim> search(particles, basis->support());
  cloud::Point<dim> centre;
  centre.fill(dim == 3 ? 7 : 15);
  cloud::Point<dim> low = centre;
  cloud::Point<dim> high = centre;
  for (int k = 0; k < dim; ++k) {
    low[k] -= .5;
    high[k] += .5;
  }
  const auto points = sample_clouds::random_points<dim>(16, low, high, 2);
  std::vector<cloud::Index> candidates;
  search.collect(centre, std::sqrt(dim) * .5, candidates);
  basis::PointBatch<dim> batch;
  basis::CandidateBatch<dim> candidate_batch;
  basis::ShapeFunctionValues<dim> values;
  typename basis::ShapeFunctions<dim>::Workspace workspace;
  for (auto _ : state) {
    batch.assign(std::span<const cloud::Point<dim>>(points));
    candidate_batch.assign(particles, candidates, centre);
    benchmark::DoNotOptimize(basis->evaluate(batch, candidate_batch, everything, values, workspace));
  }
  state.SetItemsProcessed(state.iterations() * 16);
  state.counters["candidates"] = static_cast<double>(candidates.size());
  state.counters["neighbours"] = static_cast<double>(workspace.active.size());
}

template <int dim>
constexpr int n_monomials = (dim + 1) * (dim + 2) / 2;

template <int dim>
using Monomials = Eigen::Matrix<double, n_monomials<dim>, 1>;

/// 1, the offsets and their products, over h, with the factors of Taylor's series.
template <int dim>
Monomials<dim> monomials(const cloud::Point<dim> &offset, double h) {
  Monomials<dim> p;
  p[0] = 1;
  int next = 1 + dim;
  for (int k = 0; k < dim; ++k) {
    p[1 + k] = offset[k] / h;
    for (int l = k; l < dim; ++l)
      p[next++] = offset[k] * offset[l] / (h * h * (k == l ? 2 : 1));
  }
  return p;
}

/// What a short program on Eigen takes for the same, one point after the other; neighbours are known.
template <int dim>
void plain(benchmark::State &state, const kernels::Kernel &kernel) {
  const int side = dim == 2 ? 31 : 15;
  const double h = smoothing_length<dim>(kernel);
  const auto particles = unit_spacing<dim>(h, side);
  const cloud::CandidateSearch<dim> search(particles, kernels::support_of(kernel));
  const auto points = points_inside<dim>(side);
  std::vector<std::vector<cloud::Index>> lists(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    search.collect(points[i], 0, lists[i]);
  Eigen::Matrix<double, n_monomials<dim>, Eigen::Dynamic> p, shape;
  std::visit(
      [&](const auto &w) { // chosen once
        for (auto _ : state)
          for (std::size_t i = 0; i < points.size(); ++i) {
            const auto size = static_cast<Eigen::Index>(lists[i].size());
            p.resize(n_monomials<dim>, size);
            Eigen::VectorXd weight(size);
            for (Eigen::Index j = 0; j < size; ++j) {
              const auto &x = particles.position(static_cast<std::size_t>(lists[i][static_cast<std::size_t>(j)]));
              cloud::Point<dim> offset;
              for (int k = 0; k < dim; ++k)
                offset[k] = x[k] - points[i][k];
              p.col(j) = monomials<dim>(offset, h);
              weight[j] = w.value(cloud::distance_squared<dim>(x, points[i]) / (h * h));
            }
            const Eigen::Matrix<double, n_monomials<dim>, n_monomials<dim>> moments =
                p * weight.asDiagonal() * p.transpose();
            shape = moments.ldlt().solve(p * weight.asDiagonal());
            benchmark::DoNotOptimize(shape.data());
          }
      },
      kernel);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
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
constexpr auto *plain_2d = &plain<2>;
constexpr auto *plain_3d = &plain<3>;
constexpr auto *all_2d = &all_derivatives<2>;
constexpr auto *all_3d = &all_derivatives<3>;
constexpr auto *all_at_2d = &all_derivatives_at<2>;
constexpr auto *all_at_3d = &all_derivatives_at<3>;
constexpr auto *all_shared_2d = &all_derivatives_shared<2>;
constexpr auto *all_shared_3d = &all_derivatives_shared<3>;
BENCHMARK_CAPTURE(plain_2d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(plain_2d, gauss, kernels::Gauss(3));
BENCHMARK_CAPTURE(plain_3d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(plain_3d, gauss, kernels::Gauss(3));
BENCHMARK_CAPTURE(all_at_2d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(all_at_2d, gauss, kernels::Gauss(3));
BENCHMARK_CAPTURE(all_at_3d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(all_at_3d, gauss, kernels::Gauss(3));
BENCHMARK_CAPTURE(all_shared_2d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(all_shared_2d, gauss, kernels::Gauss(3));
BENCHMARK_CAPTURE(all_shared_3d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(all_shared_3d, gauss, kernels::Gauss(3));
BENCHMARK_CAPTURE(all_2d, polynomial, kernels::Quartic())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(all_2d, gauss, kernels::Gauss(3))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(all_3d, polynomial, kernels::Quartic())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(all_3d, gauss, kernels::Gauss(3))->Unit(benchmark::kMillisecond);
BENCHMARK(grouped)->Arg(1000)->Arg(20000)->Unit(benchmark::kMillisecond);

} // namespace
