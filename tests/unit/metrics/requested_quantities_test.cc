// Quantities on request of a uniform state, where all of them are known by hand.

#include "comparisons/metrics/requested_quantities.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace comparisons;
using problems::RequestedQuantity;

/// u = (2 x + y, 3 y), stress (3, 1, 2) everywhere; no equations of its own.
class Uniform final : public methods::Solution {
public:
  std::vector<std::string> fields() const override { return {"displacement", "stress"}; }
  std::size_t n_components(std::string_view field) const override { return field == "stress" ? 3 : 2; }
  void evaluate(std::string_view field, std::span<const std::array<double, 2>> points,
                std::span<double> values) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (field == "stress") {
        values[3 * i] = 3;
        values[3 * i + 1] = 1;
        values[3 * i + 2] = 2;
      } else {
        values[2 * i] = 2 * points[i][0] + points[i][1];
        values[2 * i + 1] = 3 * points[i][1];
      }
  }
};

/// The unit square, clamped on the left.
class Square final : public problems::PlaneProblem {
public:
  explicit Square(std::vector<RequestedQuantity> quantities, bool plane_strain) : quantities_(std::move(quantities)) {
    statement_.regions = {{"",
                           {10, 0.25, plane_strain},
                           {{{0, 0}, {1, 0}, 1, "bottom"},
                            {{1, 0}, {1, 1}, 1, "right"},
                            {{1, 1}, {0, 1}, 1, "top"},
                            {{0, 1}, {0, 0}, 0, "left"}}}};
    problems::BoundaryCondition clamped;
    clamped.displacement_prescribed = {true, true};
    statement_.conditions = {{0, clamped}, {1, {}}};
  }
  const problems::PlaneStatement &statement() const override { return statement_; }
  const problems::ExactSolution &exact() const override { return exact_; }
  problems::Cloud cloud(const scene::Level &) const override { return {}; }
  problems::Mesh mesh(const scene::Level &) const override { return {}; }
  problems::Quadrature quadrature(const scene::Level &) const override {
    return {{{0.25, 0.5}, {0.75, 0.5}}, {0.5, 0.5}, {}};
  }
  std::vector<problems::SampleLine> sample_lines() const override { return {}; }
  std::vector<RequestedQuantity> quantities() const override { return quantities_; }

private:
  problems::PlaneStatement statement_;
  problems::ExactSolution exact_;
  std::vector<RequestedQuantity> quantities_;
};

std::map<std::string, double> values(const std::vector<RequestedQuantity> &quantities, bool plane_strain = false) {
  const Square problem(quantities, plane_strain);
  const Uniform solution;
  const auto quadrature = problem.quadrature({});
  return metrics::requested_quantities(solution, problem, quadrature,
                                       metrics::equilibrium(solution, problem.statement(), quadrature));
}

TEST(RequestedQuantities, of_a_uniform_state) {
  using Kind = RequestedQuantity::Kind;
  const auto found =
      values({{.name = "u1", .kind = Kind::displacement, .component = 0, .point = {0.5, 1}},
              {.name = "u", .kind = Kind::displacement, .component = 2, .point = {1.5, 1}},
              {.name = "s12", .kind = Kind::stress, .component = 2, .point = {0.5, 0.5}, .scale = 4, .reference = 0.4},
              {.name = "mises", .kind = Kind::stress, .component = 3, .point = {0.5, 0.5}},
              {.name = "largest", .kind = Kind::largest_von_mises},
              {.name = "force", .kind = Kind::reaction, .component = 0, .id = 0},
              {.name = "energy", .kind = Kind::strain_energy}});
  EXPECT_DOUBLE_EQ(found.at("u1"), 2);
  EXPECT_DOUBLE_EQ(found.at("u"), 5); // (4, 3)
  EXPECT_DOUBLE_EQ(found.at("s12"), 0.5);
  EXPECT_DOUBLE_EQ(found.at("s12_error"), 0.25);
  EXPECT_DOUBLE_EQ(found.at("mises"), std::sqrt(9.0 + 1 - 3 + 3 * 4));
  EXPECT_DOUBLE_EQ(found.at("largest"), found.at("mises"));
  EXPECT_NEAR(found.at("force"), -3, 1e-14); // sigma n on the left side, n = (-1, 0)
  // Half of stress times strain in plane stress: (9 + 1 - 2 nu 3) / E + 2 (1 + nu) 4 / E.
  EXPECT_DOUBLE_EQ(found.at("energy"), 0.5 * ((10 - 1.5) / 10 + 10.0 / 10));
  EXPECT_FALSE(found.contains("u1_error"));
}

TEST(RequestedQuantities, plane_strain_has_a_normal_stress_out_of_the_plane) {
  using Kind = RequestedQuantity::Kind;
  const auto found = values({{.name = "mises", .kind = Kind::stress, .component = 3, .point = {0.5, 0.5}},
                             {.name = "energy", .kind = Kind::strain_energy}},
                            true);
  // s33 = nu (s11 + s22) = 1.
  EXPECT_DOUBLE_EQ(found.at("mises"), std::sqrt(0.5 * (4.0 + 0 + 4) + 12));
  EXPECT_DOUBLE_EQ(found.at("energy"), 0.5 * ((9.0 + 1 + 1 - 0.5 * (3 + 1 * 4)) / 10 + 1));
}

} // namespace
