// Moment matrices that do not exist are refused by place and cause, wherever they occur.

#include "evaluate_basis.h"

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/ssph.h"
#include "unit/cloud/sample_clouds.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace meshless;
using basis::SingularMomentMatrix;
using cloud::Point;
using refusal::mentions;
using refusal::message_of;

std::string refused(int order, double support, const cloud::Particles<2> &particles,
                    const std::vector<Point<2>> &points) {
  const auto basis = basis::make_ssph<2>(order, kernels::Gauss(support));
  return message_of<SingularMomentMatrix>([&] { evaluate_basis::at<2>(*basis, particles, points, {.value = true}); });
}

cloud::Particles<2> cantilever() {
  return {sample_clouds::grid<2>({16, 4}, {0, 0}, {1, .2}), std::vector<double>(64, 1. / 15)};
}

TEST(SingularMomentMatrix, too_few_neighbours) {
  const cloud::Particles<2> three({{0, 0}, {1, 0}, {0, 1}}, {1, 1, 1});
  EXPECT_TRUE(mentions(refused(2, 3, three, {{.5, .25}}), {"(0.5, 0.25)", "too few neighbours", "3 for 6 terms"}));
  EXPECT_EQ(refused(1, 3, three, {{.5, .25}}), "") << "three are enough for order 1";
  // The second point alone is out of reach.
  EXPECT_TRUE(mentions(refused(1, 3, three, {{.5, .25}, {50, 0}}), {"(50, 0)", "0 for 3 terms"}));
}

TEST(SingularMomentMatrix, particles_on_a_line) {
  std::vector<Point<2>> line;
  for (int i = 0; i < 9; ++i)
    line.push_back({.1 * i, .3 * i});
  const cloud::Particles<2> particles(line, std::vector<double>(9, 1));
  for (int order = 1; order <= 2; ++order)
    EXPECT_TRUE(mentions(refused(order, 5, particles, {{.4, 1.2}}),
                         {"(0.4, 1.2)", "9 neighbours", order == 1 ? "2 distinct lines" : "3 distinct lines"}));
}

TEST(SingularMomentMatrix, order_4_needs_five_lines_and_the_cantilever_has_four) {
  const auto points = sample_clouds::random_points<2>(200, {0, 0}, {1, .2}, 1);
  for (const double support : {4., 6., 8.}) {
    EXPECT_TRUE(mentions(refused(4, support, cantilever(), {{.5, .1}}), {"(0.5, 0.1)", "5 distinct lines"}));
    for (const auto &x : points) // whatever the rounding leaves of the pivot
      EXPECT_NE(refused(4, support, cantilever(), {x}), "") << x[0] << " " << x[1] << " " << support;
  }
}

TEST(SingularMomentMatrix, also_on_lines_along_no_axis) {
  std::vector<Point<2>> turned;
  for (const auto &x : sample_clouds::grid<2>({16, 4}, {0, 0}, {1, .2}))
    turned.push_back({.8 * x[0] - .6 * x[1], .6 * x[0] + .8 * x[1]});
  const cloud::Particles<2> particles(turned, std::vector<double>(64, 1. / 15));
  for (const auto &x : sample_clouds::random_points<2>(200, {0, 0}, {1, .2}, 2)) {
    const Point<2> inside{.8 * x[0] - .6 * x[1], .6 * x[0] + .8 * x[1]};
    EXPECT_NE(refused(4, 6, particles, {inside}), "") << x[0] << " " << x[1];
    EXPECT_EQ(refused(3, 5, particles, {inside}), "") << x[0] << " " << x[1];
  }
}

TEST(SingularMomentMatrix, order_3_with_support_3_reaches_three_lines_at_an_edge) {
  const auto particles = cantilever();
  const std::vector<Point<2>> all(particles.positions().begin(), particles.positions().end());
  EXPECT_TRUE(mentions(refused(3, 3, particles, {{.4, 0}}), {"(0.4, 0)", "15 neighbours", "4 distinct lines"}));
  // In the corner: those at exactly 3 h do not count.
  EXPECT_TRUE(mentions(refused(3, 3, particles, all), {"(0, 0)", "too few neighbours", "9 for 10 terms"}));
  EXPECT_EQ(refused(3, 4, particles, all), "");
}

TEST(SingularMomentMatrix, in_one_and_three_dimensions) {
  const cloud::Particles<1> two({{0}, {1}}, {1, 1});
  const auto basis1 = basis::make_ssph<1>(2, kernels::Gauss(3));
  EXPECT_TRUE(
      mentions(message_of<SingularMomentMatrix>([&] { evaluate_basis::at<1>(*basis1, two, {{.25}}, {.value = true}); }),
               {"(0.25)", "2 for 3 terms"}));
  const auto plane = sample_clouds::grid<2>({4, 4}, {0, 0}, {3, 3});
  std::vector<Point<3>> flat;
  for (const auto &x : plane)
    flat.push_back({x[0], x[1], 1});
  const cloud::Particles<3> particles(flat, std::vector<double>(16, 1));
  const auto basis3 = basis::make_ssph<3>(1, kernels::Gauss(3));
  EXPECT_TRUE(mentions(message_of<SingularMomentMatrix>([&] {
                         evaluate_basis::at<3>(*basis3, particles, {{1.5, 1.5, 1}}, {.value = true});
                       }),
                       {"(1.5, 1.5, 1)"}));
}

TEST(GroupedEvaluation, visits_every_point_once) {
  const auto particles =
      sample_clouds::with_mean_lengths<2>(sample_clouds::jittered_grid<2>({12, 11}, {0, 0}, {1.1, 1}, .25, 3));
  const auto basis = basis::make_ssph<2>(2, kernels::Gauss(4));
  const cloud::CandidateSearch<2> search(particles, basis->support());
  const basis::GroupedEvaluation<2> evaluation(*basis, search);
  // Many in one cell, some equal, some alone.
  auto points = sample_clouds::random_points<2>(500, {0, 0}, {1.1, 1}, 4);
  const auto crowd = sample_clouds::random_points<2>(300, {.5, .5}, {.51, .51}, 5);
  points.insert(points.end(), crowd.begin(), crowd.end());
  points.insert(points.end(), 70, Point<2>{.25, .75});
  std::vector<int> visits(points.size(), 0);
  std::vector<double> sums(points.size(), 0);
  evaluation.visit(points, {.value = true}, [&](const auto &group) {
    EXPECT_LE(group.points.size(), linear_algebra::n_lanes);
    for (std::size_t p = 0; p < group.points.size(); ++p) {
      const std::size_t i = group.points[p];
      ++visits[i];
      for (std::size_t j = 0; j < group.n_neighbours(p); ++j) {
        const auto &xi = particles.position(static_cast<std::size_t>(group.neighbour(j, p)));
        sums[i] += group.values.value(j)[p] * (1 + xi[0] - 2 * xi[0] * xi[1]);
      }
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(visits[i], 1);
    const auto &[x, y] = points[i];
    EXPECT_NEAR(sums[i], 1 + x - 2 * x * y, 1e-13) << "reproduced there: the values belong to this point";
  }
  int n_groups = 0;
  evaluation.visit({}, {.value = true}, [&](const auto &) { ++n_groups; });
  EXPECT_EQ(n_groups, 0);
}

TEST(GroupedEvaluation, names_a_point_that_no_particle_reaches) {
  const auto particles = cantilever();
  const auto basis = basis::make_ssph<2>(2, kernels::Gauss(3));
  const cloud::CandidateSearch<2> search(particles, basis->support());
  const std::vector<Point<2>> points{{.5, .1}, {.5, 7}, {.2, .1}};
  EXPECT_TRUE(
      mentions(message_of<SingularMomentMatrix>([&] {
                 basis::GroupedEvaluation<2>(*basis, search).visit(points, {.value = true}, [](const auto &) {});
               }),
               {"(0.5, 7)", "0 for 6 terms"}));
}

} // namespace
