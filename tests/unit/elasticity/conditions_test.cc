// Boundary conditions: what a problem must state, and which two rows a boundary particle gets.

#include "plane_samples.h"

#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

namespace {

using namespace plane_samples;
using refusal::mentions;
using refusal::message_of;
using strong_form::conditions_at;
using strong_form::CornerRule;
using strong_form::Quantity;
using strong_form::RowCondition;

std::string refused(const PlaneProblem &problem) {
  return message_of<std::invalid_argument>([&] { problem.check(); });
}

TEST(PlaneProblem, needs_a_condition_on_every_piece) {
  auto problem = Cantilever().problem();
  EXPECT_EQ(refused(problem), "");
  problem.conditions.erase(3);
  EXPECT_TRUE(mentions(refused(problem), {"boundary 3", "no condition"}));
}

TEST(PlaneProblem, needs_the_displacement_it_prescribes_but_no_traction) {
  auto problem = Cantilever().problem();
  problem.conditions[1].traction = nullptr;
  EXPECT_EQ(refused(problem), "") << "no traction is zero";
  problem.conditions[0].displacement = nullptr;
  EXPECT_TRUE(mentions(refused(problem), {"boundary 0", "no displacement"}));
}

TEST(PlaneProblem, refuses_particles_outside_of_the_domain_by_every_form) {
  const Cantilever plate;
  const auto problem = plate.problem();
  // Inside, on an edge and at a corner are fine; 1.01 is beyond the right edge.
  const std::vector<Point2> points{{.5, .1}, {1, .1}, {0, 0}, {1.01, .1}};
  const cloud::Particles<2> inside({points.begin(), points.begin() + 3}, std::vector<double>(3, .1));
  EXPECT_NO_THROW(problem.require_inside(inside));
  const auto particles = std::make_shared<const cloud::Particles<2>>(points, std::vector<double>(points.size(), .1));
  const auto message = message_of<std::invalid_argument>([&] { problem.require_inside(*particles); });
  EXPECT_TRUE(mentions(message, {"particle 3", "(1.01, 0.1)", "outside"}));
  const std::shared_ptr<const basis::ShapeFunctions<2>> basis = basis::make_ssph<2>(2, kernels::Gauss(4));
  EXPECT_TRUE(mentions(message_of<std::invalid_argument>([&] { strong_form::solve(problem, particles, basis, {}); }),
                       {"particle 3"}));
  EXPECT_TRUE(mentions(message_of<std::invalid_argument>([&] { weak_form::solve(problem, particles, basis, {}); }),
                       {"particle 3"}));
}

TEST(PlaneProblem, must_be_held_in_both_directions) {
  const Cantilever plate;
  Kinds kinds{{{loaded, loaded}, {loaded, loaded}, {loaded, loaded}, {loaded, loaded}}};
  const auto problem = [&] { return rectangle_problem({0, 0}, {1, 1}, plate.material(), plate.exact(), kinds); };
  EXPECT_TRUE(mentions(refused(problem()), {"move freely"}));
  kinds[0][0] = fixed;
  EXPECT_TRUE(mentions(refused(problem()), {"move freely"}));
  kinds[2][1] = fixed; // on another side
  EXPECT_EQ(refused(problem()), "");
}

TEST(Solve, refuses_an_ill_posed_problem) {
  const Cantilever plate;
  auto problem = plate.problem();
  problem.conditions.erase(2);
  for (const auto method : {Method::strong, Method::weak1, Method::weak2})
    EXPECT_THROW(solve(method, problem, plate.particles(16, 4), {}), std::invalid_argument);
}

/// Pieces of the rectangle: 0 bottom, 1 right, 2 top, 3 left.
struct Rows {
  std::array<RowCondition, 2> rows;

  void expect(ConditionKind kind0, int component0, std::size_t piece0, ConditionKind kind1, int component1,
              std::size_t piece1) const {
    EXPECT_EQ(rows[0].kind, kind0);
    EXPECT_EQ(rows[0].component, component0);
    EXPECT_EQ(rows[0].piece, piece0);
    EXPECT_EQ(rows[1].kind, kind1);
    EXPECT_EQ(rows[1].component, component1);
    EXPECT_EQ(rows[1].piece, piece1);
  }
};

Rows rows_at(const PlaneProblem &problem, std::vector<std::size_t> pieces, const CornerRule *rule = nullptr) {
  return {conditions_at(problem, 0, {}, pieces, rule)};
}

Rows rows_by(const PlaneProblem &problem, std::vector<std::size_t> pieces, Quantity a, Quantity b) {
  const CornerRule rule{{0, 0}, {a, b}};
  return rows_at(problem, std::move(pieces), &rule);
}

TEST(Conditions, on_one_piece_are_its_own) {
  const auto problem = Cantilever().problem();
  rows_at(problem, {3}).expect(fixed, 0, 3, fixed, 1, 3);
  rows_at(problem, {2}).expect(loaded, 0, 2, loaded, 1, 2);
  const Cantilever plate;
  const auto sliding = rectangle_problem({0, 0}, {1, 1}, plate.material(), plate.exact(), rollers);
  rows_at(sliding, {3}).expect(fixed, 0, 3, loaded, 1, 3);
  rows_at(sliding, {0}).expect(loaded, 0, 0, fixed, 1, 0);
}

TEST(Conditions, at_a_corner_are_essential_first_and_then_of_the_steeper_piece) {
  const auto problem = Cantilever().problem();
  rows_at(problem, {0, 3}).expect(fixed, 0, 3, fixed, 1, 3);
  // s11 and s12 between two loaded sides: both components of the side whose normal is along x1.
  rows_at(problem, {1, 2}).expect(loaded, 0, 1, loaded, 1, 1);
  rows_at(problem, {0, 1}).expect(loaded, 0, 1, loaded, 1, 1);
  const Cantilever plate;
  const auto sliding = rectangle_problem({0, 0}, {1, 1}, plate.material(), plate.exact(), rollers);
  rows_at(sliding, {0, 3}).expect(fixed, 0, 3, fixed, 1, 0); // one component from each
  rows_at(sliding, {2, 3}).expect(fixed, 0, 3, loaded, 1, 3);
}

TEST(CornerRule, the_six_choices_of_table_1) {
  // Particle 3, south-west: bottom (piece 0) is free, left (piece 3) held. Batra & Zhang 2008, (4.5):
  // t1 = sigma_12 = 0 and t2 = sigma_22 = 0 come from the bottom.
  using enum Quantity;
  const auto problem = Cantilever().problem();
  const std::vector<std::size_t> corner{0, 3};
  rows_by(problem, corner, u1, u2).expect(fixed, 0, 3, fixed, 1, 3);
  rows_by(problem, corner, u1, s22).expect(fixed, 0, 3, loaded, 1, 0);
  rows_by(problem, corner, u1, s12).expect(fixed, 0, 3, loaded, 0, 0);
  rows_by(problem, corner, u2, s22).expect(fixed, 1, 3, loaded, 1, 0);
  rows_by(problem, corner, u2, s12).expect(fixed, 1, 3, loaded, 0, 0);
  rows_by(problem, corner, s22, s12).expect(loaded, 1, 0, loaded, 0, 0);
}

TEST(CornerRule, the_choices_of_table_2) {
  // Particle 1, north-east: right (piece 1) and top (piece 2) are loaded.
  using enum Quantity;
  const auto problem = Cantilever().problem();
  const std::vector<std::size_t> corner{1, 2};
  rows_by(problem, corner, s11, s12).expect(loaded, 0, 1, loaded, 1, 1);
  rows_by(problem, corner, s11, s22).expect(loaded, 0, 1, loaded, 1, 2);
  rows_by(problem, corner, s12, s22).expect(loaded, 1, 1, loaded, 1, 2);
  rows_by(problem, corner, t1, t2).expect(loaded, 0, 1, loaded, 1, 1);
}

TEST(CornerRule, refuses_what_no_piece_prescribes) {
  using enum Quantity;
  const auto problem = Cantilever().problem();
  const auto message = [&](std::vector<std::size_t> pieces, Quantity a, Quantity b) {
    return message_of<std::invalid_argument>([&] { rows_by(problem, pieces, a, b); });
  };
  EXPECT_TRUE(mentions(message({1, 2}, u1, s11), {"u1", "no boundary"}));
  EXPECT_TRUE(mentions(message({1, 2}, s12, u2), {"u2", "no boundary"}));
  EXPECT_TRUE(mentions(message({0, 3}, s11, u2), {"s11", "no boundary"})); // the left is held
  EXPECT_TRUE(mentions(message({1, 2}, s22, s22), {"twice", "s22"}));
}

TEST(CornerRule, refuses_two_names_of_one_condition) {
  // t1 on the right side is s11: the system would have two equal rows.
  using enum Quantity;
  const auto problem = Cantilever().problem();
  EXPECT_THROW(rows_by(problem, {1, 2}, t1, s11), std::invalid_argument);
  EXPECT_THROW(rows_by(problem, {1, 2}, s12, t2), std::invalid_argument);
}

TEST(CornerRule, needs_a_particle) {
  const Cantilever plate;
  const std::vector<CornerRule> rules{{{.5, .1234}, {Quantity::s11, Quantity::s22}}};
  const auto message = message_of<std::invalid_argument>(
      [&] { solve(Method::strong, plate.problem(), plate.particles(16, 4), {.corner_rules = rules}); });
  EXPECT_TRUE(mentions(message, {"no particle", "(0.5, 0.1234)"}));
}

TEST(CornerRule, reads_its_words) {
  using enum Quantity;
  const std::pair<const char *, Quantity> words[] = {{"u1", u1},   {"u2", u2},   {"t1", t1},  {"t2", t2},
                                                     {"s11", s11}, {"s22", s22}, {"s12", s12}};
  for (const auto &[word, quantity] : words)
    EXPECT_EQ(strong_form::quantity_from(word), quantity);
  for (const auto *word : {"", "u3", "S11", "s21 "})
    EXPECT_FALSE(strong_form::quantity_from(word));
}

} // namespace
