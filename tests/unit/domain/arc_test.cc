// Circular arcs as boundary pieces: geometry, what is inside, what is near, loops.

#include "meshless/domain/boundary.h"
#include "unit/cloud/sample_clouds.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace meshless::domain;
using refusal::mentions;
using refusal::message_of;

constexpr double pi = std::numbers::pi;

/// Ring between the radii 1 and 2 around a centre; every circle in three arcs of different length.
Boundary ring(const Point2 &c) {
  const double angles[] = {0.3, 2.0, 4.5};
  std::vector<BoundaryPiece> pieces;
  const auto at = [&](double r, double a) { return Point2{c[0] + r * std::cos(a), c[1] + r * std::sin(a)}; };
  for (int k = 0; k < 3; ++k)
    pieces.push_back({at(2, angles[k]), at(2, angles[(k + 1) % 3]), 0, Arc{c, true}});
  for (int k = 2; k >= 0; --k)
    pieces.push_back({at(1, angles[(k + 1) % 3]), at(1, angles[k]), 1, Arc{c, false}});
  return Boundary(pieces);
}

TEST(Arc, knows_length_points_and_outward_normal) {
  const BoundaryPiece hole{{0, 1}, {1, 0}, 4, Arc{{0, 0}, false}}; // clockwise: the domain is outside
  EXPECT_NEAR(hole.length(), pi / 2, 1e-15);
  EXPECT_NEAR(hole.point(.5)[0], std::sqrt(.5), 1e-15);
  EXPECT_NEAR(hole.normal(.5)[0], -std::sqrt(.5), 1e-15) << "out of the domain is towards the centre";
  EXPECT_NEAR(hole.tangent(.5)[0], std::sqrt(.5), 1e-15);
  const BoundaryPiece outer{{1, 0}, {0, 1}, 4, Arc{{0, 0}, true}};
  EXPECT_NEAR(outer.normal(.5)[1], std::sqrt(.5), 1e-15);
  const BoundaryPiece long_way{{1, 0}, {0, 1}, 4, Arc{{0, 0}, false}};
  EXPECT_NEAR(long_way.length(), 1.5 * pi, 1e-14);
  EXPECT_NEAR(long_way.point(1. / 3)[1], -1, 1e-15);
}

TEST(Arc, distance_and_nearest_parameter_agree_with_many_samples) {
  const BoundaryPiece piece{{2, 1}, {1 + std::cos(4.), 1 + std::sin(4.)}, 0, Arc{{1, 1}, true}}; // sweep 4 rad
  for (const auto &x : sample_clouds::random_points<2>(200, {-1, -1}, {3, 3}, 7)) {
    double least = 1e9;
    for (int i = 0; i <= 4000; ++i) {
      const auto p = piece.point(i / 4000.);
      least = std::min(least, std::hypot(p[0] - x[0], p[1] - x[1]));
    }
    // Samples are 1e-3 apart along the arc: their least distance is above by at most half of that.
    EXPECT_NEAR(piece.distance(x), least, 5e-4);
    EXPECT_LE(piece.distance(x), least + 1e-14);
    const auto p = piece.point(piece.nearest(x));
    EXPECT_NEAR(std::hypot(p[0] - x[0], p[1] - x[1]), piece.distance(x), 1e-14);
  }
}

TEST(Arc, a_ring_contains_what_is_between_its_circles) {
  for (const Point2 c : {Point2{0, 0}, Point2{3, -5}}) {
    const auto boundary = ring(c);
    EXPECT_EQ(boundary.n_loops(), 2u);
    EXPECT_NEAR(boundary.loop_length(0), 4 * pi, 1e-13);
    EXPECT_NEAR(boundary.loop_length(1), 2 * pi, 1e-13);
    EXPECT_NEAR(boundary.extent(), 4 * std::sqrt(2.), 1e-14);
    for (const auto &x : sample_clouds::random_points<2>(3000, {c[0] - 3, c[1] - 3}, {c[0] + 3, c[1] + 3}, 11)) {
      const double r = std::hypot(x[0] - c[0], x[1] - c[1]);
      EXPECT_EQ(boundary.contains(x), r > 1 && r < 2) << r;
      EXPECT_NEAR(boundary.distance(x), std::min(std::abs(r - 1), std::abs(r - 2)), 1e-14);
    }
    // Rays through the extremes of the circles, where they only touch.
    EXPECT_TRUE(boundary.contains({c[0] - 1.5, c[1]}));
    EXPECT_TRUE(boundary.contains({c[0] - 1.2, c[1] + 1}));
    EXPECT_TRUE(boundary.contains({c[0] - 1.2, c[1] - 1}));
    EXPECT_FALSE(boundary.contains({c[0] - 1, c[1] + 2}));
  }
}

TEST(Arc, pieces_within_are_those_of_a_search_over_all) {
  const auto boundary = ring({0, 0});
  std::vector<std::size_t> found;
  for (const auto &x : sample_clouds::random_points<2>(300, {-4, -4}, {4, 4}, 3))
    for (const double radius : {.1, .7, 2.5, 9.}) {
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < boundary.pieces().size(); ++i)
        if (boundary.distance(x, i) < radius)
          expected.push_back(i);
      boundary.pieces_within(x, radius, found);
      EXPECT_EQ(found, expected);
    }
}

TEST(Arc, the_shorter_way_along_a_loop) {
  const auto boundary = ring({0, 0});
  const double quarter = boundary.along_loop(0, .5);
  EXPECT_NEAR(boundary.distance_along_loop(0, 0, quarter), 1.7, 1e-14); // half of an arc of 1.7 rad at radius 2
  EXPECT_NEAR(boundary.distance_along_loop(0, .1, 4 * pi - .1), .2, 1e-13);
}

TEST(Arc, refusals_name_the_piece) {
  const auto refused = [](const std::vector<BoundaryPiece> &pieces) {
    return message_of<std::invalid_argument>([&] { Boundary{pieces}; });
  };
  EXPECT_TRUE(mentions(refused({{{1, 0}, {1, 0}, 0, Arc{{0, 0}, true}}, {{1, 0}, {0, 1}}}), {"piece 0", "two arcs"}));
  EXPECT_TRUE(mentions(refused({{{1, 0}, {0, 1.1}, 0, Arc{{0, 0}, true}}, {{0, 1.1}, {1, 0}}}),
                       {"piece 0", "1 and 1.1 m", "centre"}));
}

} // namespace
