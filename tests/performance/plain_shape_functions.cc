// The same shape functions as a short program on Eigen computes them, one point after the other: what the batches are
// to be compared with. Neighbours are known, as in all_at_2d and all_at_3d.

#include "meshless/cloud/candidate_search.h"
#include "meshless/kernels/kernel_table.h"
#include "unit/cloud/sample_clouds.h"

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

namespace {

using namespace meshless;

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

/// Value, first and second derivatives of the shape functions of SSPH, order 2: a column a neighbour.
template <int dim>
void plain(benchmark::State &state, const kernels::Kernel &kernel) {
  const int side = dim == 2 ? 31 : 15;
  const double radius = dim == 2 ? std::sqrt(30 / std::numbers::pi) : std::cbrt(45 / std::numbers::pi);
  const double h = radius / kernels::support_of(kernel);
  std::array<int, dim> n;
  n.fill(side);
  cloud::Point<dim> low{}, high;
  high.fill(side - 1);
  auto positions = sample_clouds::jittered_grid<dim>(n, low, high, .25, 1);
  std::vector<double> lengths(positions.size(), h);
  const cloud::Particles<dim> particles(std::move(positions), std::move(lengths));
  const cloud::CandidateSearch<dim> search(particles, kernels::support_of(kernel));
  low.fill(3);
  high.fill(side - 4);
  const auto points =
      sample_clouds::random_points<dim>(static_cast<std::size_t>(std::pow(side - 7, dim)), low, high, 3);
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

constexpr auto *plain_2d = &plain<2>;
constexpr auto *plain_3d = &plain<3>;
BENCHMARK_CAPTURE(plain_2d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(plain_2d, gauss, kernels::Gauss(3));
BENCHMARK_CAPTURE(plain_3d, polynomial, kernels::Quartic());
BENCHMARK_CAPTURE(plain_3d, gauss, kernels::Gauss(3));

} // namespace
