// Points with neighbours of their own in every lane: the shape functions are those of shared candidates, one point at a
// time, to rounding, whatever the basis, the kernel, the smoothing lengths and the number of points.

#include "evaluate_basis.h"

#include "meshless/basis/basis_table.h"
#include "meshless/basis/neighbour_pack.h"
#include "unit/cloud/sample_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace meshless;
using cloud::Point;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

enum class Lengths { equal, graded, random };

/// Particles of the unit box, moved at random, with supports that reach over `reach` spacings.
template <int dim>
cloud::Particles<dim> make_cloud(Lengths lengths, double reach) {
  std::array<int, dim> n;
  n.fill(dim == 1 ? 40 : dim == 2 ? 14 : 9);
  Point<dim> low{};
  Point<dim> high;
  high.fill(1);
  auto points = lengths == Lengths::graded ? sample_clouds::graded_grid<dim>(n)
                                           : sample_clouds::jittered_grid<dim>(n, low, high, .2, 5);
  std::vector<double> h(points.size(), reach / (n[0] - 1));
  if (lengths == Lengths::graded)
    h = cloud::smoothing_lengths_by_mean<dim>(points, 2 * dim, reach);
  sample_clouds::Uniform random(6);
  std::vector<double> volumes;
  for (double &length : h) {
    volumes.push_back(std::pow(length, dim) * random.between(.9, 1.1));
    length *= lengths == Lengths::random ? random.between(1, 3) : 1;
  }
  return {std::move(points), std::move(h), std::move(volumes)};
}

/// Rounding of what both ways sum, up to 729 neighbours, which the condition of the moment matrix, some over its pivot
/// ratio, enlarges.
constexpr double rounding = 1000 * epsilon;

/// Largest difference of two rows of shape functions, over the largest of the row.
double difference(const std::vector<double> &a, const std::vector<double> &b) {
  double largest = 0;
  double size = 0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    largest = std::max(largest, std::abs(a[j] - b[j]));
    size = std::max(size, std::abs(a[j]));
  }
  return size > 0 ? largest / size : largest;
}

template <int dim>
void compare(const basis::BasisDescription &entry, int order, const kernels::Kernel &kernel, Lengths lengths,
             const basis::BasisOptions &options = {}) {
  const auto particles = make_cloud<dim>(lengths, (order + 2.3) / kernels::support_of(kernel));
  const auto shape = basis::make_basis<dim>(entry.name, order, kernel, options);
  const cloud::CandidateSearch<dim> search(particles, shape->support());
  Point<dim> low{};
  Point<dim> high;
  high.fill(1);
  const basis::Wanted wanted{.value = true,
                             .gradient = true,
                             .hessian = entry.hessian_anywhere && shape->order() != 1,
                             .differentiated_gradient = entry.differentiable};
  basis::NeighbourPack<dim> pack;
  basis::ShapeFunctionValues<dim> values;
  typename basis::ShapeFunctions<dim>::Workspace workspace;
  for (std::size_t n = 1; n <= linear_algebra::n_lanes; ++n) {
    auto points = sample_clouds::random_points<dim>(n, low, high, 7 + n);
    points.back() = particles.position(n); // where a distance is zero
    std::vector<std::vector<cloud::Index>> lists(n);
    for (std::size_t i = 0; i < n; ++i)
      search.collect(points[i], i % 2 == 0 ? 0 : .1, lists[i]);
    const std::vector<std::span<const cloud::Index>> spans(lists.begin(), lists.end());
    pack.assign(particles, points, spans);
    const auto regularity = shape->evaluate_own(pack, wanted, values, workspace);
    double smallest = 1;
    std::size_t n_indefinite = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto plain = evaluate_basis::at<dim>(*shape, particles, {points[i]}, wanted, lists[i]);
      const double ratio = plain.regularity.smallest_pivot_ratio;
      smallest = std::min(smallest, ratio);
      n_indefinite += plain.regularity.n_indefinite;
      for (int quantity = 0; quantity < basis::ShapeFunctionValues<dim>::n_quantities; ++quantity) {
        ASSERT_EQ(values.has(quantity), plain.values.has(quantity));
        if (!values.has(quantity))
          continue;
        std::vector<double> expected(pack.n_slots(), 0);
        std::vector<double> found(pack.n_slots());
        for (std::size_t a = 0; a < pack.n_slots(); ++a) {
          if (a < lists[i].size())
            expected[a] = plain.values.row(quantity, a)[0];
          found[a] = values.row(quantity, a)[i];
        }
        EXPECT_LT(difference(expected, found), rounding / ratio)
            << entry.name << " order " << order << " in " << dim << "D, quantity " << quantity << ", " << n
            << " points";
      }
    }
    EXPECT_EQ(regularity.n_indefinite, n_indefinite);
    // Otherwise all matrices of a pack may be factorised by complete pivoting because of one, and ratios are others.
    if (kernels::describe(kernel).non_negative) {
      EXPECT_NEAR(regularity.smallest_pivot_ratio, smallest, rounding);
    }
  }
}

class OwnNeighbours : public testing::TestWithParam<basis::BasisDescription> {};
INSTANTIATE_TEST_SUITE_P(Table, OwnNeighbours,
                         testing::ValuesIn(basis::basis_table().begin(), basis::basis_table().end()),
                         [](const auto &test) { return std::string(test.param.name); });

TEST_P(OwnNeighbours, shape_functions_of_shared_candidates) {
  const auto &entry = GetParam();
  const auto all = [&]<int dim>(std::integral_constant<int, dim>) {
    for (int order = entry.lowest_order; order <= entry.highest_order && dim <= entry.highest_dimension; ++order) {
      for (const auto lengths : {Lengths::equal, Lengths::graded, Lengths::random})
        compare<dim>(entry, order, kernels::Gauss(order + 2), lengths);
      compare<dim>(entry, order, kernels::Quartic(), Lengths::equal);
      // With negative values: some moment matrices are not positive definite.
      compare<dim>(entry, order, kernels::SuperGauss(3), Lengths::graded);
      if (entry.volumes == basis::VolumeUse::optional)
        compare<dim>(entry, order, kernels::Gauss(order + 2), Lengths::random, {.volumes = true});
    }
  };
  all(std::integral_constant<int, 1>{});
  all(std::integral_constant<int, 2>{});
  all(std::integral_constant<int, 3>{});
}

/// The map x -> along e and across it, three times as long along.
Point<2> stretched(const Point<2> &x, double factor) {
  const Point<2> e{std::cos(.4), std::sin(.4)};
  const double along = (factor - 1) * (e[0] * x[0] + e[1] * x[1]);
  return {x[0] + along * e[0], x[1] + along * e[1]};
}

TEST(EllipticSupports, are_round_ones_of_a_cloud_that_has_been_stretched) {
  // With y = L x a value is the same, a gradient by x that by y times L; both ways of finding neighbours.
  constexpr double factor = 3;
  const auto round = make_cloud<2>(Lengths::random, 1);
  std::vector<Point<2>> positions;
  std::vector<double> h;
  for (std::size_t i = 0; i < round.size(); ++i) {
    positions.push_back(stretched(round.position(i), factor));
    h.push_back(factor * round.smoothing_length(i));
  }
  const double f = std::sqrt(factor * factor - 1);
  const std::vector<Point<2>> flattenings(positions.size(), {-f * std::sin(.4), f * std::cos(.4)});
  const cloud::Particles<2> particles(positions, h, {}, {}, flattenings);
  const auto shape = basis::make_basis<2>("ssph", 2, kernels::Gauss(4), {});
  const basis::Wanted wanted{.value = true, .gradient = true};
  const cloud::CandidateSearch<2> search(particles, shape->support());
  basis::NeighbourPack<2> pack;
  basis::ShapeFunctionValues<2> own;
  basis::ShapeFunctions<2>::Workspace workspace;
  for (const auto &x : sample_clouds::random_points<2>(20, {0, 0}, {1, 1}, 8)) {
    const auto y = stretched(x, factor);
    EXPECT_NEAR(particles.squared_distance_in_h(7, y), round.squared_distance_in_h(7, x), 1e-12);
    const auto expected = evaluate_basis::at<2>(*shape, round, {x}, wanted);
    const auto found = evaluate_basis::at<2>(*shape, particles, {y}, wanted);
    std::vector<cloud::Index> list;
    search.collect(y, 0, list);
    const std::span<const cloud::Index> lists[] = {list};
    pack.assign(particles, {&y, 1}, lists);
    shape->evaluate_own(pack, wanted, own, workspace);
    const double tolerance = rounding / expected.regularity.smallest_pivot_ratio;
    std::size_t a = 0;
    for (std::size_t j = 0; j < particles.size(); ++j) {
      const auto compare_with = [&](double value, const Point<2> &gradient) {
        const auto g = stretched(gradient, factor);
        EXPECT_NEAR(value, expected.values.value(j)[0], tolerance);
        for (int k = 0; k < 2; ++k)
          EXPECT_NEAR(g[k] * h[0], expected.values.gradient(k, j)[0] * h[0], 10 * tolerance);
      };
      compare_with(found.values.value(j)[0], {found.values.gradient(0, j)[0], found.values.gradient(1, j)[0]});
      const bool listed = a < list.size() && static_cast<std::size_t>(list[a]) == j;
      compare_with(listed ? own.value(a)[0] : 0,
                   listed ? Point<2>{own.gradient(0, a)[0], own.gradient(1, a)[0]} : Point<2>{});
      a += listed;
    }
  }
}

TEST(EllipticSupports, are_refused_by_what_has_round_ones_alone) {
  const auto round = make_cloud<2>(Lengths::equal, 2);
  const auto positions = round.positions();
  const auto h = round.smoothing_lengths();
  const auto volumes = round.volumes();
  const cloud::Particles<2> particles({positions.begin(), positions.end()}, {h.begin(), h.end()},
                                      {volumes.begin(), volumes.end()}, {},
                                      std::vector<Point<2>>(positions.size(), {1, 0}));
  const auto evaluate = [&](const char *name, const basis::Wanted &wanted) {
    evaluate_basis::at<2>(*basis::make_basis<2>(name, 2, kernels::Gauss(4), {}), particles, {{.5, .5}}, wanted);
  };
  EXPECT_NO_THROW(evaluate("ssph", {.value = true, .gradient = true, .hessian = true}));
  EXPECT_THROW(evaluate("ssph", {.differentiated_gradient = true}), std::invalid_argument);
  EXPECT_THROW(evaluate("rkpm", {.value = true}), std::invalid_argument);
  EXPECT_THROW(evaluate("msph", {.value = true}), std::invalid_argument);
}

} // namespace
