// Rows that are copies of another particle's, moved: equal to computed ones, as many as a grid has, for any number of
// threads, and none where something else comes into the rows.

#include "meshless/parallel/threads.h"
#include "unit/elasticity/plane_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace plane_samples;
using weak_form::RepeatedRows;

struct Case {
  const char *name;
  weak_form::Parameters parameters;
  int order = 2;
};

std::vector<Case> cases() {
  const auto with = [](auto change) {
    weak_form::Parameters p;
    p.quadrature_points = 4;
    change(p);
    return p;
  };
  return {{"weak1", with([](auto &) {})},
          {"weak1 of order 3", with([](auto &) {}), 3},
          {"weak1 consistent", with([](auto &p) { p.integration = weak_form::IntegrationRule::consistent; })},
          {"weak2", with([](auto &p) { p.derivatives = DerivativeRule::differentiated; })},
          {"heaviside", with([](auto &p) {
             p.test_function = {};
             p.test_radius = .6;
           })},
          {"hybrid", with([](auto &p) { p.interior_rows = weak_form::InteriorRows::collocated; })},
          {"shrunk", with([](auto &p) { p.subdomains = weak_form::Subdomains::shrunk; })}};
}

std::shared_ptr<const basis::ShapeFunctions<2>> basis_of(int order) {
  return basis::make_ssph<2>(order, kernels::Gauss(order + 2));
}

double largest_difference(const LinearSystem &a, const LinearSystem &b) {
  double difference = 0;
  const auto difference_matrix = linear_algebra::combine(1, a.matrix, -1, b.matrix);
  for (const double value : difference_matrix.values())
    difference = std::max(difference, std::abs(value));
  for (std::size_t i = 0; i < a.right_hand_side.size(); ++i)
    difference = std::max(difference, std::abs(a.right_hand_side[i] - b.right_hand_side[i]));
  return difference;
}

TEST(RepeatedRows, AreThoseThatAreComputed) {
  for (const Point2 origin : {Point2{0, 0}, Point2{3.7, -1.3}})
    for (auto &[name, parameters, order] : cases()) {
      Cantilever plate;
      plate.origin = origin;
      const auto particles = plate.particles(61, 13);
      parameters.repeated_rows = RepeatedRows::copied;
      const auto copied = weak_form::linear_system(plate.problem(), particles, *basis_of(order), parameters);
      parameters.repeated_rows = RepeatedRows::computed;
      const auto computed = weak_form::linear_system(plate.problem(), particles, *basis_of(order), parameters);
      // Entries are of size 1; coordinates in units of h have errors of 1e-14 (41 spacings, an origin 4 lengths away).
      EXPECT_LT(largest_difference(copied, computed), 2e-11) << name;
    }
}

std::size_t n_repeated(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                       const weak_form::Parameters &parameters) {
  return weak_form::solve(problem, std::make_shared<const cloud::Particles<2>>(particles), basis_of(2), parameters)
      .n_repeated;
}

/// Subdomains of radius h are whole but on the boundary, and with supports of 4 h particles nearer to an edge than 4 h
/// see it: three lines at each, and one kind of line between, in both directions.
TEST(RepeatedRows, AreAllButOneOfAKind) {
  const Cantilever plate;
  EXPECT_EQ(n_repeated(plate.problem(), plate.particles(91, 19), {}), 89u * 17 - 7 * 7);
  EXPECT_EQ(n_repeated(plate.problem(), plate.particles(41, 9), {}), 39u * 7 - 7 * 7);
  weak_form::Parameters computed;
  computed.repeated_rows = RepeatedRows::computed;
  EXPECT_EQ(n_repeated(plate.problem(), plate.particles(91, 19), computed), 0u);
}

TEST(RepeatedRows, AreNotWhereForcesOrStrainsActInside) {
  const Cantilever plate;
  auto problem = plate.problem();
  problem.body_force = field([](Point2 x) { return Vector2{x[0], 0}; });
  EXPECT_EQ(n_repeated(problem, plate.particles(41, 9), {}), 0u);
  problem.body_force = {};
  problem.thermal_strain = [](std::span<const Point2> x, std::span<double> values) {
    for (std::size_t i = 0; i < x.size(); ++i)
      values[i] = 1e-5 * x[i][0];
  };
  EXPECT_EQ(n_repeated(problem, plate.particles(41, 9), {}), 0u);
}

/// A grid of which some particles are moved: no row may be taken from a particle that lies otherwise.
TEST(RepeatedRows, OfACloudThatIsAGridInPart) {
  const Cantilever plate;
  const auto grid = plate.particles(61, 13);
  std::vector<Point2> positions(grid.positions().begin(), grid.positions().end());
  const double h = grid.smoothing_length(0);
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (const auto x = positions[k]; k % 37 == 5 && x[0] > 2 * h && x[0] < 1 - 2 * h && x[1] > h && x[1] < .2 - h) {
      positions[k][0] += 1e-7 * h * static_cast<double>(k);
      positions[k][1] -= .1 * h;
    }
  const cloud::Particles<2> particles(positions, std::vector<double>(positions.size(), h));
  weak_form::Parameters parameters;
  parameters.quadrature_points = 4;
  const auto copied = weak_form::linear_system(plate.problem(), particles, *basis_of(2), parameters);
  parameters.repeated_rows = RepeatedRows::computed;
  const auto computed = weak_form::linear_system(plate.problem(), particles, *basis_of(2), parameters);
  EXPECT_LT(largest_difference(copied, computed), 2e-11);
}

TEST(RepeatedRows, AreTheSameToTheLastBitForAnyNumberOfThreads) {
  const Cantilever plate;
  const auto particles = plate.particles(61, 13);
  const auto rows = [&](int n_threads) {
    parallel::set_threads(n_threads);
    auto system = weak_form::linear_system(plate.problem(), particles, *basis_of(2), {});
    parallel::set_threads(1);
    return system;
  };
  const auto alone = rows(1);
  for (const int n : {2, 3}) {
    const auto together = rows(n);
    EXPECT_TRUE(std::ranges::equal(alone.matrix.columns(), together.matrix.columns()));
    EXPECT_TRUE(std::ranges::equal(alone.matrix.values(), together.matrix.values()));
    EXPECT_TRUE(std::ranges::equal(alone.right_hand_side, together.right_hand_side));
  }
}

} // namespace
