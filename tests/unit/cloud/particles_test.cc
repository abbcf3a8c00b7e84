// Clouds are checked once, by name of the particle; smoothing lengths from the nearest neighbours.

#include "sample_clouds.h"

#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

using namespace meshless::cloud;
using refusal::mentions;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// What the constructor says, or nothing.
template <int dim = 2>
std::string refused(const std::vector<Point<dim>> &positions, const std::vector<double> &lengths) {
  return refusal::message_of<std::invalid_argument>([&] { Particles<dim>(positions, lengths); });
}

TEST(Particles, keep_what_they_are_given) {
  const Particles<2> particles({{0, 1}, {2, 3}, {4, 5}}, {.1, .3, .2});
  EXPECT_EQ(particles.size(), 3u);
  EXPECT_EQ(particles.position(1), (Point<2>{2, 3}));
  EXPECT_EQ(particles.smoothing_length(2), .2);
  EXPECT_EQ(particles.largest_smoothing_length(), .3);
  EXPECT_FALSE(particles.uniform());
  // Equal to rounding counts as equal.
  EXPECT_TRUE(Particles<1>({{0}, {1}}, {.3, .1 + .2}).uniform());
}

TEST(Particles, name_particles_at_the_same_place) {
  EXPECT_TRUE(mentions(refused({{0, 0}, {1, 2}, {3, 0}, {1, 2}}, {1, 1, 1, 1}), {"particles 1 and 3", "1, 2"}));
  EXPECT_TRUE(mentions((refused<3>({{0, 0, 1}, {0, 0, 0}, {0, 0, -0.}}, {1, 1, 1})), {"particles 1 and 2"}));
  EXPECT_TRUE(mentions((refused<1>({{5}, {5}}, {1, 1})), {"particles 0 and 1"}));
  EXPECT_EQ(refused({{0, 0}, {0, 5e-324}}, {1, 1}), "") << "different numbers are different places";
}

TEST(Particles, name_a_position_that_is_not_finite) {
  for (const double bad : {not_a_number, infinity, -infinity})
    EXPECT_TRUE(mentions(refused({{0, 0}, {1, 1}, {2, bad}}, {1, 1, 1}), {"particle 2"}));
}

TEST(Particles, name_a_smoothing_length_that_is_not_positive) {
  for (const double bad : {0., -1., not_a_number, infinity})
    EXPECT_TRUE(mentions(refused({{0, 0}, {1, 1}, {2, 2}}, {1, bad, 1}), {"particle 1", "smoothing length"}));
}

TEST(Particles, refuse_an_empty_cloud_and_unequal_numbers) {
  EXPECT_TRUE(mentions(refused({}, {}), {"at least one particle"}));
  EXPECT_TRUE(mentions(refused({{0, 0}, {1, 1}}, {1}), {"2 positions", "1 smoothing"}));
}

template <int dim>
void expect_mean_of_nearest(const std::vector<Point<dim>> &points) {
  for (const int k : {1, 2, 4, 6}) {
    const auto h = smoothing_lengths_by_mean<dim>(points, k, 1.5);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::vector<double> distances;
      for (const auto &x : points)
        distances.push_back(std::sqrt(distance_squared<dim>(points[i], x)));
      std::sort(distances.begin(), distances.end());
      double sum = 0;
      for (int n = 1; n <= k; ++n)
        sum += distances[static_cast<std::size_t>(n)];
      EXPECT_NEAR(h[i], 1.5 * sum / k, 1e-15 * h[i] * k); // k + 2 roundings
    }
  }
}

TEST(SmoothingLengths, are_the_mean_distance_of_the_nearest) {
  expect_mean_of_nearest<1>(sample_clouds::random_points<1>(60, {0}, {1}, 1));
  expect_mean_of_nearest<2>(sample_clouds::random_points<2>(60, {0, 0}, {1, 1}, 2));
  expect_mean_of_nearest<3>(sample_clouds::random_points<3>(60, {0, 0, 0}, {1, 1, 1}, 3));
}

TEST(SmoothingLengths, are_the_spacing_on_a_grid) {
  // Batra & Zhang 2008: h is the spacing, 1/15 on the cantilever of 16 x 4 particles.
  const auto points = sample_clouds::grid<2>({16, 4}, {0, 0}, {1, .2});
  const auto h = smoothing_lengths_by_nearest<2>(points, 1);
  for (const double length : h)
    EXPECT_NEAR(length, 1. / 15, 4e-16); // differences of coordinates up to 1: their rounding
  EXPECT_TRUE(Particles<2>(points, h).uniform());
}

TEST(SmoothingLengths, need_two_particles_and_a_neighbour) {
  const std::vector<Point<2>> one{{0, 0}};
  const std::vector<Point<2>> two{{0, 0}, {3, 4}};
  EXPECT_THROW(smoothing_lengths_by_nearest<2>(one, 1), std::invalid_argument);
  EXPECT_EQ(smoothing_lengths_by_mean<2>(two, 4, 1)[0], 5) << "the mean of those there are";
  EXPECT_THROW(smoothing_lengths_by_mean<2>(two, 0, 1), std::invalid_argument);
}

} // namespace
