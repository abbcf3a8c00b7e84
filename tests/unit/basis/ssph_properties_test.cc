// SSPH: consistent derivatives, independence of units, origin and batch, supports, refusals.

#include "evaluate_basis.h"

#include "meshless/basis/ssph.h"
#include "unit/cloud/sample_clouds.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace meshless;
using cloud::Point;
using evaluate_basis::everything;
using sample_clouds::random_points;

constexpr int n_rows = basis::ShapeFunctionValues<2>::n_quantities; // of value ... differentiated gradient
/// Power of a length in the unit of each row: 1, 1/m, 1/m^2 ...
constexpr int power[n_rows] = {0, -1, -1, -2, -2, -2, -1, -1};

std::vector<Point<2>> jittered() { return sample_clouds::jittered_grid<2>({12, 11}, {0, 0}, {1.1, 1}, .25, 3); }

/// h = .1, nearly the spacing.
cloud::Particles<2> with_equal_lengths(std::vector<Point<2>> points, double h = .1) {
  std::vector<double> lengths(points.size(), h);
  return {std::move(points), std::move(lengths)};
}

/// Largest absolute entry of one quantity at one point: what its rounding is relative to.
double size_of(const evaluate_basis::Result<2> &result, int row, std::size_t q) {
  double size = 0;
  for (std::size_t j = 0; j < result.candidates.size(); ++j)
    size = std::max(size, std::abs(result.values.row(row, j)[q]));
  return size;
}

std::vector<int> rows_of(const evaluate_basis::Result<2> &result) {
  std::vector<int> rows;
  for (int row = 0; row < n_rows; ++row)
    if (result.values.has(row))
      rows.push_back(row);
  return rows;
}

/// Rounding of shape functions relative to their largest entry: eps times the condition number, which
/// is below 1e5 for m <= 3 on these clouds (reproduction_test.cc), with a factor 20.
constexpr double rounding = 20 * 2.2e-16 * 1e5;

class SsphOrder : public testing::TestWithParam<int> {
protected:
  int order() const { return GetParam(); }
  const kernels::Gauss kernel{GetParam() + 2.};
  const std::unique_ptr<basis::ShapeFunctions<2>> basis = basis::make_ssph<2>(GetParam(), kernel);
};
INSTANTIATE_TEST_SUITE_P(Orders, SsphOrder, testing::Range(1, 5), testing::PrintToStringParamName());

TEST_P(SsphOrder, differentiated_gradient_is_the_derivative_of_the_value) {
  const auto particles = with_equal_lengths(jittered());
  const double step = 2e-4; // in units of h = .1
  int n_points = 0;
  for (const auto &x : random_points<2>(40, {.02, .02}, {1.08, .98}, 4)) {
    // The kernel's slope jumps at its edge: keep particles on it away.
    const bool smooth = std::ranges::none_of(particles.positions(), [&](const auto &xi) {
      const double s = std::sqrt(cloud::distance_squared<2>(xi, x)) / .1;
      return std::abs(s - kernel.support()) < 4 * step;
    });
    if (!smooth)
      continue;
    ++n_points;
    for (int k = 0; k < 2; ++k) {
      std::vector<Point<2>> points(5, x);
      for (std::size_t i = 1; i < 5; ++i)
        points[i][k] += (i % 2 == 0 ? -1 : 1) * (i < 3 ? 1 : 2) * .1 * step;
      const auto result = evaluate_basis::at<2>(*basis, particles, points, everything(order()));
      double worst[2] = {0, 0};
      for (std::size_t j = 0; j < particles.size(); ++j) {
        const double *value = result.values.value(j);
        const double exact = result.values.differentiated_gradient(k, j)[0];
        worst[0] = std::max(worst[0], std::abs((value[1] - value[2]) / (.2 * step) - exact));
        worst[1] = std::max(worst[1], std::abs((value[3] - value[4]) / (.4 * step) - exact));
      }
      // Remainder step^2 phi''' / 6 with phi''' up to 1e3 (h^-3 units) close to the border; halving
      // the step divides it by 4, as far as rounding (about 1e-13 / step) leaves it.
      const double size = size_of(result, 6 + k, 0);
      const double floor = rounding / step * .01 * size_of(result, 0, 0) / .1;
      EXPECT_LT(worst[0], 1e3 * step * step * size + floor);
      EXPECT_LT(worst[0], .27 * worst[1] + floor);
    }
  }
  EXPECT_GT(n_points, 15);
}

TEST_P(SsphOrder, does_not_depend_on_the_unit_of_length) {
  const auto points = random_points<2>(20, {0, 0}, {1.1, 1}, 5);
  const auto particles = with_equal_lengths(jittered());
  const auto metres = evaluate_basis::at<2>(*basis, particles, points, everything(order()));
  for (const double unit : {std::ldexp(1, -30), std::ldexp(1, 30), 1e-9, 1e-3, 1e9}) {
    auto scaled = jittered();
    auto scaled_points = points;
    for (auto *list : {&scaled, &scaled_points})
      for (auto &x : *list)
        x = {unit * x[0], unit * x[1]};
    const auto other =
        evaluate_basis::at<2>(*basis, with_equal_lengths(scaled, .1 * unit), scaled_points, everything(order()));
    const bool exact = std::frexp(unit, std::make_unique<int>().get()) == .5; // a power of two rounds nothing
    for (const int row : rows_of(metres)) {
      const double factor = std::pow(unit, -power[row]);
      for (std::size_t q = 0; q < points.size(); ++q)
        for (std::size_t j = 0; j < particles.size(); ++j)
          EXPECT_NEAR(other.values.row(row, j)[q] * factor, metres.values.row(row, j)[q],
                      exact ? 0 : 1e3 * rounding * size_of(metres, row, q));
    }
  }
}

TEST_P(SsphOrder, does_not_depend_on_the_origin) {
  // A shift by a power of two of coordinates on a grid of 2^-20 is exact, and so is every offset.
  const auto onto_grid = [](std::vector<Point<2>> points, double shift) {
    for (auto &x : points)
      for (double &component : x)
        component = std::round(std::ldexp(component, 20)) / std::ldexp(1, 20) + shift;
    return points;
  };
  const auto points = random_points<2>(20, {0, 0}, {1.1, 1}, 6);
  const auto here = evaluate_basis::at<2>(*basis, with_equal_lengths(onto_grid(jittered(), 0)), onto_grid(points, 0),
                                          everything(order()));
  const double far = std::ldexp(1, 20); // 1e6
  const auto there = evaluate_basis::at<2>(*basis, with_equal_lengths(onto_grid(jittered(), far)),
                                           onto_grid(points, far), everything(order()));
  for (const int row : rows_of(here))
    for (std::size_t q = 0; q < points.size(); ++q)
      for (std::size_t j = 0; j < here.candidates.size(); ++j)
        ASSERT_EQ(there.values.row(row, j)[q], here.values.row(row, j)[q]);
}

TEST_P(SsphOrder, does_not_depend_on_the_other_points_of_the_batch) {
  const auto particles = with_equal_lengths(jittered());
  const auto points = random_points<2>(64, {0, 0}, {1.1, 1}, 7);
  const auto together = evaluate_basis::at<2>(*basis, particles, points, everything(order()));
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto alone = evaluate_basis::at<2>(*basis, particles, {points[q]}, everything(order()));
    for (const int row : rows_of(together))
      for (std::size_t j = 0; j < particles.size(); ++j)
        // Lanes are separate, but those of one pack are refined together: rounding may differ.
        EXPECT_NEAR(alone.values.row(row, j)[0], together.values.row(row, j)[q], rounding * size_of(together, row, q));
  }
}

TEST_P(SsphOrder, is_exactly_zero_outside_the_support) {
  const auto particles = sample_clouds::with_mean_lengths<2>(jittered());
  std::size_t n_outside = 0;
  const auto centres = random_points<2>(13, {0, 0}, {1.1, 1}, 8); // not a whole number of packs
  const auto result = evaluate_basis::at<2>(*basis, particles, centres, everything(order()));
  for (std::size_t q = 0; q < centres.size(); ++q)
    for (std::size_t j = 0; j < particles.size(); ++j) {
      const double reach = basis->support() * particles.smoothing_length(j);
      if (cloud::distance_squared<2>(particles.position(j), centres[q]) < reach * reach) {
        EXPECT_NE(result.values.value(j)[q], 0);
        continue;
      }
      ++n_outside;
      for (const int row : rows_of(result))
        ASSERT_EQ(result.values.row(row, j)[q], 0);
    }
  EXPECT_GT(n_outside, 100u);
}

TEST_P(SsphOrder, needs_only_the_candidates_inside_the_support) {
  const auto particles = with_equal_lengths(jittered());
  const Point<2> x{.37, .52};
  const cloud::CandidateSearch<2> search(particles, basis->support());
  std::vector<cloud::Index> near;
  search.collect(x, 0, near);
  ASSERT_LT(near.size(), particles.size());
  const auto all = evaluate_basis::at<2>(*basis, particles, {x}, everything(order()));
  const auto some = evaluate_basis::at<2>(*basis, particles, {x}, everything(order()), near);
  for (const int row : rows_of(all))
    for (std::size_t j = 0; j < near.size(); ++j)
      // Only the mean of equal smoothing lengths may round differently.
      EXPECT_NEAR(some.values.row(row, j)[0], all.values.row(row, static_cast<std::size_t>(near[j]))[0],
                  rounding * size_of(all, row, 0));
}

TEST_P(SsphOrder, gives_the_same_whatever_else_is_wanted) {
  const auto particles = with_equal_lengths(jittered());
  const auto points = random_points<2>(10, {0, 0}, {1.1, 1}, 9);
  const auto all = evaluate_basis::at<2>(*basis, particles, points, everything(order()));
  std::vector<basis::Wanted> each{{.value = true}, {.gradient = true}, {.differentiated_gradient = true}};
  if (order() >= 2)
    each.push_back({.hessian = true});
  for (const auto &wanted : each) {
    const auto one = evaluate_basis::at<2>(*basis, particles, points, wanted);
    for (const int row : rows_of(one))
      for (std::size_t q = 0; q < points.size(); ++q)
        for (std::size_t j = 0; j < particles.size(); ++j)
          EXPECT_NEAR(one.values.row(row, j)[q], all.values.row(row, j)[q], rounding * size_of(all, row, q));
  }
}

TEST(Ssph, evaluates_no_point_and_no_candidate) {
  const auto basis = basis::make_ssph<2>(2, kernels::Gauss(3));
  const auto particles = with_equal_lengths(jittered());
  const auto none = evaluate_basis::at<2>(*basis, particles, {}, everything(2));
  EXPECT_EQ(none.values.stride(), 0u);
  EXPECT_EQ(none.regularity.smallest_pivot_ratio, 1);
}

TEST(Ssph, knows_its_order_support_and_terms) {
  for (int m = 1; m <= 4; ++m) {
    const auto basis = basis::make_ssph<3>(m, kernels::RevisedSuperGauss(2.5, 1.6));
    EXPECT_EQ(basis->order(), m);
    EXPECT_EQ(basis->support(), 2.5);
    EXPECT_EQ(basis->n_terms(), static_cast<std::size_t>((m + 1) * (m + 2) * (m + 3) / 6));
  }
}

TEST(Ssph, refuses_orders_that_do_not_exist) {
  for (const int order : {-1, 0, 5}) {
    EXPECT_THROW(basis::make_ssph<1>(order, kernels::Gauss(3)), std::invalid_argument);
    EXPECT_THROW(basis::make_ssph<2>(order, kernels::Gauss(3)), std::invalid_argument);
    EXPECT_THROW(basis::make_ssph<3>(order, kernels::Gauss(3)), std::invalid_argument);
  }
}

TEST(Ssph, refuses_second_derivatives_of_a_linear_basis) {
  const auto basis = basis::make_ssph<2>(1, kernels::Gauss(3));
  EXPECT_THROW(evaluate_basis::at<2>(*basis, with_equal_lengths(jittered()), {{.5, .5}}, {.hessian = true}),
               std::invalid_argument);
}

} // namespace
