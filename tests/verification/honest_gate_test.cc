// The exact solution reaches a method only as boundary data and body force. A wrapper around the cantilever scales what
// the metrics see, or what the methods see; either way the errors must rise by just that much. And nobody may ask for
// the exact solution while a method is at work.

#include "comparisons/benchmarks/cantilever/problem.h"
#include "comparisons/study/plane_experiment.h"
#include "verification/scene_runs.h"

#include <gtest/gtest.h>

#include <memory>

namespace {

using namespace scene_runs;
using problems::Point2;
using problems::Stress2;
using problems::Vector2;

/// What to change of the problem, and a flag that is up while a method solves.
struct Gate {
  double exact_scale = 1;
  double displacement_scale = 1;
  double traction_scale = 1;
  double body_force_scale = 1;
  bool solving = false;
  int asked_while_solving = 0;
};

template <typename Field>
problems::VectorField scaled(Field field, double scale) {
  return [field, scale](std::span<const Point2> points, std::span<Vector2> values) {
    field(points, values);
    for (auto &value : values)
      value = {scale * value[0], scale * value[1]};
  };
}

class Gated final : public problems::PlaneProblem {
public:
  Gated(std::unique_ptr<problems::PlaneProblem> problem, std::shared_ptr<Gate> gate)
      : problem_(std::move(problem)), statement_(problem_->statement()) {
    for (auto &[id, condition] : statement_.conditions) {
      if (condition.displacement)
        condition.displacement = scaled(condition.displacement, gate->displacement_scale);
      if (condition.traction)
        condition.traction = [field = condition.traction, gate](std::span<const Point2> points,
                                                                std::span<const Vector2> normals,
                                                                std::span<Vector2> values) {
          field(points, normals, values);
          for (auto &value : values)
            value = {gate->traction_scale * value[0], gate->traction_scale * value[1]};
        };
    }
    if (statement_.body_force)
      statement_.body_force = scaled(statement_.body_force, gate->body_force_scale);
    exact_.displacement = [this, gate](std::span<const Point2> points, std::span<Vector2> values) {
      gate->asked_while_solving += gate->solving ? 1 : 0;
      problem_->exact().displacement(points, values);
      for (auto &value : values)
        value = {gate->exact_scale * value[0], gate->exact_scale * value[1]};
    };
    exact_.stress = [this, gate](std::span<const Point2> points, std::span<Stress2> values) {
      gate->asked_while_solving += gate->solving ? 1 : 0;
      problem_->exact().stress(points, values);
      for (auto &value : values)
        for (double &component : value)
          component *= gate->exact_scale;
    };
  }

  const problems::PlaneStatement &statement() const override { return statement_; }
  const problems::ExactSolution &exact() const override { return exact_; }
  problems::Cloud cloud(const scene::Level &level) const override { return problem_->cloud(level); }
  problems::Mesh mesh(const scene::Level &level) const override { return problem_->mesh(level); }
  problems::Quadrature quadrature(const scene::Level &level) const override { return problem_->quadrature(level); }
  std::vector<problems::SampleLine> sample_lines() const override { return problem_->sample_lines(); }

private:
  std::unique_ptr<problems::PlaneProblem> problem_;
  problems::PlaneStatement statement_;
  problems::ExactSolution exact_;
};

/// The shipped catalogue with the gate in its cantilever and around every method.
study::Catalogue gated_catalogue(const std::shared_ptr<Gate> &gate) {
  auto catalogue = study::shipped_catalogue();
  for (auto &method : catalogue.methods)
    method.solve = [solve = method.solve, gate](const methods::SolveRequest &request) {
      gate->solving = true;
      auto solution = solve(request);
      gate->solving = false;
      return solution;
    };
  for (auto &benchmark : catalogue.benchmarks)
    if (benchmark.description.name == "cantilever")
      benchmark.make_experiment = [gate](const scene::Scene &scene, const scene::ProblemVariant &variant,
                                         const std::vector<methods::Method> &methods) {
        return study::make_plane_experiment(
            std::make_unique<Gated>(benchmarks::cantilever::make_problem(scene, variant), gate), methods);
      };
  return catalogue;
}

/// Every method of the table, each also with an order that has the cubic in its space.
std::string scene_text() {
  return R"(
schema = 1
benchmark = "cantilever"
[[method]]
name = "strong"
order = [2, 3]
[[method]]
name = "weak1"
order = [2, 3]
[[method]]
name = "weak2"
order = [2, 3]
[[method]]
name = "hybrid"
order = [2, 3]
[[method]]
name = "mixed"
order = [2, 3]
[[method]]
name = "weak1"
label = "consistent"
quadrature = "consistent"
order = [2, 3]
[[method]]
name = "fem"
element = ["Q1", "Q2", "Q2Q1", "Q3"]
[study]
levels = ["16x4"]
)";
}

bool has_the_cubic(const reports::Cell &cell) { return cell.label.ends_with("order=3") || cell.label.ends_with("Q3"); }

std::vector<reports::Cell> run_with(const Gate &gate, const std::string &text = scene_text()) {
  const auto shared = std::make_shared<Gate>(gate);
  const auto catalogue = gated_catalogue(shared);
  auto cells = run(read(text, {}, catalogue), catalogue);
  EXPECT_EQ(shared->asked_while_solving, 0);
  return cells;
}

constexpr double change = 1e-3;

TEST(HonestGate, every_method_of_the_table_is_tried) {
  const auto cells = run_with({});
  for (const auto &method : methods::method_table()) {
    bool tried = false;
    for (const auto &cell : cells)
      tried = tried || cell.method == method.description.name;
    EXPECT_TRUE(tried) << "add " << method.description.name << " to the scene of this test";
  }
  // The wrapper alone changes nothing.
  const auto plain = run(read(scene_text()));
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_EQ(l2(cells[i]), l2(plain[i])) << name_of(cells[i]);
}

// u_h = u + e with an error e of the method; against (1 + c) u the error is e - c u, relative to (1 + c) |u|.
TEST(HonestGate, a_changed_exact_solution_shows_in_the_errors) {
  const auto before = run_with({});
  const auto after = run_with({.exact_scale = 1 + change});
  const double expected = change / (1 + change);
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (has_the_cubic(after[i])) {
      EXPECT_NEAR(l2(after[i]), expected, 1e-9) << name_of(after[i]);
      EXPECT_NEAR(stress_l2(after[i]), expected, 1e-9) << name_of(after[i]);
      continue;
    }
    // The triangle inequality, both ways; and the change is seen.
    EXPECT_LE(std::abs(l2(after[i]) - l2(before[i]) / (1 + change)), expected * (1 + 1e-9)) << name_of(after[i]);
    EXPECT_NE(l2(after[i]), l2(before[i])) << name_of(after[i]);
  }
}

TEST(HonestGate, a_changed_statement_shows_in_the_errors) {
  const auto before = run_with({});
  const auto after = run_with({.displacement_scale = 1 + change, .traction_scale = 1 + change});
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (has_the_cubic(after[i])) {
      EXPECT_NEAR(l2(after[i]), change, 1e-9) << name_of(after[i]);
    }
    // u_h grows by the same factor, whatever its error: linear.
    EXPECT_NEAR(l2(after[i]), l2(before[i]), change * (1 + l2(before[i])) * (1 + 1e-6)) << name_of(after[i]);
    EXPECT_NE(l2(after[i]), l2(before[i])) << name_of(after[i]);
  }
}

TEST(HonestGate, each_part_of_the_statement_is_used) {
  const Gate changes[] = {{.displacement_scale = 1.1}, {.traction_scale = 1.1}};
  for (const auto &gate : changes)
    for (const auto &cell : run_with(gate)) {
      if (has_the_cubic(cell)) {
        // Wrong boundary data alone are no rigid motion: a tenth of them leaves far more than rounding.
        EXPECT_GT(l2(cell), 1e-4) << name_of(cell);
      }
    }
}

TEST(HonestGate, the_body_force_is_used) {
  std::string text = scene_text();
  const std::string place = "[[method]]";
  text.insert(text.find(place),
              "[problem]\nsolution = \"trigonometric\"\n[effects]\nelasticity = true\nbody_force = true\n");
  const auto before = run_with({}, text);
  const auto after = run_with({.body_force_scale = 1.1}, text);
  for (std::size_t i = 0; i < after.size(); ++i)
    // A tenth of the body force moves the solution by about a tenth, times the slenderness of the plate.
    EXPECT_GT(std::abs(l2(after[i]) - l2(before[i])), 1e-2) << name_of(after[i]);
}

} // namespace
