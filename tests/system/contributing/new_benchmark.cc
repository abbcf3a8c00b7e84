// A new benchmark: its keys, its methods, its experiment, one line in the catalogue; run on a scene and held against
// theory.

#include "comparisons/metrics/slopes.h"
#include "comparisons/scene/reader.h"
#include "comparisons/study/catalogue.h"
#include "comparisons/study/run_scene.h"
#include "meshless/basis/basis_table.h"
#include "meshless/basis/grouped_evaluation.h"
#include "meshless/linear_algebra/stopwatch.h"
#include "system/contributing/checks.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace comparisons::benchmarks::wave_derivative {

namespace {

using scene::Type;

/// sin(k x) on a line: particles, spacing d, wave number k.
struct Wave {
  int n;
  double spacing;
  double wave_number;

  Wave(const scene::Parameters &problem, const scene::Level &level) {
    const double length = problem.real("length");
    n = level.spacing ? 1 + static_cast<int>(std::lround(length / *level.spacing)) : level.counts.at(0);
    spacing = length / (n - 1);
    wave_number = 2 * std::numbers::pi * static_cast<double>(problem.integer("waves")) / length;
  }
  double middle() const { return spacing * (n / 2); }
  double value(double x) const { return std::sin(wave_number * x); }
  double derivative(double x) const { return wave_number * std::cos(wave_number * x); }
};

double central_difference(const Wave &wave) {
  const double x = wave.middle();
  return (wave.value(x + wave.spacing) - wave.value(x - wave.spacing)) / (2 * wave.spacing);
}

double ssph(const Wave &wave, const scene::Parameters &method) {
  namespace basis = meshless::basis;
  std::vector<meshless::cloud::Point<1>> positions;
  for (int i = 0; i < wave.n; ++i)
    positions.push_back({wave.spacing * i});
  const meshless::cloud::Particles<1> particles(std::move(positions), std::vector<double>(wave.n, wave.spacing));
  const auto kernel = meshless::kernels::Gauss(method.real("support"));
  const auto shape = basis::make_basis<1>("ssph", static_cast<int>(method.integer("order")), kernel);
  const meshless::cloud::CandidateSearch<1> search(particles, shape->support());
  const std::vector<meshless::cloud::Point<1>> point{{wave.middle()}};
  double result = 0;
  basis::GroupedEvaluation<1>(*shape, search).visit(point, {.gradient = true}, [&](const auto &group) {
    for (std::size_t j = 0; j < group.n_neighbours(0); ++j)
      result += group.values.gradient(0, j)[0] * wave.value(particles.position(group.neighbour(j, 0))[0]);
  });
  return result;
}

class WaveDerivative final : public study::Experiment {
public:
  explicit WaveDerivative(const scene::ProblemVariant &variant) : problem_(variant.parameters) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &, reports::Cell &cell) const override {
    const Wave wave(problem_, level);
    meshless::linear_algebra::Stopwatch watch;
    const double derivative = request.name == "ssph" ? ssph(wave, request.parameters) : central_difference(wave);
    const double seconds = watch.lap();
    cell.n_points = wave.n;
    cell.seconds["recovery"] = cell.seconds["total"] = {seconds, seconds, seconds};
    if (with_errors) {
      const double exact = wave.derivative(wave.middle());
      cell.errors["derivative_relative"] = std::abs(derivative / exact - 1);
    }
  }

  study::Estimate estimate(const scene::MethodRequest &, const scene::Level &level) const override {
    const Wave wave(problem_, level);
    return {.n_points = 1.0 * wave.n, .n_dofs = 0, .bytes = 100.0 * wave.n, .seconds = 1e-6 * wave.n};
  }

private:
  scene::Parameters problem_;
};

scene::BenchmarkDescription description() {
  scene::BenchmarkDescription benchmark;
  benchmark.name = "wave_derivative";
  benchmark.meaning = "derivative of a sine in the middle of a line";
  benchmark.problem = {{.name = "length",
                        .dimension = scene::dimensions::length,
                        .range = {.lower = 0, .lower_open = true},
                        .default_value = 1.0,
                        .meaning = "length of the line, in m"},
                       {.name = "waves",
                        .type = Type::integer,
                        .range = {.lower = 1, .upper = 1000},
                        .default_value = std::int64_t{1},
                        .meaning = "wavelengths on the line"}};
  benchmark.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    const Wave wave(context.problem, context.level);
    if (wave.n % 2 == 0 || wave.n < 5)
      diagnostics.error({}, "study.levels",
                        fmt::format("the level {} has {} particles; the middle is a particle for an odd number of 5 "
                                    "or more",
                                    context.level.text, wave.n));
  };
  benchmark.methods = {{.name = "central_difference",
                        .meaning = "difference of the two neighbours",
                        .parameters = {},
                        .effects = {},
                        .check = {}},
                       {.name = "ssph",
                        .meaning = "symmetric smoothed particle hydrodynamics",
                        .parameters = {{.name = "order",
                                        .type = Type::integer,
                                        .range = {.lower = 1, .upper = 4},
                                        .default_value = std::int64_t{2},
                                        .meaning = "degree of the monomials"},
                                       {.name = "support",
                                        .range = {.lower = 1, .upper = 20},
                                        .default_value = 4.0,
                                        .meaning = "radius of the support over h"}},
                        .effects = {},
                        .check = {}}};
  benchmark.counts_per_level = 1;
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<WaveDerivative>(variant);
          },
          [](std::vector<reports::Cell> &cells) { metrics::add_slopes("derivative_relative", cells); }};
}

} // namespace comparisons::benchmarks::wave_derivative

namespace {

using namespace comparisons;

constexpr const char *scene_text = R"(schema = 1
title = "Two waves on two metres"
benchmark = "wave_derivative"
[problem]
length = "200 cm"
waves = 2
[[method]]
name = "central_difference"
[[method]]
name = "ssph"
order = [1, 2]
[study]
levels = [41, 81, 161]
repeats = 1
)";

/// Relative error that theory gives at spacing d. The central difference of sin(k x) is k cos(k x) sin(k d) / (k d).
/// SSPH of order 1 or 2 at a particle with neighbours on both sides alike is the mean of such differences over l
/// spacings, weighted with W(l) l^2.
double error_in_theory(const std::string &method, double k, double d) {
  const auto error_over = [&](double distance) { return 1 - std::sin(k * distance) / (k * distance); };
  if (method == "central_difference")
    return error_over(d);
  const meshless::kernels::Gauss kernel(4);
  double sum = 0;
  double weights = 0;
  for (int l = 1; l < 4; ++l) { // the particles at l = 4, on the edge, have the weight 0
    const double weight = kernel.value(1.0 * l * l) * l * l;
    sum += weight * error_over(l * d);
    weights += weight;
  }
  return sum / weights;
}

void check_run(contributing::Checks &checks, const study::Catalogue &catalogue) {
  const auto read = scene::read_scene_text(scene_text, "waves.toml", {}, study::vocabulary_of(catalogue));
  checks.holds("the scene is valid " + scene::to_text(read.diagnostics), read.scene.has_value());
  if (!read.scene)
    return;
  study::RunOptions options;
  options.write_series = false;
  const auto cells = study::run_scene(*read.scene, catalogue, options);
  checks.near("cells", static_cast<double>(cells.size()), 9, 0);
  for (const auto &cell : cells) {
    const std::string name = cell.label + " " + cell.level;
    checks.holds(name + " is ok " + cell.reason, cell.status == reports::Status::ok);
    if (cell.status != reports::Status::ok)
      continue;
    const double spacing = 2.0 / (static_cast<double>(cell.n_points) - 1);
    // Two metres with two waves: k = 2 pi. The rounding of sin(k x) is divided by k d >= 0.07.
    checks.near(name, cell.errors.at("derivative_relative"),
                error_in_theory(cell.method, 2 * std::numbers::pi, spacing), 1e-13);
    // Slopes are taken against the number of particles, not of spacings: 2 log(4) / log(161 / 41) = 2.03.
    if (cell.level == "161")
      checks.near(name + ", slope", cell.quantities.at("derivative_relative_slope"), 2, 0.05);
  }
}

void check_refusal(contributing::Checks &checks, const study::Catalogue &catalogue) {
  const std::vector<std::string> overrides{"study.levels=[40]"};
  const auto read = scene::read_scene_text(scene_text, "waves.toml", overrides, study::vocabulary_of(catalogue));
  const std::string findings = scene::to_text(read.diagnostics);
  checks.holds("an even number of particles is refused: " + findings,
               !read.scene && findings.find("40 particles") != std::string::npos);
}

} // namespace

int main() {
  contributing::Checks checks;
  study::Catalogue catalogue = study::shipped_catalogue();
  catalogue.benchmarks.push_back(benchmarks::wave_derivative::benchmark());
  check_run(checks, catalogue);
  check_refusal(checks, catalogue);
  return checks.exit_code();
}
