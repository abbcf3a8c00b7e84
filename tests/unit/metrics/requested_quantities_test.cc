// Quantities on request, from a solution whose values are known.

#include "comparisons/metrics/requested_quantities.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace comparisons;
using problems::Point2;
using problems::RequestedQuantity;
using Kind = RequestedQuantity::Kind;

/// u = (3 x1, -4 x2), sigma = (x1, 2, 3); the recovered stress is twice that.
class KnownSolution final : public methods::Solution {
public:
  explicit KnownSolution(bool recovered) : recovered_(recovered) {}
  std::vector<std::string> fields() const override {
    return recovered_ ? std::vector<std::string>{"displacement", "stress", "recovered_stress"}
                      : std::vector<std::string>{"displacement", "stress"};
  }
  std::size_t n_components(std::string_view field) const override { return field == "displacement" ? 2 : 3; }
  void evaluate(std::string_view field, std::span<const Point2> points, std::span<double> values) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double factor = field == "recovered_stress" ? 2 : 1;
      if (field == "displacement") {
        values[2 * i] = 3 * points[i][0];
        values[2 * i + 1] = -4 * points[i][1];
      } else {
        values[3 * i] = factor * points[i][0];
        values[3 * i + 1] = factor * 2;
        values[3 * i + 2] = factor * 3;
      }
    }
  }
  std::optional<double> own_strain_energy() const override { return energy; }
  std::optional<double> energy;

private:
  bool recovered_;
};

/// Unit square, clamped on the right (id 1), with the requests of a test.
class Square final : public problems::PlaneProblem {
public:
  Square(std::vector<RequestedQuantity> requests, bool plane_strain) : requests_(std::move(requests)) {
    statement_.regions = {
        {"",
         {10, .25, plane_strain},
         {{{0, 0}, {1, 0}, 0, ""}, {{1, 0}, {1, 1}, 1, ""}, {{1, 1}, {0, 1}, 0, ""}, {{0, 1}, {0, 0}, 0, ""}}}};
    problems::BoundaryCondition clamped;
    clamped.displacement_prescribed = {true, true};
    statement_.conditions = {{0, {}}, {1, clamped}};
  }
  const problems::PlaneStatement &statement() const override { return statement_; }
  const problems::ExactSolution &exact() const override { return exact_; }
  problems::Cloud cloud(const scene::Level &) const override { return {}; }
  problems::Mesh mesh(const scene::Level &) const override { return {}; }
  problems::Quadrature quadrature(const scene::Level &) const override {
    // Exact for sigma11^2 = x1^2.
    const double g = .5 / std::sqrt(3.);
    return {{{.5 - g, .5}, {.5 + g, .5}}, {.5, .5}};
  }
  std::vector<problems::SampleLine> sample_lines() const override { return {}; }
  std::vector<RequestedQuantity> quantities() const override { return requests_; }

private:
  std::vector<RequestedQuantity> requests_;
  problems::PlaneStatement statement_;
  problems::ExactSolution exact_;
};

std::map<std::string, double> quantities_of(std::vector<RequestedQuantity> requests, const KnownSolution &solution,
                                            bool plane_strain = false) {
  const Square problem(std::move(requests), plane_strain);
  std::map<std::string, double> quantities;
  const auto quadrature = problem.quadrature({});
  metrics::add_requested_quantities(solution, problem, quadrature,
                                    metrics::equilibrium(solution, problem.statement(), {}), quantities);
  return quantities;
}

TEST(RequestedQuantities, displacement_and_stress_at_points_with_their_errors) {
  const KnownSolution solution(true);
  auto q =
      quantities_of({{.name = "u1", .component = 0, .point = {2, 1}},
                     {.name = "u2", .component = 1, .point = {2, 1}, .scale = 2, .reference = -2.5},
                     {.name = "u", .component = 2, .point = {1, 1}},
                     {.name = "s11", .kind = Kind::stress, .component = 0, .point = {6, 0}, .scale = 2, .reference = 4},
                     {.name = "s12", .kind = Kind::stress, .component = 2, .point = {6, 0}, .reference = 0}},
                    solution);
  EXPECT_DOUBLE_EQ(q.at("u1"), 6);
  EXPECT_FALSE(q.contains("u1_error"));
  EXPECT_DOUBLE_EQ(q.at("u2"), -2);
  EXPECT_DOUBLE_EQ(q.at("u2_error"), .2);
  EXPECT_DOUBLE_EQ(q.at("u"), 5);
  EXPECT_DOUBLE_EQ(q.at("s11"), 3);
  EXPECT_DOUBLE_EQ(q.at("s11_error"), .25);
  EXPECT_DOUBLE_EQ(q.at("s11_recovered"), 6);
  EXPECT_DOUBLE_EQ(q.at("s11_recovered_error"), .5);
  EXPECT_DOUBLE_EQ(q.at("s12_error"), 3) << "absolute beside a reference of zero";
  EXPECT_FALSE(quantities_of({{.name = "s", .kind = Kind::stress}}, KnownSolution(false)).contains("s_recovered"));
}

TEST(RequestedQuantities, von_mises_stress_of_both_plane_models) {
  const std::vector<RequestedQuantity> at{{.name = "v", .kind = Kind::stress, .component = 3, .point = {4, 0}},
                                          {.name = "largest", .kind = Kind::largest_von_mises}};
  // sqrt(s1^2 - s1 s2 + s2^2 + 3 s12^2), and with sigma33 = nu (4 + 2) = 1.5.
  EXPECT_NEAR(quantities_of(at, KnownSolution(false)).at("v"), std::sqrt(16. - 8 + 4 + 27), 1e-14);
  EXPECT_NEAR(quantities_of(at, KnownSolution(false), true).at("v"), std::sqrt(.5 * (4 + .25 + 6.25) + 27), 1e-14);
  const double s = .5 - .5 / std::sqrt(3.); // of the two points the one farther from 2
  EXPECT_NEAR(quantities_of(at, KnownSolution(false)).at("largest"), std::sqrt(s * s - 2 * s + 4 + 27), 1e-14);
}

TEST(RequestedQuantities, reactions_and_strain_energy) {
  KnownSolution solution(false);
  const std::vector<RequestedQuantity> requests{{.name = "r1", .kind = Kind::reaction, .component = 0, .id = 1},
                                                {.name = "r2", .kind = Kind::reaction, .component = 1, .id = 1},
                                                {.name = "energy", .kind = Kind::strain_energy}};
  const auto q = quantities_of(requests, solution);
  EXPECT_NEAR(q.at("r1"), 1, 1e-14) << "sigma11 = 1 on the side of length 1";
  EXPECT_NEAR(q.at("r2"), 3, 1e-14);
  // (s11^2 + s22^2 - 2 nu s11 s22) / 2E + (1 + nu) s12^2 / E, with the means 1/3 of x1^2 and 1/2 of x1.
  EXPECT_NEAR(q.at("energy"), (1. / 3 + 4 - .5 * .5 * 2) / 20 + 1.25 * 9 / 10, 1e-14);
  solution.energy = 7;
  EXPECT_EQ(quantities_of(requests, solution).at("energy"), 7) << "the method's own";
}

TEST(RequestedQuantities, refuses_what_is_not_finite_and_unknown_boundaries) {
  const KnownSolution solution(false);
  const auto refusal_of = [&](const RequestedQuantity &request) {
    return refusal::message_of<std::runtime_error>([&] { quantities_of({request}, solution); });
  };
  EXPECT_TRUE(refusal::mentions(refusal_of({.name = "far", .point = {std::numeric_limits<double>::infinity(), 0}}),
                                {"far", "not finite"}));
  EXPECT_TRUE(refusal::mentions(refusal_of({.name = "r", .kind = Kind::reaction, .id = 9}), {"r", "boundary 9"}));
}

} // namespace
