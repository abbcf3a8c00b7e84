// Generated clouds: counts, particles on or inside the boundary, even distances that follow the wanted spacing, holes,
// several regions, thin slots, determinism, refusals, jitter.

#include "meshless/cloud/point_tree.h"
#include "meshless/cloud_generation/generator.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

namespace {

using namespace meshless::cloud_generation;
using meshless::cloud::Index;
using meshless::domain::Arc;
using meshless::domain::Boundary;
using meshless::domain::BoundaryPiece;
using refusal::mentions;
using refusal::message_of;

SpacingField constant(double s) {
  return [s](auto, auto values) { std::fill(values.begin(), values.end(), s); };
}

template <typename F>
SpacingField field(F s) {
  return [s](std::span<const Point2> x, std::span<double> values) {
    for (std::size_t i = 0; i < x.size(); ++i)
      values[i] = s(x[i]);
  };
}

/// Quarter of a plate of side 3 with a hole of radius 1 (id 2).
Boundary quarter_plate() {
  return Boundary({{{1, 0}, {3, 0}, 3},
                   {{3, 0}, {3, 3}, 4},
                   {{3, 3}, {0, 3}, 5},
                   {{0, 3}, {0, 1}, 1},
                   {{0, 1}, {1, 0}, 2, Arc{{0, 0}, false}}});
}

CloudRequest plate_request(std::size_t n, std::size_t n_arc, std::uint64_t seed) {
  CloudRequest request{{quarter_plate()}, field([n_arc](const Point2 &x) {
                         return .5 * std::numbers::pi / double(n_arc - 1) * (.6 + .4 * std::hypot(x[0], x[1]));
                       })};
  request.seed = seed;
  request.n_particles = n;
  request.n_on_curves = {{2, n_arc}};
  return request;
}

std::vector<double> wanted(const CloudRequest &request, const GeneratedCloud &cloud) {
  std::vector<double> s(cloud.positions.size());
  request.spacing(cloud.positions, s);
  for (double &x : s)
    x *= cloud.scale;
  return s;
}

/// Bounds of the distance to the nearest neighbour and of the mean of four, in units of the wanted spacing.
struct Bounds {
  double least = .7;
  double most = 1.25;
  double least_mean = .75;
  double most_mean = 1.55; ///< 1, 1, 1.7, 2 at a corner
};

/// Every particle on the boundary, to rounding of the extent, or clearly inside.
void expect_in_regions(const CloudRequest &request, const GeneratedCloud &cloud) {
  const auto s = wanted(request, cloud);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const auto &region = request.regions[std::size_t(cloud.regions[i])];
    const auto &x = cloud.positions[i];
    const double distance = region.distance(x);
    if (distance > 1e-14 * region.extent()) {
      EXPECT_TRUE(region.contains(x)) << x[0] << ", " << x[1];
      EXPECT_GE(distance, .05 * s[i]) << x[0] << ", " << x[1];
    }
  }
}

/// A hexagonal pattern has its neighbours at 1, a relaxed cloud that has to fit a boundary some at .75; a random one of
/// the same density has a tenth of its particles nearer than .17.
void expect_even(const CloudRequest &request, const GeneratedCloud &cloud, const Bounds &bounds = {}) {
  const auto s = wanted(request, cloud);
  for (int r = 0; r < int(request.regions.size()); ++r) {
    std::vector<Point2> points;
    std::vector<double> own;
    std::vector<double> mean;
    for (std::size_t i = 0; i < s.size(); ++i)
      if (cloud.regions[i] == r) {
        points.push_back(cloud.positions[i]);
        own.push_back(s[i]);
        mean.push_back(cloud.spacing[i]);
      }
    const meshless::cloud::PointTree<2> tree(points);
    std::vector<Index> indices;
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i) {
      tree.nearest(points[i], 2, indices, distances);
      EXPECT_GE(distances[1], bounds.least * own[i]) << points[i][0] << ", " << points[i][1];
      EXPECT_LE(distances[1], bounds.most * own[i]) << points[i][0] << ", " << points[i][1];
      EXPECT_GE(mean[i], bounds.least_mean * own[i]) << points[i][0] << ", " << points[i][1];
      EXPECT_LE(mean[i], bounds.most_mean * own[i]) << points[i][0] << ", " << points[i][1];
    }
  }
}

std::size_t n_on(const Boundary &boundary, int id, std::span<const Point2> points) {
  return std::size_t(std::count_if(points.begin(), points.end(), [&](const Point2 &x) {
    const auto pieces = boundary.pieces_at(x);
    return std::any_of(pieces.begin(), pieces.end(), [&](auto p) { return boundary.pieces()[p].id == id; });
  }));
}

TEST(CloudGenerator, makes_the_number_of_particles_asked_for_and_lays_them_evenly) {
  struct Size {
    std::size_t n, n_arc;
  };
  for (const auto [n, n_arc] : {Size{188, 11}, Size{686, 21}, Size{687, 21}, Size{2600, 41}})
    for (std::uint64_t seed = 0; seed < (n > 700 ? 1u : 4u); ++seed) {
      SCOPED_TRACE(testing::Message() << n << " particles, seed " << seed);
      const auto request = plate_request(n, n_arc, seed);
      const auto cloud = generate(request);
      ASSERT_EQ(cloud.positions.size(), n);
      EXPECT_EQ(n_on(request.regions[0], 2, cloud.positions), n_arc);
      for (const Point2 &corner : {Point2{1, 0}, Point2{3, 0}, Point2{3, 3}, Point2{0, 3}, Point2{0, 1}})
        EXPECT_EQ(std::count(cloud.positions.begin(), cloud.positions.end(), corner), 1);
      expect_in_regions(request, cloud);
      expect_even(request, cloud);
    }
}

TEST(CloudGenerator, follows_a_spacing_that_grows_thirtyfold) {
  CloudRequest request{{meshless::domain::rectangle({0, 0}, {1, 1})},
                       field([](const Point2 &x) { return .004 + .12 * std::hypot(x[0] - .3, x[1] - .4); })};
  const auto cloud = generate(request);
  EXPECT_EQ(cloud.scale, 1);
  expect_in_regions(request, cloud);
  // From one particle to the next the spacing grows by 12 %.
  expect_even(request, cloud, {.6, 1.4, .65, 1.7});
  // The number is the integral of 2 / (sqrt(3) s^2) over the area, here by the midpoint rule, and half of the
  // boundary's.
  double expected = 0;
  constexpr int m = 1000;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const double s = .004 + .12 * std::hypot((i + .5) / m - .3, (j + .5) / m - .4);
      expected += 2 / std::sqrt(3.) / (s * s) / (m * m);
    }
  std::size_t n_boundary = 0;
  for (const auto &x : cloud.positions)
    n_boundary += request.regions[0].pieces_at(x).empty() ? 0 : 1;
  // A cell of half a spacing sees the spacing in its middle only: some percent where it grows fastest.
  EXPECT_NEAR(double(cloud.positions.size()), expected + .5 * double(n_boundary) + 1, .03 * expected);
}

TEST(CloudGenerator, gives_the_same_cloud_for_a_seed_and_another_for_another) {
  const auto a = generate(plate_request(686, 21, 5));
  const auto b = generate(plate_request(686, 21, 5));
  const auto c = generate(plate_request(686, 21, 6));
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_NE(a.positions, c.positions);
  // Rounding, such as another order of multiplication, does not become visible.
  auto request = plate_request(686, 21, 5);
  request.spacing = [inner = request.spacing](auto x, auto s) {
    inner(x, s);
    for (double &value : s)
      value *= 1 + 3e-16;
  };
  const auto d = generate(request);
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    EXPECT_LE(std::hypot(a.positions[i][0] - d.positions[i][0], a.positions[i][1] - d.positions[i][1]), 1e-11);
}

TEST(CloudGenerator, goes_around_holes) {
  std::vector<BoundaryPiece> pieces{{{0, 0}, {2, 0}, 0}, {{2, 0}, {2, 1}, 1}, {{2, 1}, {0, 1}, 2}, {{0, 1}, {0, 0}, 3}};
  for (const double x : {.4, 1., 1.6}) {
    pieces.push_back({{x - .2, .5}, {x + .2, .5}, 4, Arc{{x, .5}, false}});
    pieces.push_back({{x + .2, .5}, {x - .2, .5}, 4, Arc{{x, .5}, false}});
  }
  CloudRequest request{{Boundary(pieces)}, constant(.05)};
  const auto cloud = generate(request);
  expect_in_regions(request, cloud);
  expect_even(request, cloud);
  for (const auto &x : cloud.positions)
    for (const double centre : {.4, 1., 1.6})
      EXPECT_GE(std::hypot(x[0] - centre, x[1] - .5), .2 - 1e-14);
  request.n_on_curves = {{4, 30}};
  EXPECT_EQ(n_on(request.regions[0], 4, generate(request).positions), 3u * 2 * 29);
}

/// Square with a disc of another material, whose edge touches nothing, and a strip beside it.
std::vector<Boundary> three_regions() {
  const Point2 a{.25, .5}, b{.75, .5};
  const Arc out{{.5, .5}, true}, in{{.5, .5}, false};
  return {Boundary({{{0, 0}, {1, 0}, 0},
                    {{1, 0}, {1, 1}, -1},
                    {{1, 1}, {0, 1}, 0},
                    {{0, 1}, {0, 0}, 0},
                    {b, a, -1, in},
                    {a, b, -1, in}}),
          Boundary({{a, b, -1, out}, {b, a, -1, out}}),
          Boundary({{{1, 0}, {1.3, 0}, 0}, {{1.3, 0}, {1.3, 1}, 0}, {{1.3, 1}, {1, 1}, 0}, {{1, 1}, {1, 0}, -1}})};
}

TEST(CloudGenerator, gives_regions_the_same_particles_on_their_interface) {
  CloudRequest request{three_regions(), field([](const Point2 &x) { return .03 + .03 * x[0]; })};
  for (const std::optional<std::size_t> n : {std::optional<std::size_t>{}, std::optional<std::size_t>{900}}) {
    request.n_particles = n;
    const auto cloud = generate(request);
    if (n) {
      EXPECT_EQ(cloud.positions.size(), *n);
    }
    expect_in_regions(request, cloud);
    expect_even(request, cloud, {.least = .65});
    std::array<std::set<Point2>, 3> on_interface;
    std::array<std::set<Point2>, 3> all;
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
      const auto r = std::size_t(cloud.regions[i]);
      EXPECT_TRUE(all[r].insert(cloud.positions[i]).second) << "twice in one region";
      for (const auto p : request.regions[r].pieces_at(cloud.positions[i]))
        if (request.regions[r].pieces()[p].id == -1)
          on_interface[r].insert(cloud.positions[i]);
    }
    EXPECT_GE(on_interface[1].size(), 20u);
    EXPECT_GE(on_interface[2].size(), 10u);
    std::set<Point2> others = on_interface[1];
    others.insert(on_interface[2].begin(), on_interface[2].end());
    EXPECT_EQ(on_interface[0], others);
  }
}

TEST(CloudGenerator, does_not_look_through_a_thin_slot) {
  // A slot of a fiftieth of the spacing from the left edge to the middle.
  constexpr double w = .0005;
  CloudRequest request{{Boundary({{{0, 0}, {1, 0}, 0},
                                  {{1, 0}, {1, 1}, 0},
                                  {{1, 1}, {0, 1}, 0},
                                  {{0, 1}, {0, .5 + w}, 0},
                                  {{0, .5 + w}, {.5, .5 + w}, 1},
                                  {{.5, .5 + w}, {.5, .5 - w}, 1},
                                  {{.5, .5 - w}, {0, .5 - w}, 1},
                                  {{0, .5 - w}, {0, 0}, 0}})},
                       constant(.05)};
  const auto cloud = generate(request);
  expect_in_regions(request, cloud);
  std::size_t on_faces = 0;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const auto &x = cloud.positions[i];
    const bool at_tip = std::abs(x[0] - .5) < 1e-9 && std::abs(x[1] - .5) < 2 * w;
    on_faces += x[0] < .49 && std::abs(x[1] - .5) < 2 * w ? 1 : 0;
    // The two corners at the tip are as near to each other as the slot is wide.
    if (!at_tip) {
      EXPECT_GE(cloud.spacing[i], .7 * .05) << x[0] << ", " << x[1];
    }
    EXPECT_LE(cloud.spacing[i], 1.55 * .05);
  }
  EXPECT_EQ(on_faces, 20u) << "ten on each face without the tip";
}

TEST(CloudGenerator, takes_a_fine_polyline_as_one_curve) {
  std::vector<BoundaryPiece> pieces;
  constexpr int n = 360;
  const auto at = [](int k) {
    const double a = 2 * std::numbers::pi * (k % n) / n;
    return Point2{std::cos(a), .7 * std::sin(a)};
  };
  for (int k = 0; k < n; ++k)
    pieces.push_back({at(k), at(k + 1), 7});
  CloudRequest request{{Boundary(pieces)}, constant(.1)};
  request.n_on_curves = {{7, 50}};
  const auto cloud = generate(request);
  EXPECT_EQ(n_on(request.regions[0], 7, cloud.positions), 50u);
  expect_in_regions(request, cloud);
  expect_even(request, cloud, {.least = .65});
}

TEST(CloudGenerator, says_what_is_wrong_with_a_request) {
  const auto refusal_of = [](const CloudRequest &request) {
    return message_of<std::invalid_argument>([&] { generate(request); });
  };
  const auto square = meshless::domain::rectangle({0, 0}, {1, 1});
  EXPECT_TRUE(mentions(refusal_of({{}, constant(1)}), {"at least one region"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, {}}), {"spacing"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, field([](const Point2 &x) { return .1 - .2 * x[0]; })}),
                       {"the spacing at (", "greater than 0"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, constant(std::numeric_limits<double>::quiet_NaN())}), {"nan"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, constant(.1), 0, 3}), {"3 particles are too few", "4"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, constant(.1), 0, 30, {{2, 40}}}), {"30 particles are too few"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, constant(.1), 0, {}, {{9, 4}}}), {"boundary 9", "no piece"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, constant(.1), 0, {}, {{2, 1}}}), {"1 particles on a curve"}));
  EXPECT_TRUE(mentions(refusal_of({{square}, constant(1e-6)}), {"about", "1e+07"}));
}

TEST(CloudJitter, moves_particles_inside_the_domain_and_along_its_boundary) {
  const CloudRequest request{three_regions(), constant(.05)};
  const auto cloud = generate(request);
  auto moved = cloud.positions;
  jitter(request.regions, cloud.spacing, cloud.regions, .3, 9, moved);
  std::map<Point2, Point2> destinations;
  std::size_t n_moved = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const auto &region = request.regions[std::size_t(cloud.regions[i])];
    const auto &x = cloud.positions[i];
    const auto pieces = region.pieces_at(x);
    EXPECT_LE(std::hypot(moved[i][0] - x[0], moved[i][1] - x[1]), .3 * std::sqrt(2.) * cloud.spacing[i] + 1e-15);
    n_moved += moved[i] != x ? 1 : 0;
    if (pieces.size() == 1) {
      EXPECT_LE(region.distance(moved[i], pieces[0]), 1e-14);
    } else if (pieces.size() > 1) {
      EXPECT_EQ(moved[i], x) << "corners stay";
    } else {
      EXPECT_TRUE(region.contains(moved[i]));
      EXPECT_GE(region.distance(moved[i]), .2 * cloud.spacing[i]);
    }
    const auto [known, first] = destinations.try_emplace(x, moved[i]);
    EXPECT_LE(std::hypot(known->second[0] - moved[i][0], known->second[1] - moved[i][1]), 1e-14)
        << "the two particles of an interface stay together";
  }
  EXPECT_GE(n_moved, moved.size() - 12);
  auto again = cloud.positions;
  jitter(request.regions, cloud.spacing, cloud.regions, .3, 9, again);
  EXPECT_EQ(again, moved);
  auto other = cloud.positions;
  jitter(request.regions, cloud.spacing, cloud.regions, .3, 10, other);
  EXPECT_NE(other, moved);
  EXPECT_TRUE(mentions(
      message_of<std::invalid_argument>([&] { jitter(request.regions, cloud.spacing, cloud.regions, .5, 9, other); }),
      {"0.5", "[0, 0.5)"}));
}

} // namespace
