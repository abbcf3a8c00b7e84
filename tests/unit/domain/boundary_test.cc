// Polygons as boundaries: what is refused, what is inside, what is on a piece.

#include "meshless/domain/boundary.h"
#include "unit/cloud/sample_clouds.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace meshless::domain;
using refusal::mentions;
using refusal::message_of;

std::string refused(const std::vector<BoundaryPiece> &pieces) {
  return message_of<std::invalid_argument>([&] { Boundary{pieces}; });
}

TEST(Boundary, refuses_what_is_not_closed) {
  EXPECT_TRUE(mentions(refused({}), {"at least three"}));
  EXPECT_TRUE(mentions(refused({{{0, 0}, {1, 0}}, {{1, 0}, {0, 0}}}), {"at least three", "2"}));
  EXPECT_TRUE(mentions(refused({{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, .5}}}),
                       {"not closed", "piece 2", "(0, 0.5)"}));
  EXPECT_TRUE(mentions(refused({{{0, 0}, {1, 0}}, {{1, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, 0}}}),
                       {"piece 1", "no length"}));
  EXPECT_EQ(refused({{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {1e-11, 0}}}), "") << "closed to rounding";
}

TEST(Boundary, refuses_coordinates_that_are_not_finite) {
  const double nan = std::nan("");
  EXPECT_NE(refused({{{0, 0}, {1, 0}}, {{1, 0}, {1, nan}}, {{1, nan}, {0, 0}}}), "");
}

TEST(Boundary, pieces_know_length_and_outward_normal) {
  const BoundaryPiece piece{{1, 1}, {4, 5}};
  EXPECT_DOUBLE_EQ(piece.length(), 5);
  EXPECT_DOUBLE_EQ(piece.normal()[0], .8); // to the right of the direction (3, 4): the domain lies left
  EXPECT_DOUBLE_EQ(piece.normal()[1], -.6);
}

TEST(Boundary, rectangle_has_its_ids_and_normals) {
  const auto boundary = rectangle({-1, 2}, {3, 5});
  EXPECT_DOUBLE_EQ(boundary.extent(), 5);
  const Point2 normals[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  ASSERT_EQ(boundary.pieces().size(), 4u);
  for (const auto &piece : boundary.pieces()) {
    EXPECT_DOUBLE_EQ(piece.normal()[0], normals[piece.id][0]);
    EXPECT_DOUBLE_EQ(piece.normal()[1], normals[piece.id][1]);
  }
}

TEST(Boundary, contains_the_inside_of_a_concave_polygon_with_a_hole) {
  // An L of two squares of edge 2, and a hole [.5, 1]^2 that runs clockwise.
  const Boundary boundary({{{0, 0}, {4, 0}},
                           {{4, 0}, {4, 2}},
                           {{4, 2}, {2, 2}},
                           {{2, 2}, {2, 4}},
                           {{2, 4}, {0, 4}},
                           {{0, 4}, {0, 0}},
                           {{.5, .5}, {.5, 1}},
                           {{.5, 1}, {1, 1}},
                           {{1, 1}, {1, .5}},
                           {{1, .5}, {.5, .5}}});
  for (const auto &x : sample_clouds::random_points<2>(2000, {-1, -1}, {5, 5}, 1)) {
    const bool box = x[0] > 0 && x[1] > 0 && x[0] < 4 && x[1] < 4;
    const bool corner = x[0] > 2 && x[1] > 2;
    const bool hole = x[0] > .5 && x[0] < 1 && x[1] > .5 && x[1] < 1;
    EXPECT_EQ(boundary.contains(x), box && !corner && !hole) << x[0] << " " << x[1];
  }
  // The ray to the right runs along pieces and through corners.
  EXPECT_TRUE(boundary.contains({1.5, 2}));
  EXPECT_TRUE(boundary.contains({1.5, 1}));
  EXPECT_TRUE(boundary.contains({.25, .5}));
  EXPECT_FALSE(boundary.contains({-1, 2}));
  EXPECT_FALSE(boundary.contains({-1, 0}));
  EXPECT_FALSE(boundary.contains({3, 4}));
}

TEST(Boundary, finds_the_pieces_of_a_point) {
  const auto boundary = rectangle({0, 0}, {1, .2}); // bottom, right, top, left
  using Pieces = std::vector<std::size_t>;
  EXPECT_EQ(boundary.pieces_at({.5, .1}), Pieces{});
  EXPECT_EQ(boundary.pieces_at({.5, 0}), Pieces{0});
  EXPECT_EQ(boundary.pieces_at({1, .1}), Pieces{1});
  EXPECT_EQ(boundary.pieces_at({1, .2}), (Pieces{1, 2}));
  EXPECT_EQ(boundary.pieces_at({0, 0}), (Pieces{0, 3}));
  // 1e-9 of the extent counts as on it; a distant continuation of a piece does not.
  EXPECT_EQ(boundary.pieces_at({.5, .2 + .9e-9}), Pieces{2});
  EXPECT_EQ(boundary.pieces_at({.5, .2 + 2e-9}), Pieces{});
  EXPECT_EQ(boundary.pieces_at({1.5, .2}), Pieces{});
}

TEST(Boundary, tolerates_the_rounding_of_coordinates_far_away) {
  // Points on an edge of a small part at 1e6: their own rounding is 1e-10.
  const auto boundary = rectangle({1e6, 1e6}, {1e6 + 1e-3, 1e6 + 1e-3});
  for (int i = 1; i < 10; ++i)
    EXPECT_EQ(boundary.pieces_at({1e6 + i * 1e-4, 1e6 + 1e-3}).size(), 1u);
}

TEST(Boundary, measures_distances_to_segments) {
  const auto boundary = rectangle({0, 0}, {1, .2});
  EXPECT_DOUBLE_EQ(boundary.distance({.5, .1}, 0), .1);
  EXPECT_DOUBLE_EQ(boundary.distance({4, 4}, 0), 5) << "from its end";
  EXPECT_DOUBLE_EQ(boundary.distance({-3, -4}, 0), 5) << "from its beginning";
}

} // namespace
