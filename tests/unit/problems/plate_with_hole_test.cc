// The quarter plate's discretisations, and that the shipped clouds are what the generator makes.

#include "comparisons/benchmarks/plate_with_hole/quarter_plate.h"
#include "comparisons/benchmarks/plate_with_hole/shipped_clouds.h"
#include "comparisons/problems/cloud_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace {

using namespace comparisons::benchmarks::plate_with_hole;
using comparisons::problems::Point2;

constexpr QuarterPlate paper{};
constexpr QuarterPlate oblong{.5, 4, 2.5};

double area_of(const QuarterPlate &plate) {
  return plate.half_length * plate.half_width - .25 * std::numbers::pi * plate.radius * plate.radius;
}

TEST(QuarterPlate, quadrature_integrates_over_the_exact_plate) {
  for (const auto &plate : {paper, oblong}) {
    const auto rule = quadrature(plate, 16);
    double area = 0;
    double moment = 0;
    double inverse = 0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto [x, y] = rule.points[q];
      EXPECT_GE(std::hypot(x, y), plate.radius);
      area += rule.weights[q];
      moment += rule.weights[q] * x * y * y;
      inverse += rule.weights[q] / std::pow(x * x + y * y, 2);
    }
    const double b = plate.radius;
    const double l = plate.half_length;
    const double w = plate.half_width;
    // integral of x y^2 over the rectangle, less that over the quarter disc, b^5 / 15. Smooth integrands: rounding.
    EXPECT_NEAR(area, area_of(plate), 1e-12 * area_of(plate));
    EXPECT_NEAR(moment, l * l * w * w * w / 6 - std::pow(b, 5) / 15, 1e-12 * moment);
    // 1 / r^4 in polar coordinates: integral of (1/b^2 - 1/R(theta)^2) / 2, R the outer edge.
    const double corner = std::atan2(w, l);
    const double outer = (.5 * corner + .25 * std::sin(2 * corner)) / (l * l) +
                         (.5 * (.5 * std::numbers::pi - corner) + .25 * std::sin(2 * corner)) / (w * w);
    EXPECT_NEAR(inverse, .5 * (.5 * std::numbers::pi / (b * b) - outer), 1e-10 * inverse);
  }
}

TEST(QuarterPlate, mesh_covers_the_plate_with_about_the_vertices_asked_for) {
  for (const std::size_t n : {20u, 188u, 686u, 2600u, 20000u}) {
    const auto m = mesh(paper, blocks_of(n));
    EXPECT_NEAR(double(m.vertices.size()), double(n), .05 * double(n) + 2);
    double area = 0;
    for (const auto &cell : m.cells) {
      double own = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const Point2 &a = m.vertices[cell.vertices[k]];
        const Point2 &b = m.vertices[cell.vertices[(k + 1) % 4]];
        own += .5 * (a[0] * b[1] - a[1] * b[0]);
      }
      EXPECT_GT(own, 0) << "counter-clockwise";
      area += own;
    }
    // With straight edges at the hole: the chords' segments are missing.
    const double turn = .25 * std::numbers::pi / blocks_of(n).n_around;
    EXPECT_NEAR(area, area_of(paper) + .25 * std::numbers::pi - blocks_of(n).n_around * std::sin(turn), 1e-12);
    std::size_t n_arcs = 0;
    for (const auto &edge : m.boundary) {
      const Point2 &a = m.vertices[edge.vertices[0]];
      const Point2 &b = m.vertices[edge.vertices[1]];
      switch (edge.id) {
      case x1_axis:
        EXPECT_TRUE(a[1] == 0 && b[1] == 0);
        break;
      case x2_axis:
        EXPECT_TRUE(a[0] == 0 && b[0] == 0);
        break;
      case right:
        EXPECT_TRUE(a[0] == 3 && b[0] == 3);
        break;
      case top:
        EXPECT_TRUE(a[1] == 3 && b[1] == 3);
        break;
      default:
        EXPECT_EQ(edge.id, hole);
        EXPECT_TRUE(edge.arc_centre.has_value());
        EXPECT_NEAR(std::hypot(a[0], a[1]), 1, 1e-15);
        ++n_arcs;
      }
    }
    EXPECT_EQ(int(n_arcs), 2 * blocks_of(n).n_around);
  }
}

TEST(QuarterPlate, clouds_have_the_papers_numbers_on_the_hole) {
  EXPECT_EQ(n_on_hole(188), 11u);
  EXPECT_EQ(n_on_hole(686), 21u);
  for (const auto &plate : {paper, oblong}) {
    const auto cloud = generated_cloud(plate, 300, 0, 4);
    EXPECT_EQ(cloud.positions.size(), 300u);
    const auto n = std::count_if(cloud.positions.begin(), cloud.positions.end(), [&](const Point2 &x) {
      return std::abs(std::hypot(x[0], x[1]) - plate.radius) < 1e-12;
    });
    EXPECT_EQ(std::size_t(n), n_on_hole(300));
  }
  // By a spacing: quarter circle 1.571 / .05 = 31 intervals.
  const auto cloud = generated_cloud(paper, 0, .05, 4);
  EXPECT_EQ(std::count_if(cloud.positions.begin(), cloud.positions.end(),
                          [](const Point2 &x) { return std::abs(std::hypot(x[0], x[1]) - 1) < 1e-12; }),
            32);
}

/// Also the way to make them: the files are written to <build folder>/meshes.
TEST(ShippedClouds, are_what_the_generator_makes) {
  const auto folder = std::filesystem::path(PETROV_BINARY_DIR) / "meshes";
  std::filesystem::create_directories(folder);
  for (const std::size_t n : shipped_sizes) {
    const auto made = generated_cloud(paper, n, 0, shipped_seed);
    std::ofstream(folder / shipped_name(n)) << comparisons::problems::cloud_csv(
        made, "quarter plate with a hole, see README.md; x, y and the mean distance h of the 4 nearest, in m");
    const auto shipped = shipped_cloud(n);
    ASSERT_EQ(shipped.positions.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      // Rounding, of the sine for instance, grows a thousandfold in the relaxation at most.
      EXPECT_NEAR(shipped.positions[i][0], made.positions[i][0], 1e-12) << n << ", particle " << i;
      EXPECT_NEAR(shipped.positions[i][1], made.positions[i][1], 1e-12) << n << ", particle " << i;
      EXPECT_NEAR(shipped.spacing[i], made.spacing[i], 1e-12) << n << ", particle " << i;
    }
  }
}

} // namespace
