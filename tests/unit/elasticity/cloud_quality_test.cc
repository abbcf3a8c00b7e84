// Figures of a cloud, and smoothing lengths enlarged where the basis would not exist.

#include "concave_samples.h"

#include "meshless/basis/derivative_operators.h"
#include "meshless/elasticity/cell_shapes.h"
#include "meshless/elasticity/cloud_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace plane_samples;

const Material material(2, .3, PlaneModel::plane_strain);

Surroundings unit_square() { return Surroundings({{domain::rectangle({0, 0}, {1, 1}), material}}); }

TEST(CloudQuality, of_a_grid_can_be_counted) {
  auto points = sample_clouds::grid<2>({11, 11}, {0, 0}, {1, 1});
  const cloud::Particles<2> particles(points, cloud::smoothing_lengths_by_nearest<2>(points, 1));
  const auto surroundings = unit_square();
  const auto basis = basis::make_ssph<2>(2, kernels::Gauss(2.5));
  const auto quality = cloud_quality(surroundings, particles, *basis, 1);
  EXPECT_EQ(quality.most_neighbours, 21u) << "i^2 + j^2 < 6.25";
  // 49 of 121 are two spacings or more from every side; the median has one side one spacing away: 21 - 3.
  EXPECT_EQ(quality.median_neighbours, 18u);
  EXPECT_EQ(quality.fewest_neighbours, 8u) << "a corner";
  EXPECT_EQ(quality.fewest_at, 0u);
  EXPECT_NEAR(quality.smallest_distance, 1, 1e-12);
  EXPECT_GT(quality.smallest_pivot_ratio, 1e-4);
}

TEST(CloudQuality, counts_moment_matrices_that_are_not_positive_definite) {
  auto points = sample_clouds::grid<2>({11, 11}, {0, 0}, {1, 1});
  const cloud::Particles<2> particles(points, cloud::smoothing_lengths_by_nearest<2>(points, 1));
  const auto surroundings = unit_square();
  const auto count = [&](const kernels::Kernel &kernel, double reach) {
    return cloud_quality(surroundings, particles, *basis::make_ssph<2>(2, kernel), reach).n_indefinite;
  };
  EXPECT_EQ(count(kernels::Gauss(4), 1), 0u);
  const auto negative = kernels::make_kernel("super_gauss", 4);
  const auto operators =
      basis::make_derivative_operators<2>(*basis::make_ssph<2>(2, negative), particles, {.gradient = true});
  EXPECT_GT(operators.n_indefinite, 0u);
  EXPECT_EQ(count(negative, 0), operators.n_indefinite) << "at the particles alone";
  EXPECT_GE(count(negative, 1), operators.n_indefinite) << "and around them";
}

TEST(CloudQuality, counts_what_is_visible_only) {
  // The faces of a slot have half of the neighbours of particles inside.
  const domain::Boundary boundary({{{0, 0}, {1, 0}},
                                   {{1, 0}, {1, 1}},
                                   {{1, 1}, {.501, 1}},
                                   {{.501, 1}, {.501, .2}},
                                   {{.501, .2}, {.499, .2}},
                                   {{.499, .2}, {.499, 1}},
                                   {{.499, 1}, {0, 1}},
                                   {{0, 1}, {0, 0}}});
  std::vector<Point2> points;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 20; ++j)
      points.push_back({i == 10 ? .499 : .05 * i, .05 * j});
  const std::size_t half = points.size();
  for (std::size_t i = 0; i < half; ++i)
    points.push_back({1 - points[i][0], points[i][1]});
  std::erase_if(points, [&](const Point2 &x) { return !boundary.contains(x) && boundary.pieces_at(x).empty(); });
  const cloud::Particles<2> particles(points, std::vector<double>(points.size(), .05));
  const Surroundings surroundings({{boundary, material}});
  RegionFilter filter(surroundings, particles, 0);
  std::vector<cloud::Index> candidates(particles.size());
  for (std::size_t j = 0; j < candidates.size(); ++j)
    candidates[j] = static_cast<cloud::Index>(j);
  filter.apply({.499, .9}, candidates);
  for (const auto j : candidates)
    if (particles.position(static_cast<std::size_t>(j))[1] > .5) {
      EXPECT_LT(particles.position(static_cast<std::size_t>(j))[0], .5);
    }
  EXPECT_GT(candidates.size(), 200u);
}

TEST(Enlargement, mends_a_cloud_whose_basis_does_not_exist_and_leaves_others_alone) {
  const auto boundary = quarter_plate();
  const std::vector<Region> plate{{boundary, material}};
  const Surroundings surroundings(plate);
  const auto basis = std::shared_ptr<const basis::ShapeFunctions<2>>(basis::make_ssph<2>(2, kernels::Gauss(4)));
  const auto good = quarter_plate_cloud(11, .2, 1);
  const auto untouched = enlarge_where_poor(surroundings, good, *basis, .85);
  EXPECT_EQ(untouched.n_enlarged, 0u);
  EXPECT_EQ(untouched.largest_factor, 1);

  // One particle with its neighbourhood starved.
  std::vector<double> h(good.smoothing_lengths().begin(), good.smoothing_lengths().end());
  const std::size_t poor = 60; // in the middle
  for (std::size_t j = 0; j < good.size(); ++j)
    if (std::hypot(good.position(j)[0] - good.position(poor)[0], good.position(j)[1] - good.position(poor)[1]) < 1.5)
      h[j] *= .3;
  const cloud::Particles<2> starved({good.positions().begin(), good.positions().end()}, h);
  EXPECT_LE(cloud_quality(surroundings, starved, *basis, .85).smallest_pivot_ratio, poor_pivot_ratio(2));
  const auto mended = enlarge_where_poor(surroundings, starved, *basis, .85);
  EXPECT_GT(mended.n_enlarged, 0u);
  EXPECT_GT(mended.largest_factor, 1);
  EXPECT_LE(mended.largest_factor, 2);
  EXPECT_GT(cloud_quality(surroundings, mended.particles, *basis, .85).smallest_pivot_ratio, poor_pivot_ratio(2));
  const auto exact = linear_displacement();
  EXPECT_LT(
      errors_at_random(solve(WeakForm::weak1, problem_on(plate, exact, {0, 3}), mended.particles, 2), exact, 200, 1)
          .displacement,
      1e-8);
}

TEST(Enlargement, gives_up_where_no_length_helps) {
  // Two lines of particles can not carry a quadratic across them.
  auto points = sample_clouds::grid<2>({11, 2}, {0, 0}, {1, .1});
  const cloud::Particles<2> particles(points, std::vector<double>(points.size(), .1));
  const Surroundings strip({{domain::rectangle({0, 0}, {1, .1}), material}});
  const auto basis = basis::make_ssph<2>(2, kernels::Gauss(4));
  const auto result = enlarge_where_poor(strip, particles, *basis, 1);
  EXPECT_LE(result.largest_factor, 2);
  EXPECT_LE(cloud_quality(strip, result.particles, *basis, 1).smallest_pivot_ratio, 1e-12);
}

TEST(CellShapes, are_the_cells_of_a_grid_and_its_edges) {
  const double spacing[] = {.1, .025};
  const auto points = sample_clouds::grid<2>({11, 41}, {0, 0}, {1, 1});
  const auto shapes = cell_shapes(unit_square(), points, {});
  EXPECT_NEAR(shapes.upper_aspect, 4, 1e-9);
  const auto far_from_end = [](double x, double d) { return x > 1.99 * d && x < 1 - 1.99 * d; };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!far_from_end(points[i][0], spacing[0]) && !far_from_end(points[i][1], spacing[1]))
      continue; // the cell in a corner has its part in the average
    EXPECT_NEAR(shapes.smoothing_lengths[i], spacing[0], 1e-10);
    EXPECT_NEAR(shapes.flattenings[i][0], 0, 1e-9);
    EXPECT_NEAR(std::abs(shapes.flattenings[i][1]), std::sqrt(15), 1e-9);
  }
}

TEST(CellShapes, are_the_cells_of_a_ring) {
  // Cells between two arcs and two rays, r dr dphi: as long and wide as that to the first order of dr / r.
  const domain::Boundary ring({{{1, 0}, {2, 0}, 0},
                               {{2, 0}, {0, 2}, 1, domain::Arc{{0, 0}, true}},
                               {{0, 2}, {0, 1}, 2},
                               {{0, 1}, {1, 0}, 3, domain::Arc{{0, 0}, false}}});
  constexpr double dr = 1. / 60, dphi = std::numbers::pi / 60;
  std::vector<Point2> points;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 30; ++j)
      points.push_back(
          {j == 30 ? 0 : (1 + i * dr) * std::cos(j * dphi), j == 0 ? 0 : (1 + i * dr) * std::sin(j * dphi)});
  const auto shapes = cell_shapes(Surroundings({{ring, material}}), points, {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double r = std::hypot(points[i][0], points[i][1]);
    const auto &f = shapes.flattenings[i];
    const bool at_cut = std::min(points[i][0], points[i][1]) < 2 * r * dphi;
    if (at_cut && std::min(r - 1, 2 - r) < 2 * dr)
      continue; // a corner
    EXPECT_NEAR(shapes.smoothing_lengths[i], r * dphi, .05 * r * dphi);
    EXPECT_NEAR(std::sqrt(1 + f[0] * f[0] + f[1] * f[1]), r * dphi / dr, .05 * r * dphi / dr);
    EXPECT_NEAR(std::abs(f[0] * points[i][1] - f[1] * points[i][0]) / std::hypot(f[0], f[1]) / r, 0, .05);
  }
}

TEST(CellShapes, are_those_of_the_own_region) {
  // Two regions with grids of different spacings, particles on the interface twice.
  const auto box = [](double left, double right) { return domain::rectangle({left, 0}, {right, 1}); };
  const Surroundings surroundings({{box(0, 1), material}, {box(1, 2), material}});
  auto points = sample_clouds::grid<2>({11, 11}, {0, 0}, {1, 1});
  std::vector<int> regions(points.size(), 0);
  for (const auto &x : sample_clouds::grid<2>({11, 41}, {1, 0}, {2, 1}))
    points.push_back(x);
  regions.resize(points.size(), 1);
  const auto shapes = cell_shapes(surroundings, points, regions);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i][1] < .19 || points[i][1] > .81) // corners
      continue;
    EXPECT_NEAR(shapes.smoothing_lengths[i], .1, 1e-10);
    EXPECT_NEAR(std::hypot(shapes.flattenings[i][0], shapes.flattenings[i][1]), regions[i] == 0 ? 0 : std::sqrt(15),
                regions[i] == 0 ? 1e-4 : 1e-9); // sqrt of rounding
  }
}

} // namespace
