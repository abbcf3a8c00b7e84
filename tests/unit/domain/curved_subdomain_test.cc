// Quadrature of discs cut by arcs, by arcs and lines, and by polylines: area, moments, and the divergence theorem
// for the test function, inside and on the circle.

#include "disc_and_domain.h"

#include "unit/cloud/sample_clouds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace meshless::domain;

constexpr double pi = std::numbers::pi;
constexpr int nG = 10;

struct Shape {
  const char *name;
  Boundary boundary;
  disc_and_domain::Inside inside;
};

double r_of(const Point2 &x) { return std::hypot(x[0], x[1]); }

/// Between the radii 1 and 2.
Shape ring() {
  const auto at = [](double r, double a) { return Point2{r * std::cos(a), r * std::sin(a)}; };
  std::vector<BoundaryPiece> pieces;
  const double angles[] = {0.3, 2.0, 4.5};
  for (int k = 0; k < 3; ++k)
    pieces.push_back({at(2, angles[k]), at(2, angles[(k + 1) % 3]), 0, Arc{{0, 0}, true}});
  for (int k = 2; k >= 0; --k)
    pieces.push_back({at(1, angles[(k + 1) % 3]), at(1, angles[k]), 1, Arc{{0, 0}, false}});
  return {"ring", Boundary(pieces), [](const Point2 &x) { return r_of(x) > 1 && r_of(x) < 2; }};
}

/// Quarter of a plate of edge 3 with a hole of radius 1: corners between an arc and a line.
Shape quarter() {
  return {"quarter",
          Boundary({{{1, 0}, {3, 0}},
                    {{3, 0}, {3, 3}},
                    {{3, 3}, {0, 3}},
                    {{0, 3}, {0, 1}},
                    {{0, 1}, {1, 0}, 0, Arc{{0, 0}, false}}}),
          [](const Point2 &x) { return x[0] > 0 && x[1] > 0 && x[0] < 3 && x[1] < 3 && r_of(x) > 1; }};
}

/// An L whose re-entrant corner has a fillet of radius .5, tangent to both edges, and a round end.
Shape fillet() {
  return {"fillet",
          Boundary({{{0, 0}, {3, 0}},
                    {{3, 0}, {3, 1}, 0, Arc{{3, .5}, true}},
                    {{3, 1}, {1.5, 1}},
                    {{1.5, 1}, {1, 1.5}, 0, Arc{{1.5, 1.5}, false}},
                    {{1, 1.5}, {1, 3}},
                    {{1, 3}, {0, 3}},
                    {{0, 3}, {0, 0}}}),
          [](const Point2 &x) {
            const bool bar = x[1] > 0 && x[1] < 1 && x[0] > 0 && (x[0] < 3 || std::hypot(x[0] - 3, x[1] - .5) < .5);
            const bool leg = x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 3;
            const bool corner =
                x[0] > .9 && x[1] > .9 && x[0] < 1.5 && x[1] < 1.5 && std::hypot(x[0] - 1.5, x[1] - 1.5) > .5;
            return bar || leg || corner;
          }};
}

/// A square with a hole that a mesh would make of a circle: a polygon of 24 corners.
Shape polygonal_hole() {
  std::vector<BoundaryPiece> pieces{{{-2, -2}, {2, -2}}, {{2, -2}, {2, 2}}, {{2, 2}, {-2, 2}}, {{-2, 2}, {-2, -2}}};
  std::vector<Point2> corners;
  for (int i = 0; i < 24; ++i)
    corners.push_back({std::cos(pi / 12 * i), std::sin(pi / 12 * i)});
  for (std::size_t i = 24; i > 0; --i)
    pieces.push_back({corners[i % 24], corners[i - 1]});
  const std::vector<BoundaryPiece> all = pieces;
  return {"polygonal_hole", Boundary(pieces), [all](const Point2 &x) { return disc_and_polygon::inside(all, x); }};
}

/// A plate with a hole that fits into one disc.
Shape small_hole() {
  return {"small_hole",
          Boundary({{{-2, -2}, {2, -2}},
                    {{2, -2}, {2, 2}},
                    {{2, 2}, {-2, 2}},
                    {{-2, 2}, {-2, -2}},
                    {{.2, 0}, {-.2, 0}, 0, Arc{{0, 0}, false}},
                    {{-.2, 0}, {.2, 0}, 0, Arc{{0, 0}, false}}}),
          [](const Point2 &x) { return std::abs(x[0]) < 2 && std::abs(x[1]) < 2 && r_of(x) > .2; }};
}

void check(const Shape &shape, const Point2 &centre, double radius) {
  SCOPED_TRACE(testing::Message() << "disc at (" << centre[0] << ", " << centre[1] << "), radius " << radius);
  SubdomainQuadrature quadrature;
  SubdomainRule(shape.boundary, nG).build(centre, radius, quadrature, {.circle = true});
  const double area = pi * radius * radius;
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q) {
    ASSERT_GE(quadrature.JxW[q], 0);
    ASSERT_LE(std::hypot(quadrature.point[0][q] - centre[0], quadrature.point[1][q] - centre[1]), radius * (1 + 1e-15));
  }
  for (const auto &[a, b] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 4}})
    EXPECT_NEAR(disc_and_domain::moment(quadrature, centre, radius, a, b),
                disc_and_domain::moment(shape.boundary, shape.inside, centre, radius, a, b), 1e-10 * area)
        << a << " " << b;
  const auto defect = disc_and_domain::divergence_defect(quadrature, centre, radius);
  EXPECT_LT(std::hypot(defect[0], defect[1]), 1e-10 * radius);
}

class CurvedDomain : public testing::TestWithParam<Shape (*)()> {};
INSTANTIATE_TEST_SUITE_P(Domains, CurvedDomain, testing::Values(ring, quarter, fillet, polygonal_hole, small_hole),
                         [](const auto &instance) { return std::string(instance.param().name); });

TEST_P(CurvedDomain, discs_around_points_of_the_boundary) {
  const auto shape = GetParam()();
  const auto pieces = shape.boundary.pieces();
  for (const double radius : {.15, .45})
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (const double t : {0., .5, .93}) {
        const auto x = pieces[i].point(t);
        bool close = false; // to another piece, which it is not on
        for (std::size_t k = 0; k < pieces.size(); ++k) {
          const double d = shape.boundary.distance(x, k);
          close = close || (d > 1e-12 && d < .25 * radius);
        }
        if (!close)
          check(shape, x, radius);
      }
}

TEST_P(CurvedDomain, discs_anywhere) {
  const auto shape = GetParam()();
  for (const double radius : {.15, .45})
    for (const auto &x : sample_clouds::random_points<2>(40, shape.boundary.lower(), shape.boundary.upper(), 5))
      if (shape.inside(x) && shape.boundary.distance(x) >= .25 * radius && shape.boundary.distance(x) < radius)
        check(shape, x, radius);
}

/// Every arc as chords of `step` radians.
Boundary with_chords(const Boundary &boundary, double step) {
  std::vector<BoundaryPiece> pieces;
  for (const auto &piece : boundary.pieces()) {
    const int n = piece.arc ? static_cast<int>(std::ceil(piece.sweep() / step)) : 1;
    for (int i = 0; i < n; ++i)
      pieces.push_back({i == 0 ? piece.begin : piece.point(static_cast<double>(i) / n),
                        i + 1 == n ? piece.end : piece.point(static_cast<double>(i + 1) / n), piece.id});
  }
  return Boundary(pieces);
}

TEST_P(CurvedDomain, ellipses_anywhere) {
  // int W,j is the boundary's int W n_j, and the area that of the domain with chords in place of arcs, which have been
  // checked: up to the segments between the two, step^2 / 12 of the sector that the disc holds at most.
  constexpr double step = 1e-2;
  const meshless::kernels::Gauss kernel(1);
  const auto shape = GetParam()();
  const auto polygon = with_chords(shape.boundary, step);
  for (const Point2 &f : {Point2{0, 1.5}, {2, 1}}) {
    const Ellipse ellipse(.45, f);
    const double area = pi * ellipse.radius * ellipse.radius / ellipse.aspect();
    for (const auto &centre : sample_clouds::random_points<2>(40, shape.boundary.lower(), shape.boundary.upper(), 5)) {
      const double distance = shape.boundary.distance(centre);
      if (!shape.inside(centre) || distance < .25 * ellipse.radius || distance >= ellipse.radius)
        continue;
      SCOPED_TRACE(testing::Message() << "ellipse at (" << centre[0] << ", " << centre[1] << ")");
      SubdomainQuadrature quadrature, chords;
      SubdomainRule(shape.boundary, nG).build(centre, ellipse, quadrature);
      SubdomainRule(polygon, nG).build(centre, ellipse, chords);
      const auto squared = [&](const Point2 &d) {
        const double along = f[0] * d[0] + f[1] * d[1];
        return (d[0] * d[0] + d[1] * d[1] + along * along) / (ellipse.radius * ellipse.radius);
      };
      Point2 defect{};
      double difference = 0;
      for (std::size_t q = 0; q < quadrature.JxW.size(); ++q) {
        const Point2 d{quadrature.point[0][q] - centre[0], quadrature.point[1][q] - centre[1]};
        ASSERT_LE(squared(d), 1 + 1e-12);
        const double along = f[0] * d[0] + f[1] * d[1];
        const double slope = kernel.slope(squared(d)) / (ellipse.radius * ellipse.radius);
        for (int k = 0; k < 2; ++k)
          defect[k] += quadrature.JxW[q] * slope * (d[k] + along * f[k]);
        difference += quadrature.JxW[q];
      }
      for (std::size_t q = 0; q < quadrature.boundary_JxW.size(); ++q) {
        const Point2 d{quadrature.boundary_point[0][q] - centre[0], quadrature.boundary_point[1][q] - centre[1]};
        for (int k = 0; k < 2; ++k)
          defect[k] -= quadrature.boundary_JxW[q] * kernel.value(squared(d)) * quadrature.boundary_normal[k][q];
      }
      EXPECT_LT(std::hypot(defect[0], defect[1]), 1e-10 * ellipse.radius);
      for (const double JxW : chords.JxW)
        difference -= JxW;
      EXPECT_NEAR(difference, 0, step * step * area);
    }
  }
}

TEST(CurvedSubdomain, tangents_at_every_distance_from_the_end_of_a_wedge) {
  // The tangent point of a hole passes through the circle of the disc: d^2 = R^2 + radius^2.
  const auto shape = quarter();
  for (const double length : {.5, .9, .99, .9999, 1., 1.0001, 1.01, 1.1, 1.5}) {
    const double radius = .4;
    const double d = std::hypot(1, length * radius);
    if (d - 1 >= .25 * radius || length >= 1)
      check(shape, {d * std::cos(.7), d * std::sin(.7)}, radius);
  }
}

TEST(CurvedSubdomain, normals_point_out_of_the_domain) {
  SubdomainQuadrature quadrature;
  SubdomainRule(ring().boundary, nG).build({std::cos(1.), std::sin(1.)}, .3, quadrature);
  ASSERT_EQ(quadrature.parts.size(), 2u) << "split at the particle";
  for (const auto &part : quadrature.parts)
    EXPECT_EQ(part.id, 1);
  for (std::size_t q = 0; q < quadrature.boundary_JxW.size(); ++q)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(quadrature.boundary_normal[k][q], -quadrature.boundary_point[k][q], 1e-14) << "of a hole of radius 1";
}

TEST(CurvedSubdomain, the_circle_is_complete_around_a_small_hole) {
  SubdomainQuadrature quadrature;
  SubdomainRule(small_hole().boundary, nG).build({.3, 0}, .6, quadrature, {.interior = false, .circle = true});
  EXPECT_TRUE(quadrature.JxW.empty());
  double circle = 0;
  double hole = 0;
  for (const auto &part : quadrature.parts)
    for (std::size_t q = part.begin; q < part.end; ++q)
      (part.kind == SubdomainQuadrature::PartKind::circle ? circle : hole) += quadrature.boundary_JxW[q];
  EXPECT_NEAR(circle, 2 * pi * .6, 1e-14);
  EXPECT_NEAR(hole, 2 * pi * .2, 1e-14);
}

} // namespace
