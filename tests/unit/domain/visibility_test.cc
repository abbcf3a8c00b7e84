// Who sees whom: holes hide nothing that is well resolved, slots do, and subdomains end where the view does.

#include "disc_and_domain.h"

#include "meshless/domain/visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace meshless::domain;
constexpr double pi = std::numbers::pi;

Boundary polygon(const std::vector<Point2> &corners) {
  std::vector<BoundaryPiece> pieces;
  for (std::size_t i = 0; i < corners.size(); ++i)
    pieces.push_back({corners[i], corners[(i + 1) % corners.size()], static_cast<int>(i)});
  return Boundary(pieces);
}

/// A unit square with a slot of this width from the top down to x2 = .5, in the middle.
Boundary slotted(double width) {
  const double a = .5 - width / 2, b = .5 + width / 2;
  return polygon({{0, 0}, {1, 0}, {1, 1}, {b, 1}, {b, .5}, {a, .5}, {a, 1}, {0, 1}});
}

Boundary l_shape() { return polygon({{0, 0}, {1, 0}, {1, .5}, {.5, .5}, {.5, 1}, {0, 1}}); }

Boundary quarter() {
  return Boundary({{{1, 0}, {3, 0}},
                   {{3, 0}, {3, 3}},
                   {{3, 3}, {0, 3}},
                   {{0, 3}, {0, 1}},
                   {{0, 1}, {1, 0}, 0, Arc{{0, 0}, false}}});
}

bool sees(const Boundary &boundary, const Point2 &x, const Point2 &y) {
  const Visibility visibility(boundary);
  View view(visibility);
  view.move_to(x, 1.001 * std::hypot(y[0] - x[0], y[1] - x[1]));
  return view.sees(y);
}

TEST(Visibility, nothing_is_looked_at_in_a_convex_domain) {
  const auto square = rectangle({0, 0}, {1, 1});
  EXPECT_TRUE(Visibility(square).convex());
  const Boundary disc({{{1, 0}, {-1, 0}, 0, Arc{{0, 0}, true}}, {{-1, 0}, {1, 0}, 0, Arc{{0, 0}, true}}});
  EXPECT_TRUE(Visibility(disc).convex());
  for (const auto &boundary : {slotted(.1), l_shape(), quarter()})
    EXPECT_FALSE(Visibility(boundary).convex());
  // Far from what is not convex the view is clear without a look.
  const auto l = l_shape();
  const Visibility visibility(l);
  View view(visibility);
  view.move_to({.1, .1}, .35);
  EXPECT_TRUE(view.clear());
  view.move_to({.45, .45}, .35);
  EXPECT_FALSE(view.clear());
}

TEST(Visibility, a_hole_hides_nothing_from_supports_of_four_spacings) {
  // 11 particles on the quarter of the edge, h = pi / 20.
  const auto boundary = quarter();
  const double h = pi / 20;
  const auto at = [](double r, int i) { return Point2{r * std::cos(pi / 20 * i), r * std::sin(pi / 20 * i)}; };
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      for (const double r : {1., 1 + h / 2, 1 + h}) {
        const auto x = at(1, i), y = at(r, j);
        if (std::hypot(x[0] - y[0], x[1] - y[1]) < 4 * h) {
          EXPECT_TRUE(sees(boundary, x, y)) << i << " " << j << " " << r;
          EXPECT_TRUE(sees(boundary, y, x)) << i << " " << j << " " << r;
        }
      }
}

TEST(Visibility, the_far_side_of_a_small_hole_is_hidden) {
  const Boundary boundary({{{-2, -2}, {2, -2}},
                           {{2, -2}, {2, 2}},
                           {{2, 2}, {-2, 2}},
                           {{-2, 2}, {-2, -2}},
                           {{.2, 0}, {-.2, 0}, 0, Arc{{0, 0}, false}},
                           {{-.2, 0}, {.2, 0}, 0, Arc{{0, 0}, false}}});
  // Ends of an arc of the angle a: a R over 2 R sin(a / 2) is 1.25 at a = 2.27 = 130 degrees.
  const auto at = [](double degrees) {
    return Point2{.2 * std::cos(degrees * pi / 180), .2 * std::sin(degrees * pi / 180)};
  };
  EXPECT_TRUE(sees(boundary, at(17), at(17 + 129)));
  EXPECT_FALSE(sees(boundary, at(17), at(17 + 131)));
  EXPECT_FALSE(sees(boundary, at(17), at(17 + 180)));
  EXPECT_TRUE(sees(boundary, {.2, -.5}, {.2, .5})) << "past it, on a tangent";
}

TEST(Visibility, faces_of_a_slot_of_any_width_are_hidden_from_each_other) {
  for (const double width : {1e-6, 1e-3, .02, .2}) {
    const auto boundary = slotted(width);
    const double a = .5 - width / 2, b = .5 + width / 2;
    for (const double height : {.13, .2, .3, 1., 2.}) { // above the end, in widths; .125 is the limit
      const double y = .5 + height * width;
      EXPECT_FALSE(sees(boundary, {a, y}, {b, y})) << width << " " << height;
      EXPECT_FALSE(sees(boundary, {b, y}, {a, y})) << width << " " << height;
    }
    EXPECT_TRUE(sees(boundary, {a, .5 + .12 * width}, {b, .5 + .12 * width})) << width;
    // Its own side, along the face and into the plate.
    EXPECT_TRUE(sees(boundary, {a, .8}, {a, .6}));
    EXPECT_TRUE(sees(boundary, {a, .8}, {a - .1, .7}));
    EXPECT_FALSE(sees(boundary, {a - .05, .8}, {b + .05, .8}));
    EXPECT_TRUE(sees(boundary, {a - .05, .45}, {b + .05, .45})) << "below the slot";
  }
}

TEST(Visibility, at_a_reentrant_corner_only_faces_at_like_distances_are_hidden) {
  const auto boundary = l_shape();
  // (1 + q) / sqrt(1 + q^2) = 1.25 at q = .308, the ratio of the distances from the corner (.5, .5).
  EXPECT_FALSE(sees(boundary, {.7, .5}, {.5, .7}));
  EXPECT_FALSE(sees(boundary, {.7, .5}, {.5, .5 + .32 * .2}));
  EXPECT_TRUE(sees(boundary, {.7, .5}, {.5, .5 + .3 * .2}));
  EXPECT_TRUE(sees(boundary, {.7, .5}, {.4, .5})) << "along the face and on";
  EXPECT_TRUE(sees(boundary, {.7, .4}, {.4, .7})) << "almost past the corner";
}

void check_identity(const Boundary &boundary, const Point2 &centre, double radius) {
  SCOPED_TRACE(testing::Message() << "disc at (" << centre[0] << ", " << centre[1] << "), radius " << radius);
  const Visibility visibility(boundary);
  SubdomainQuadrature quadrature;
  SubdomainRule(boundary, 10, &visibility).build(centre, radius, quadrature, {.circle = true});
  const auto defect = disc_and_domain::divergence_defect(quadrature, centre, radius);
  // Where a circle touches a piece, a chord of 1e-6 radii is neglected, or kept but replaced by an arc: second order.
  EXPECT_LT(std::hypot(defect[0], defect[1]), 1e-10 * radius);
  // The area once more, from the edge alone: int x1 n1.
  double from_edge = 0;
  for (std::size_t q = 0; q < quadrature.boundary_JxW.size(); ++q)
    from_edge +=
        quadrature.boundary_JxW[q] * (quadrature.boundary_point[0][q] - centre[0]) * quadrature.boundary_normal[0][q];
  EXPECT_NEAR(disc_and_domain::moment(quadrature, centre, radius, 0, 0), from_edge, 1e-10 * radius * radius);
}

TEST(Visibility, subdomains_keep_the_divergence_theorem_where_the_view_ends) {
  for (const double radius : {.1, .2})
    for (const double y : {.42, .5, .56, .62, .8, 1.})
      for (const double x : {.2, .4, .45, .49, .51, .55, .6, .8}) {
        const auto boundary = slotted(.02);
        if (boundary.contains({x, y}) || !boundary.pieces_at({x, y}).empty())
          check_identity(boundary, {x, y}, radius);
        const auto l = l_shape();
        // A particle this close to an edge, not on it, needs a shrunk subdomain.
        if (x != .49 && (l.contains({x, y}) || !l.pieces_at({x, y}).empty()))
          check_identity(l, {x, y}, radius);
      }
}

TEST(Visibility, a_subdomain_on_a_face_of_a_slot_has_its_own_side_alone) {
  const auto boundary = slotted(.02);
  const Visibility visibility(boundary);
  SubdomainQuadrature quadrature;
  SubdomainRule rule(boundary, 10, &visibility);
  rule.build({.49, .8}, .1, quadrature, {.circle = true});
  EXPECT_NEAR(disc_and_domain::moment(quadrature, {.49, .8}, .1, 0, 0), pi / 2 * .01, 1e-14);
  for (const double x : quadrature.point[0])
    EXPECT_LT(x, .49);
  for (const double x : quadrature.boundary_point[0])
    EXPECT_LT(x, .49 + 1e-12) << "not the other face";
  // At the end of the slot the disc reaches around it: cuts appear.
  rule.build({.49, .53}, .1, quadrature, {.circle = true});
  bool cut = false;
  for (const auto &part : quadrature.parts)
    cut = cut || part.kind == SubdomainQuadrature::PartKind::cut;
  EXPECT_TRUE(cut);
}

} // namespace
