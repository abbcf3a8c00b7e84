#include "comparisons/benchmarks/plate_with_hole/problem.h"

#include "comparisons/benchmarks/plate_with_hole/exact_solution.h"
#include "comparisons/benchmarks/plate_with_hole/quarter_plate.h"
#include "comparisons/benchmarks/plate_with_hole/shipped_clouds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace comparisons::benchmarks::plate_with_hole {

namespace {

using problems::Point2;
using problems::Vector2;
using scene::Type;

bool has_paper_shape(const QuarterPlate &plate) {
  return std::abs(plate.half_length - 3 * plate.radius) < 1e-12 * plate.radius &&
         std::abs(plate.half_width - 3 * plate.radius) < 1e-12 * plate.radius;
}

class PlateWithHole final : public problems::PlaneProblem {
public:
  PlateWithHole(const scene::Scene &scene, const scene::Parameters &problem)
      : plate_{problem.real("radius"), problem.real("half_length"), problem.real("half_width")},
        stress_(problem.real("stress")), shipped_(problem.text("cloud") == "shipped"), jitter_(problem.real("jitter")),
        cloud_seed_(static_cast<std::uint64_t>(problem.integer("cloud_seed"))),
        jitter_seed_(static_cast<std::uint64_t>(scene.study.integer("seed"))) {
    const problems::Material material{scene.material.real("E"), scene.material.real("nu"),
                                      scene.material.text("model") == "plane strain"};
    exact_ = kirsch(plate_.radius, stress_, material);
    statement_ = plate_with_hole::statement(plate_, material, exact_);
  }

  const problems::PlaneStatement &statement() const override { return statement_; }
  const problems::ExactSolution &exact() const override { return exact_; }

  problems::Cloud cloud(const scene::Level &level) const override {
    problems::Cloud cloud = unmoved(level);
    if (jitter_ > 0)
      jitter(plate_, jitter_, jitter_seed_, cloud);
    return cloud;
  }

  problems::Mesh mesh(const scene::Level &level) const override {
    return plate_with_hole::mesh(plate_, level.spacing ? blocks_with(*level.spacing) : blocks_of(count(level)));
  }

  problems::Quadrature quadrature(const scene::Level &level) const override {
    const double n = level.spacing ? std::pow(blocks_with(*level.spacing).n_around * 2, 2) : double(count(level));
    return plate_with_hole::quadrature(plate_, std::clamp(static_cast<int>(std::sqrt(n) / 2), 10, 80));
  }

  std::vector<problems::SampleLine> sample_lines() const override {
    constexpr int n = 201;
    problems::SampleLine on_x2{"x2_axis", {}, 1};
    problems::SampleLine on_x1{"x1_axis", {}, 0};
    problems::SampleLine on_hole{"hole", {}, 0};
    const auto between = [](double a, double b, int i) { return i + 1 == n ? b : a + (b - a) * i / (n - 1); };
    for (int i = 0; i < n; ++i) {
      on_x2.points.push_back({0, between(plate_.radius, plate_.half_width, i)});
      on_x1.points.push_back({between(plate_.radius, plate_.half_length, i), 0});
      const double angle = 0.5 * std::numbers::pi * i / (n - 1);
      on_hole.points.push_back({i + 1 == n ? 0 : plate_.radius * std::cos(angle), plate_.radius * std::sin(angle)});
    }
    return {on_x2, on_x1, on_hole, {"field", field_points(plate_, 32), 0}};
  }

  std::vector<problems::RequestedQuantity> quantities() const override {
    using Kind = problems::RequestedQuantity::Kind;
    problems::RequestedQuantity factor{
        .name = "stress_concentration_factor", .kind = Kind::stress, .component = 0, .point = {0, plate_.radius}};
    problems::RequestedQuantity pole{
        .name = "hoop_stress_at_pole", .kind = Kind::stress, .component = 1, .point = {plate_.radius, 0}};
    factor.scale = pole.scale = stress_;
    factor.reference = 3;
    pole.reference = -1;
    return {factor, pole};
  }

  std::vector<ComponentError> component_errors() const override {
    using Kind = ComponentError::Kind;
    return {{"u1_max_relative", 0, {}},
            {"u2_max_relative", 1, {}},
            {"u1_max_error", 0, {}, Kind::largest},
            {"u2_max_error", 1, {}, Kind::largest},
            {"u2_x2_axis_max_relative", 1, "x2_axis"},
            {"u2_x2_axis_l2", 1, "x2_axis", Kind::l2}};
  }

private:
  static std::size_t count(const scene::Level &level) { return static_cast<std::size_t>(level.counts[0]); }

  /// Elements at the hole as long as the given spacing.
  Blocks blocks_with(double spacing) const {
    const double quarter = 0.5 * std::numbers::pi * plate_.radius;
    const int around = std::max(1, static_cast<int>(std::lround(0.5 * quarter / spacing)));
    return {around, std::max(1, static_cast<int>(std::lround(1.4 * around)))};
  }

  problems::Cloud unmoved(const scene::Level &level) const {
    if (level.spacing)
      return generated_cloud(plate_, 0, *level.spacing, shipped_ ? shipped_seed : cloud_seed_);
    const std::size_t n = count(level);
    if (!shipped_)
      return generated_cloud(plate_, n, 0, cloud_seed_);
    if (!has_paper_shape(plate_) || std::find(shipped_sizes.begin(), shipped_sizes.end(), n) == shipped_sizes.end())
      return generated_cloud(plate_, n, 0, shipped_seed);
    problems::Cloud cloud = shipped_cloud(n);
    if (plate_.radius != 1) {
      for (Point2 &x : cloud.positions)
        x = {x[0] * plate_.radius, x[1] * plate_.radius};
      for (double &h : cloud.spacing)
        h *= plate_.radius;
    }
    return cloud;
  }

  QuarterPlate plate_;
  double stress_;
  bool shipped_;
  double jitter_;
  std::uint64_t cloud_seed_;
  std::uint64_t jitter_seed_;
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
  if (context.problem.real("stress") == 0)
    diagnostics.error(context.problem.location("stress"), "problem.stress",
                      "0 makes the exact solution zero, and errors are relative to it", "use stress = \"1 GPa\"");
  const double radius = context.problem.real("radius");
  for (const char *side : {"half_length", "half_width"})
    if (context.problem.real(side) < 1.05 * radius)
      diagnostics.error(context.problem.location(side), std::string("problem.") + side,
                        fmt::format("{} m leaves no plate beside a hole of radius {} m; at least 1.05 radii are needed",
                                    context.problem.real(side), radius));
  const auto &level = context.level;
  if (level.spacing && *level.spacing > radius)
    diagnostics.error({}, "study.levels",
                      fmt::format("the spacing {} m is larger than the hole's radius of {} m", *level.spacing, radius));
  const double n = level.spacing ? 1.55 * std::pow(0.5 * std::numbers::pi * radius / *level.spacing, 2)
                                 : static_cast<double>(level.counts.empty() ? 0 : level.counts[0]);
  if (n > 5e6)
    diagnostics.error({}, "study.levels",
                      fmt::format("level {} has {:.3g} particles; at most 5e6 are allowed", level.text, n));
  if (!level.spacing && n < 20)
    diagnostics.error({}, "study.levels",
                      fmt::format("{} particles are too few for the boundary of the plate; at least 20", n));
}

} // namespace

scene::BenchmarkDescription description() {
  using namespace scene;
  BenchmarkDescription benchmark;
  benchmark.name = "plate_with_hole";
  benchmark.meaning = "quarter of a plate with a hole under tension, Batra & Zhang 2008, 4.2; Zhang & Batra 2008, 6.3";
  const Range positive{.lower = 0, .lower_open = true};
  benchmark.problem = {
      {.name = "radius",
       .dimension = dimensions::length,
       .range = positive,
       .default_value = 1.0,
       .meaning = "b, radius of the hole"},
      {.name = "half_length",
       .dimension = dimensions::length,
       .range = positive,
       .default_value = 3.0,
       .meaning = "half of the plate's length, along x1, the direction of the tension"},
      {.name = "half_width",
       .dimension = dimensions::length,
       .range = positive,
       .default_value = 3.0,
       .meaning = "half of the plate's width, along x2"},
      {.name = "stress",
       .dimension = dimensions::pressure,
       .default_value = 1e9,
       .meaning = "sigma0, the tension far away"},
      {.name = "cloud",
       .type = Type::choice,
       .choices = {"shipped", "generated"},
       .default_value = "shipped",
       .meaning =
           "the files in meshes/ (188, 686, 2600, 5200 particles; others by the same generator), or a fresh cloud"},
      {.name = "cloud_seed",
       .type = Type::integer,
       .range = {.lower = 0},
       .default_value = std::int64_t{1},
       .meaning = "seed of a generated cloud"},
      {.name = "jitter",
       .range = {.lower = 0, .upper = 0.49},
       .default_value = 0.0,
       .meaning = "largest random move of a particle, in spacings (seed of the study)"},
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
       .default_value = "plane strain",
       .meaning = "plane model"},
  };
  benchmark.effects = {"elasticity"};
  benchmark.check = check;
  benchmark.counts_per_level = 1;
  return benchmark;
}

std::unique_ptr<problems::PlaneProblem> make_problem(const scene::Scene &scene, const scene::ProblemVariant &variant) {
  return std::make_unique<PlateWithHole>(scene, variant.parameters);
}

} // namespace comparisons::benchmarks::plate_with_hole
