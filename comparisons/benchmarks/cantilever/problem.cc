#include "comparisons/benchmarks/cantilever/problem.h"

#include "comparisons/benchmarks/cantilever/exact_solution.h"
#include "comparisons/problems/rectangle_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace comparisons::benchmarks::cantilever {

namespace {

using problems::Point2;
using problems::Stress2;
using problems::Vector2;
using scene::Type;

problems::TractionField traction_of(const problems::StressField &stress) {
  return [stress](std::span<const Point2> points, std::span<const Vector2> normals, std::span<Vector2> values) {
    std::vector<Stress2> s(points.size());
    stress(points, s);
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = {s[i][0] * normals[i][0] + s[i][2] * normals[i][1],
                   s[i][2] * normals[i][0] + s[i][1] * normals[i][1]};
  };
}

class Cantilever final : public problems::PlaneProblem {
public:
  Cantilever(const scene::Scene &scene, const scene::Parameters &problem)
      : jitter_(problem.real("jitter")), seed_(static_cast<std::uint64_t>(scene.study.integer("seed"))) {
    plate_ = {problem.real("length"), problem.real("width"), problem.real("force"), problem.point("origin")};
    upper_ = {plate_.origin[0] + plate_.length, plate_.origin[1] + plate_.width};
    const problems::Material material{scene.material.real("E"), scene.material.real("nu"),
                                      scene.material.text("model") == "plane strain"};
    const std::string &choice = problem.text("solution");
    Solution solution = choice == "linear"          ? linear(plate_, material)
                        : choice == "trigonometric" ? trigonometric(plate_, material)
                                                    : bending(plate_, material);
    exact_ = std::move(solution.exact);
    const bool wants_body_force =
        std::find(scene.effects.begin(), scene.effects.end(), "body_force") != scene.effects.end();
    if (wants_body_force)
      statement_.body_force = solution.body_force;

    statement_.regions = {{{}, material, problems::rectangle_boundary(plate_.origin, upper_)}};
    statement_.corners = problems::rectangle_corners(plate_.origin, upper_);
    statement_.characteristic_length = plate_.length;
    problems::BoundaryCondition fixed;
    fixed.displacement_prescribed = {true, true};
    fixed.displacement = exact_.displacement;
    problems::BoundaryCondition loaded;
    loaded.traction = traction_of(exact_.stress);
    statement_.conditions = {{0, fixed}, {1, loaded}, {2, loaded}, {3, loaded}};
  }

  const problems::PlaneStatement &statement() const override { return statement_; }
  const problems::ExactSolution &exact() const override { return exact_; }
  problems::Cloud cloud(const scene::Level &level) const override { return grid(level).cloud(); }
  problems::Mesh mesh(const scene::Level &level) const override { return grid(level).mesh(); }
  problems::Quadrature quadrature(const scene::Level &level) const override { return grid(level).quadrature(); }

  std::vector<problems::SampleLine> sample_lines() const override {
    constexpr int n = 201;
    problems::SampleLine bottom{"bottom", {}, 0};
    problems::SampleLine top{"top", {}, 0};
    for (int i = 0; i < n; ++i) {
      const double x = i + 1 == n ? upper_[0] : plate_.origin[0] + plate_.length * i / (n - 1);
      bottom.points.push_back({x, plate_.origin[1]});
      top.points.push_back({x, upper_[1]});
    }
    return {bottom, top};
  }

  std::vector<ComponentError> component_errors() const override { return {{"u2_max_relative", 1, "bottom"}}; }

private:
  problems::RectangleGrid grid(const scene::Level &level) const {
    std::array<int, 2> n{};
    if (level.spacing) {
      const double sides[] = {plate_.length, plate_.width};
      for (std::size_t k = 0; k < 2; ++k)
        n[k] = std::max(2, 1 + static_cast<int>(sides[k] / *level.spacing + 0.5));
    } else
      n = {level.counts[0], level.counts[1]};
    return {plate_.origin, upper_, n, jitter_, seed_};
  }

  Plate plate_;
  Point2 upper_{};
  double jitter_;
  std::uint64_t seed_;
  problems::PlaneStatement statement_;
  problems::ExactSolution exact_;
};

void check(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  if (std::find(context.effects.begin(), context.effects.end(), "thermal_expansion") != context.effects.end())
    diagnostics.error({}, "effects.thermal_expansion", "this benchmark has no temperature",
                      "remove the effect, or describe the problem by [geometry]");
  const auto &material = context.material;
  if (material.text("model") == "plane strain" && material.real("nu") >= 0.5)
    diagnostics.error(
        material.location("nu"), "material.nu",
        "0.5 is incompressible: in plane strain no listed method can take it; allowed are values in (-1, 0.5)",
        "use nu = 0.4999, or model = \"plane stress\"");
  const bool body_force =
      std::find(context.effects.begin(), context.effects.end(), "body_force") != context.effects.end();
  if (context.problem.text("solution") == "trigonometric" && !body_force)
    diagnostics.error(context.problem.location("solution"), "problem.solution",
                      "the trigonometric solution needs its body force, which the scene does not call for",
                      "add body_force = true (and elasticity = true) to [effects]");
  if (context.problem.real("force") == 0)
    diagnostics.error(context.problem.location("force"), "problem.force",
                      "0 makes the exact solution zero, and errors are relative to it", "use force = \"1 MN/m\"");
  const double length = context.problem.real("length");
  const double width = context.problem.real("width");
  const auto &level = context.level;
  if (level.spacing && *level.spacing > std::min(length, width))
    diagnostics.error({}, "study.levels",
                      fmt::format("the spacing {} m is larger than the plate's side of {} m", *level.spacing,
                                  std::min(length, width)));
  double points = 1;
  if (level.spacing)
    points = (length / *level.spacing + 1) * (width / *level.spacing + 1);
  else
    for (const int n : level.counts)
      points *= n;
  if (points > 2e7)
    diagnostics.error({}, "study.levels",
                      fmt::format("level {} has {:.3g} points; at most 2e7 are allowed", level.text, points));
}

} // namespace

scene::BenchmarkDescription description() {
  using namespace scene;
  BenchmarkDescription benchmark;
  benchmark.name = "cantilever";
  benchmark.meaning = "plate fixed at its left edge, Batra & Zhang 2008, section 4.1";
  benchmark.problem = {
      {.name = "length",
       .dimension = dimensions::length,
       .range = {.lower = 0, .lower_open = true},
       .default_value = 1.0,
       .meaning = "L1, length of the plate"},
      {.name = "width",
       .dimension = dimensions::length,
       .range = {.lower = 0, .lower_open = true},
       .default_value = 0.2,
       .meaning = "L2, width of the plate"},
      {.name = "force",
       .dimension = dimensions::force_per_length,
       .default_value = 1e6,
       .meaning = "F0, end load per thickness"},
      {.name = "origin",
       .type = Type::point,
       .dimension = dimensions::length,
       .default_value = Point{0, 0},
       .meaning = "lower left corner of the plate"},
      {.name = "solution",
       .type = Type::choice,
       .choices = {"bending", "linear", "trigonometric"},
       .default_value = "bending",
       .meaning =
           "exact solution: the paper's cubic, a uniform strain (patch test), or no polynomial (needs body_force)"},
      {.name = "jitter",
       .range = {.lower = 0, .upper = 0.49},
       .default_value = 0.0,
       .meaning = "largest random move of a particle or vertex, in spacings"},
  };
  benchmark.material = {
      {.name = "E",
       .dimension = dimensions::pressure,
       .range = {.lower = 0, .lower_open = true},
       .default_value = 226.9e9,
       .meaning = "Young's modulus"},
      {.name = "nu",
       .range = {.lower = -1, .upper = 0.5, .lower_open = true},
       .default_value = 0.33,
       .meaning = "Poisson's ratio"},
      {.name = "model",
       .type = Type::choice,
       .choices = {"plane stress", "plane strain"},
       .default_value = "plane stress",
       .meaning = "plane model"},
  };
  benchmark.effects = {"elasticity"};
  benchmark.check = check;
  benchmark.counts_per_level = 2;
  return benchmark;
}

std::unique_ptr<problems::PlaneProblem> make_problem(const scene::Scene &scene, const scene::ProblemVariant &variant) {
  return std::make_unique<Cantilever>(scene, variant.parameters);
}

} // namespace comparisons::benchmarks::cantilever
