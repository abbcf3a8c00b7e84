// Quadrature of discs cut by polygons: area, moments, boundary parts, and the divergence theorem
// for the test function, which patch tests of the weak forms rest on.

#include "disc_and_polygon.h"

#include "meshless/domain/local_subdomain.h"
#include "meshless/kernels/gauss.h"
#include "unit/cloud/sample_clouds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace meshless::domain;

constexpr int nG = 10;

/// Integral of x^a y^b from the centre in units of the radius, m^2.
double moment_of(const SubdomainQuadrature &quadrature, const Point2 &centre, double radius, int a, int b) {
  double sum = 0;
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q)
    sum += quadrature.JxW[q] * disc_and_polygon::power((quadrature.point[0][q] - centre[0]) / radius, a) *
           disc_and_polygon::power((quadrature.point[1][q] - centre[1]) / radius, b);
  return sum;
}

/// int W,j - boundary int W n_j for the Gauss test function with the disc as support, in metres.
Point2 divergence_defect(const SubdomainQuadrature &quadrature, const Point2 &centre, double radius) {
  const meshless::kernels::Gauss kernel(1);
  const auto offset = [&](const auto &points, std::size_t q) {
    return Point2{(points[0][q] - centre[0]) / radius, (points[1][q] - centre[1]) / radius};
  };
  Point2 defect{};
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q) {
    const auto d = offset(quadrature.point, q);
    const double slope = kernel.slope(d[0] * d[0] + d[1] * d[1]) / radius;
    for (int k = 0; k < 2; ++k)
      defect[k] += quadrature.JxW[q] * slope * d[k];
  }
  for (const auto &part : quadrature.parts)
    for (std::size_t q = part.begin; q < part.end; ++q) {
      const auto d = offset(quadrature.boundary_point, q);
      for (int k = 0; k < 2; ++k)
        defect[k] -=
            quadrature.boundary_JxW[q] * kernel.value(d[0] * d[0] + d[1] * d[1]) * quadrature.boundary_normal[k][q];
    }
  return defect;
}

/// Everything that must hold for the rule of one disc.
void check(const SubdomainQuadrature &quadrature, const Boundary &boundary, const Point2 &centre, double radius) {
  SCOPED_TRACE(testing::Message() << "disc at (" << centre[0] << ", " << centre[1] << "), radius " << radius);
  const double area = std::numbers::pi * radius * radius;
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q) {
    const Point2 x{quadrature.point[0][q], quadrature.point[1][q]};
    ASSERT_GT(quadrature.JxW[q], 0);
    ASSERT_LE(std::hypot(x[0] - centre[0], x[1] - centre[1]), radius * (1 + 1e-15));
    // Where the circle touches an edge a few points of no weight may lie on it.
    ASSERT_TRUE(quadrature.JxW[q] < 1e-15 * area || disc_and_polygon::inside(boundary.pieces(), x));
  }
  // The distance to an edge is c / cos(angle), which 40 Gauss points between two break points
  // integrate to 1e-12 as long as no centre is closer to an edge than a quarter of the radius.
  for (const auto &[a, b] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 4}})
    EXPECT_NEAR(moment_of(quadrature, centre, radius, a, b),
                disc_and_polygon::moment(boundary.pieces(), centre, radius, a, b), 1e-11 * area)
        << a << " " << b;
  // Both sides are discrete: what is left is the difference of their errors, 1e-12 by the same token.
  const auto defect = divergence_defect(quadrature, centre, radius);
  EXPECT_LT(std::hypot(defect[0], defect[1]), 1e-11 * radius);

  double length = 0;
  for (const auto &piece : boundary.pieces()) {
    const auto [begin, end] = disc_and_polygon::inside_disc(piece, centre, radius);
    length += (end - begin) * piece.length();
  }
  for (const double JxW : quadrature.boundary_JxW)
    length -= JxW;
  EXPECT_NEAR(length, 0, 2e-6 * radius); // chords of circles that touch: up to 1e-6 radii each
}

void check(const Boundary &boundary, const Point2 &centre, double radius) {
  SubdomainQuadrature quadrature;
  SubdomainRule(boundary, nG).build(centre, radius, quadrature);
  check(quadrature, boundary, centre, radius);
}

/// The rule of an ellipse, stretched to that of a disc in a stretched domain.
void check_stretched(const Boundary &boundary, const Point2 &centre, const Ellipse &shape) {
  SubdomainQuadrature quadrature;
  SubdomainRule(boundary, nG).build(centre, shape, quadrature);
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q) {
    const auto x = shape.stretched({quadrature.point[0][q], quadrature.point[1][q]});
    for (int k = 0; k < 2; ++k)
      quadrature.point[k][q] = x[k];
    quadrature.JxW[q] *= shape.aspect();
  }
  for (std::size_t q = 0; q < quadrature.boundary_JxW.size(); ++q) {
    const auto x = shape.stretched({quadrature.boundary_point[0][q], quadrature.boundary_point[1][q]});
    const auto n = shape.compressed({quadrature.boundary_normal[0][q], quadrature.boundary_normal[1][q]});
    const double length = std::hypot(n[0], n[1]);
    for (int k = 0; k < 2; ++k) {
      quadrature.boundary_point[k][q] = x[k];
      quadrature.boundary_normal[k][q] = n[k] / length;
    }
    quadrature.boundary_JxW[q] *= length * shape.aspect();
  }
  std::vector<BoundaryPiece> pieces;
  for (const auto &piece : boundary.pieces())
    pieces.push_back({shape.stretched(piece.begin), shape.stretched(piece.end), piece.id});
  check(quadrature, Boundary(pieces), shape.stretched(centre), shape.radius);
}

Boundary polygon(const std::vector<Point2> &corners) {
  std::vector<BoundaryPiece> pieces;
  for (std::size_t i = 0; i < corners.size(); ++i)
    pieces.push_back({corners[i], corners[(i + 1) % corners.size()], static_cast<int>(i)});
  return Boundary(pieces);
}

/// A slit from the top, narrower than the discs: their rays leave the domain and come back.
Boundary notched() { return polygon({{0, 0}, {1, 0}, {1, .6}, {.53, .6}, {.5, .25}, {.47, .6}, {0, .6}}); }

Boundary l_shape() { return polygon({{0, 0}, {1, 0}, {1, .5}, {.5, .5}, {.5, 1}, {0, 1}}); }

Boundary with_hole() {
  const auto outside = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const auto hole = polygon({{.45, .45}, {.45, .55}, {.55, .55}, {.55, .45}}); // clockwise
  std::vector<BoundaryPiece> pieces(outside.pieces().begin(), outside.pieces().end());
  pieces.insert(pieces.end(), hole.pieces().begin(), hole.pieces().end());
  return Boundary(pieces);
}

TEST(LocalSubdomain, whole_disc) {
  SubdomainQuadrature quadrature;
  const auto boundary = rectangle({-5, -5}, {5, 5});
  SubdomainRule(boundary, nG).build({1, 2}, .5, quadrature);
  EXPECT_TRUE(quadrature.whole);
  EXPECT_EQ(quadrature.JxW.size(), static_cast<std::size_t>(4 * nG * nG));
  EXPECT_TRUE(quadrature.parts.empty());
  check(boundary, {1, 2}, .5);
}

TEST(LocalSubdomain, cantilever_of_uniform_particles) {
  // Circles touch edges and pass through corners.
  for (const auto &x : sample_clouds::grid<2>({16, 4}, {0, 0}, {1, .2}))
    check(rectangle({0, 0}, {1, .2}), x, 1. / 15);
}

TEST(LocalSubdomain, cantilever_of_jittered_particles) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const auto &x : sample_clouds::jittered_grid<2>({16, 4}, {0, 0}, {1, .2}, .25, seed))
      check(rectangle({0, 0}, {1, .2}), x, 1. / 15);
}

class ConcaveDomain : public testing::TestWithParam<std::pair<const char *, Boundary>> {};
INSTANTIATE_TEST_SUITE_P(Domains, ConcaveDomain,
                         testing::Values(std::pair{"notch", notched()}, std::pair{"l_shape", l_shape()},
                                         std::pair{"hole", with_hole()}),
                         [](const auto &instance) { return std::string(instance.param.first); });

TEST_P(ConcaveDomain, discs_around_grid_points_and_corners) {
  const auto &boundary = GetParam().second;
  for (const double radius : {.1, .25, .45})
    for (const auto &x : sample_clouds::grid<2>({11, 11}, {0, 0}, {1, 1}))
      if (boundary.contains(x) || !boundary.pieces_at(x).empty())
        check(boundary, x, radius);
  for (const auto &piece : boundary.pieces())
    check(boundary, piece.begin, .3);
}

TEST_P(ConcaveDomain, discs_anywhere) {
  const auto &boundary = GetParam().second;
  for (const double radius : {.1, .25, .45})
    for (const auto &x : sample_clouds::random_points<2>(60, {0, 0}, {1, 1}, 5)) {
      bool close = false;
      for (std::size_t i = 0; i < boundary.pieces().size(); ++i)
        close = close || boundary.distance(x, i) < .25 * radius;
      if (boundary.contains(x) && !close)
        check(boundary, x, radius);
    }
}

TEST_P(ConcaveDomain, ellipses_are_discs_of_a_stretched_domain) {
  const auto &boundary = GetParam().second;
  for (const Point2 &flattening : {Point2{0, 1}, {1.5, -1}, {3, 2}}) {
    const Ellipse shape(.3, flattening);
    for (const auto &x : sample_clouds::random_points<2>(60, {0, 0}, {1, 1}, 6)) {
      bool close = false; // to an edge, in the stretched domain
      for (const auto &piece : boundary.pieces()) {
        const BoundaryPiece stretched{shape.stretched(piece.begin), shape.stretched(piece.end), 0};
        close = close || stretched.distance(shape.stretched(x)) < .25 * shape.radius;
      }
      if (boundary.contains(x) && !close)
        check_stretched(boundary, x, shape);
    }
    for (const auto &piece : boundary.pieces())
      check_stretched(boundary, piece.begin, shape);
  }
}

TEST(LocalSubdomain, the_edge_of_an_ellipse_is_refused) {
  const auto boundary = rectangle({-5, -5}, {5, 5});
  SubdomainQuadrature quadrature;
  EXPECT_THROW(SubdomainRule(boundary, nG).build({1, 2}, {.5, {1, 0}}, quadrature, {.circle = true}),
               std::invalid_argument);
}

TEST(LocalSubdomain, several_intervals_on_one_ray) {
  // Left of the slit, looking through it: the disc has a part on the other side.
  const auto boundary = notched();
  const Point2 centre{.4, .45};
  SubdomainQuadrature quadrature;
  SubdomainRule(boundary, nG).build(centre, .2, quadrature);
  double beyond = 0;
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q)
    beyond += quadrature.point[0][q] > .5 ? quadrature.JxW[q] : 0;
  EXPECT_GT(beyond, .01 * std::numbers::pi * .04);
  check(boundary, centre, .2);
}

TEST(LocalSubdomain, boundary_parts_carry_id_and_normal) {
  const auto boundary = rectangle({0, 0}, {1, .2});
  SubdomainQuadrature quadrature;
  SubdomainRule(boundary, nG).build({1, .2}, .05, quadrature); // north-east corner
  ASSERT_EQ(quadrature.parts.size(), 2u);
  for (const auto &part : quadrature.parts) {
    const bool right = part.id == 1;
    EXPECT_TRUE(right || part.id == 3);
    double length = 0;
    for (std::size_t q = part.begin; q < part.end; ++q) {
      EXPECT_DOUBLE_EQ(quadrature.boundary_point[right ? 0 : 1][q], right ? 1 : .2);
      EXPECT_DOUBLE_EQ(quadrature.boundary_normal[right ? 0 : 1][q], 1);
      length += quadrature.boundary_JxW[q];
    }
    EXPECT_NEAR(length, .05, 1e-15);
  }
  // On an edge the piece is split at the particle.
  SubdomainRule(boundary, nG).build({.5, .2}, .05, quadrature);
  ASSERT_EQ(quadrature.parts.size(), 2u);
  EXPECT_EQ(quadrature.parts[1].end, static_cast<std::size_t>(2 * nG));
  for (std::size_t q = 0; q < 2 * nG; ++q)
    EXPECT_EQ(quadrature.boundary_point[0][q] > .5, q < nG) << "the top runs from right to left";
}

TEST(LocalSubdomain, every_wedge_has_enough_points) {
  // The batch of a corner: one wedge of a quarter turn.
  SubdomainQuadrature quadrature;
  for (const int n : {1, 2, 5}) {
    const auto boundary = rectangle({0, 0}, {1, 1});
    SubdomainRule(boundary, n).build({0, 0}, .1, quadrature);
    EXPECT_GE(quadrature.JxW.size(), static_cast<std::size_t>(n * n));
    EXPECT_FALSE(quadrature.whole);
  }
}

TEST(LocalSubdomain, shifted_far_away_loses_only_the_rounding_of_coordinates) {
  // Coordinates of 1e6 round by 1e-10: 2e-9 of the radius.
  const double far = 1e6;
  const auto boundary = rectangle({far, far}, {far + 1, far + .2});
  SubdomainQuadrature quadrature;
  for (const auto &x : sample_clouds::jittered_grid<2>({16, 4}, {0, 0}, {1, .2}, .25, 4)) {
    const Point2 centre{far + x[0], far + x[1]};
    SubdomainRule(boundary, nG).build(centre, 1. / 15, quadrature);
    const auto defect = divergence_defect(quadrature, centre, 1. / 15);
    EXPECT_LT(std::hypot(defect[0], defect[1]), 2e-8 / 15) << x[0] << " " << x[1];
  }
}

TEST(LocalSubdomain, storage_can_be_reused) {
  const auto boundary = rectangle({0, 0}, {1, .2});
  SubdomainRule rule(boundary, nG);
  SubdomainQuadrature fresh;
  SubdomainQuadrature reused;
  rule.build({0, 0}, .1, fresh);
  rule.build({.5, .1}, .15, reused);
  rule.build({0, 0}, .1, reused);
  EXPECT_EQ(reused.JxW, fresh.JxW);
  EXPECT_EQ(reused.boundary_JxW, fresh.boundary_JxW);
  EXPECT_EQ(reused.parts.size(), fresh.parts.size());
  rule.build({.5, .1}, .05, reused);
  EXPECT_TRUE(reused.whole);
  EXPECT_TRUE(reused.boundary_JxW.empty());
}

TEST(LocalSubdomain, needs_a_quadrature_point) {
  const auto boundary = rectangle({0, 0}, {1, 1});
  EXPECT_THROW(SubdomainRule(boundary, 0), std::invalid_argument);
}

} // namespace
