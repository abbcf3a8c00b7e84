// Figures of a cloud, and smoothing lengths enlarged where the basis would not exist.

#include "concave_samples.h"

#include "meshless/elasticity/cloud_quality.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(quality.median_neighbours, 21u);
  EXPECT_EQ(quality.fewest_neighbours, 8u) << "a corner";
  EXPECT_EQ(quality.fewest_at, 0u);
  EXPECT_NEAR(quality.smallest_distance, 1, 1e-12);
  EXPECT_GT(quality.smallest_pivot_ratio, 1e-4);
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
  const std::size_t poor = 60;
  for (std::size_t j = 0; j < good.size(); ++j)
    if (std::hypot(good.position(j)[0] - good.position(poor)[0], good.position(j)[1] - good.position(poor)[1]) < .8)
      h[j] *= .32;
  const cloud::Particles<2> starved({good.positions().begin(), good.positions().end()}, h);
  EXPECT_LE(cloud_quality(surroundings, starved, *basis, .85).smallest_pivot_ratio, poor_pivot_ratio);
  const auto mended = enlarge_where_poor(surroundings, starved, *basis, .85);
  EXPECT_GT(mended.n_enlarged, 0u);
  EXPECT_GT(mended.largest_factor, 1);
  EXPECT_LE(mended.largest_factor, 2);
  EXPECT_GT(cloud_quality(surroundings, mended.particles, *basis, .85).smallest_pivot_ratio, poor_pivot_ratio);
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

} // namespace
