#include "comparisons/benchmarks/smoothing_functions/problem.h"

#include "comparisons/problems/random.h"
#include "comparisons/reports/files.h"

#include "meshless/kernels/consistency.h"
#include "meshless/kernels/constructing.h"
#include "meshless/kernels/stress_growth.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace comparisons::benchmarks::smoothing_functions {

namespace {

namespace kernels = meshless::kernels;
using scene::Parameters;
using scene::Type;

kernels::Kernel kernel_of(const Parameters &parameters) {
  std::optional<double> support;
  std::optional<double> parameter;
  if (parameters.has("support"))
    support = parameters.real("support");
  if (parameters.has("kernel_parameter"))
    parameter = parameters.real("kernel_parameter");
  return kernels::make_kernel(parameters.text("kernel"), support, parameter);
}

/// The conditions from which the paper's section 3.3 makes its functions.
kernels::ConstructingConditions conditions_of(const std::string &name, int dim) {
  kernels::ConstructingConditions conditions;
  conditions.dim = dim;
  if (name == "dome") { // 3.3.1: a quadratic that vanishes at S = 1
    conditions.degree = 2;
    conditions.knots = {1};
    conditions.edge_derivatives = 1;
  } else if (name == "cubic_spline") { // 3.3.2: two pieces, W' continuous at the centre
    conditions.degree = 3;
    conditions.knots = {1, 2};
    conditions.zero_centre_derivatives = {1};
  } else if (name == "quintic") { // 3.3.3: three pieces, W' and W''' continuous at the centre
    conditions.degree = 5;
    conditions.knots = {1, 2, 3};
    conditions.zero_centre_derivatives = {1, 3};
  } else { // 3.3.4: a quartic with W = W' = 0 at S = 2 and the printed value at the centre
    conditions.degree = 4;
    conditions.knots = {2};
    conditions.edge_derivatives = 2;
    conditions.peak = kernels::smoothing_function(kernels::make_kernel("new_quartic", {}), dim).value(0);
  }
  return conditions;
}

/// Formulas as the paper prints them.
kernels::SmoothingFunction printed(const std::string &form, int dim) {
  kernels::SmoothingFunction function;
  const double pi = std::numbers::pi;
  const auto d = static_cast<std::size_t>(dim - 1);
  if (form == "cubic (41)") {
    const double alpha = std::array{1.0, 15 / (7 * pi), 3 / (2 * pi)}[d];
    function.value = [alpha](double s) {
      s = std::abs(s);
      return alpha * (s < 1 ? 2.0 / 3 - s * s + s * s * s / 2 : s < 2 ? (2 - s) * (2 - s) / 6 : 0);
    };
    function.slope = [alpha](double s) { return alpha * (s < 1 ? -2 * s + 1.5 * s * s : s < 2 ? -(2 - s) / 3 : 0); };
    function.support = 2;
    function.breaks = {1};
    return function;
  }
  const double alpha = std::array{1.0 / 120, 7 / (478 * pi), 3 / (359 * pi)}[d];
  const auto power = [](double x, int n) { return x > 0 ? std::pow(x, n) : 0.0; };
  function.value = [alpha, power](double s) {
    s = std::abs(s);
    return alpha * (power(3 - s, 5) - 6 * power(2 - s, 5) + 15 * power(1 - s, 5));
  };
  function.slope = [alpha, power](double s) {
    return -5 * alpha * (power(3 - s, 4) - 6 * power(2 - s, 4) + 15 * power(1 - s, 4));
  };
  function.support = 3;
  function.breaks = {1, 2};
  return function;
}

void add_report(const kernels::ConditionReport &report, std::map<std::string, double> &quantities) {
  using kernels::Condition;
  quantities["integral"] = report.moments[0];
  quantities["second_moment"] = report.moments[2];
  quantities["centre"] = report.centre;
  quantities["edge_value"] = report.edge_value;
  quantities["edge_slope"] = report.edge_slope;
  if (report.edge_curvature)
    quantities["edge_curvature"] = *report.edge_curvature;
  quantities["least_value"] = report.least_value;
  if (!report.negative.empty()) {
    quantities["negative_from"] = report.negative.front().first;
    quantities["negative_to"] = report.negative.back().second;
  }
  const std::pair<const char *, Condition> names[] = {{"normalised", Condition::normalised},
                                                      {"vanishes_at_edge", Condition::edge_value},
                                                      {"slope_vanishes_at_edge", Condition::edge_slope},
                                                      {"non_negative", Condition::non_negative},
                                                      {"monotone", Condition::monotone},
                                                      {"second_moment_vanishes", Condition::second_moment}};
  for (const auto &[name, condition] : names)
    quantities[std::string("holds_") + name] = report[condition].holds ? 1 : 0;
}

/// The sums (28), (29) of a kernel over particles of unit spacing, and what restoring their consistency (30)-(32)
/// makes of them, at a point inside, on the boundary, or among particles moved by a quarter of the spacing.
void add_discrete_sums(const Parameters &parameters, std::uint64_t seed, std::map<std::string, double> &quantities) {
  const double h = parameters.real("smoothing_length");
  const auto kernel = kernels::smoothing_function(kernel_of(parameters), 1);
  const std::string &place = parameters.text("place");
  std::vector<double> positions;
  problems::Random random(seed);
  for (int i = place == "boundary" ? 0 : -10; i <= 10; ++i)
    positions.push_back(i + (place == "irregular" ? 0.25 * random.symmetric() : 0));
  const std::vector<double> volumes(positions.size(), 1.0);
  const auto window = [&](double s) { return std::abs(s) < kernel.support ? kernel.value(std::abs(s)) : 0.0; };
  const auto order = static_cast<int>(parameters.integer("order"));
  const auto restored = kernels::restore_consistency(0, positions, volumes, h, order, window);
  double sum = 0;
  double moment = 0;
  std::vector<double> restored_moments(static_cast<std::size_t>(order) + 1);
  for (std::size_t j = 0; j < positions.size(); ++j) {
    const double s = -positions[j] / h;
    sum += window(s) / h;
    moment += s * window(s) / h;
    for (std::size_t k = 0; k < restored_moments.size(); ++k)
      restored_moments[k] += std::pow(s, static_cast<double>(k)) * restored.weights[j];
  }
  quantities["sum"] = sum;
  quantities["first_moment"] = moment;
  for (std::size_t k = 0; k < restored_moments.size(); ++k)
    quantities[fmt::format("restored_moment_{}", k)] = restored_moments[k];
  quantities["restored_least_weight"] = *std::min_element(restored.weights.begin(), restored.weights.end());
}

class SmoothingFunctions final : public study::Experiment {
public:
  SmoothingFunctions(int dim, std::uint64_t seed) : dim_(dim), seed_(seed) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &series_directory, reports::Cell &cell) const override {
    meshless::linear_algebra::Stopwatch watch;
    if (request.name == "discrete") {
      add_discrete_sums(request.parameters, seed_, cell.quantities);
      const double seconds = watch.lap();
      cell.seconds["total"] = {seconds, seconds, seconds};
      return;
    }
    if (request.name == "stability") {
      const auto kernel = kernels::smoothing_function(kernel_of(request.parameters), 1);
      const auto growth = kernels::stress_growth(kernel, request.parameters.real("smoothing_length"));
      cell.quantities["growth_in_tension"] = growth.tension;
      cell.quantities["growth_in_compression"] = growth.compression;
      const double seconds = watch.lap();
      cell.seconds["total"] = {seconds, seconds, seconds};
      return;
    }
    const auto function = make(request, cell);
    const double total = watch.lap();
    cell.dimension = 1;
    cell.n_points = level.counts.at(0);
    cell.seconds["total"] = {total, total, total};
    if (!with_errors)
      return;
    add_report(kernels::check_conditions(function, dim_), cell.quantities);
    if (request.name == "constructed") {
      const auto kernel =
          kernels::smoothing_function(kernels::make_kernel(request.parameters.text("construct"), {}), dim_);
      double largest = 0;
      for (int i = 0; i <= level.counts.at(0); ++i) {
        const double s = kernel.support * i / level.counts.at(0);
        largest = std::max(largest, std::abs(function.value(s) - kernel.value(s)));
      }
      cell.errors["difference_from_kernel"] = largest / kernel.value(0);
    }
    if (!series_directory.empty())
      write_series(function, level.counts.at(0), series_directory, cell);
    const double evaluation = watch.lap();
    cell.seconds["evaluation"] = {evaluation, evaluation, evaluation};
  }

  study::Estimate estimate(const scene::MethodRequest &, const scene::Level &level) const override {
    return {static_cast<double>(level.counts.at(0)), 0, 1e5, 1e-3};
  }

private:
  kernels::SmoothingFunction make(const scene::MethodRequest &request, reports::Cell &cell) const {
    if (request.name == "kernel")
      return kernels::smoothing_function(kernel_of(request.parameters), dim_);
    if (request.name == "printed")
      return printed(request.parameters.text("form"), dim_);
    const auto constructed = kernels::construct(conditions_of(request.parameters.text("construct"), dim_));
    for (std::size_t i = 0; i < constructed.parameters.size(); ++i)
      cell.quantities[fmt::format("parameter_{}", i + 1)] = constructed.parameters[i];
    return constructed.polynomial.smoothing_function();
  }

  static void write_series(const kernels::SmoothingFunction &function, int n, const std::filesystem::path &directory,
                           reports::Cell &cell) {
    std::string text = "s,w,w_s\n";
    for (int i = 0; i < n; ++i) {
      const double s = function.support * (i + 0.5) / n;
      text += fmt::format("{},{},{}\n", s, function.value(s), function.slope ? function.slope(s) : std::nan(""));
    }
    const std::string file = study::series_file(cell, "kernel");
    reports::write_file_atomically(directory / file, text);
    cell.series.push_back({"kernel", file});
  }

  int dim_;
  std::uint64_t seed_;
};

std::vector<std::string> names_of_kernels() {
  std::vector<std::string> names;
  for (const auto &kernel : kernels::kernel_table())
    names.emplace_back(kernel.name);
  return names;
}

std::vector<scene::MethodDescription> method_descriptions() {
  const auto positive = scene::Range{.lower = 0, .lower_open = true};
  scene::MethodDescription kernel;
  kernel.name = "kernel";
  kernel.meaning = "a kernel of the table, checked against the conditions";
  kernel.parameters = {
      {.name = "kernel",
       .type = Type::choice,
       .choices = names_of_kernels(),
       .default_value = "cubic_spline",
       .meaning = "kernel W"},
      {.name = "kernel_parameter", .range = positive, .meaning = "the kernel's own parameter, such as the decay a"},
      {.name = "support", .range = positive, .meaning = "support in units of h, for kernels with a free cut-off"},
  };
  kernel.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    try {
      kernel_of(context.method);
    } catch (const std::exception &error) {
      const char *key = context.method.is_given("support") ? "support" : "kernel_parameter";
      diagnostics.error(context.method.location(key), context.method_key + "." + key, error.what());
    }
  };
  scene::MethodDescription constructed;
  constructed.name = "constructed";
  constructed.meaning = "a polynomial made from its conditions by a linear system";
  constructed.parameters = {{.name = "construct",
                             .type = Type::choice,
                             .choices = {"dome", "cubic_spline", "quintic", "new_quartic"},
                             .default_value = "new_quartic",
                             .meaning = "whose conditions: sections 3.3.1 to 3.3.4"}};
  scene::MethodDescription as_printed;
  as_printed.name = "printed";
  as_printed.meaning = "a formula as the paper prints it";
  as_printed.parameters = {{.name = "form",
                            .type = Type::choice,
                            .choices = {"cubic (41)", "quintic (42)"},
                            .default_value = "cubic (41)",
                            .meaning = "which formula"}};
  scene::MethodDescription discrete;
  discrete.name = "discrete";
  discrete.meaning = "sums over particles, before and after restoring their consistency (1D)";
  discrete.parameters = kernel.parameters;
  discrete.parameters.insert(
      discrete.parameters.end(),
      {{.name = "order",
        .type = Type::integer,
        .range = {.lower = 0, .upper = 3},
        .default_value = std::int64_t{1},
        .meaning = "order of the consistency that is restored"},
       {.name = "smoothing_length", .range = {.lower = 0.5}, .default_value = 1.2, .meaning = "h over the spacing"},
       {.name = "place",
        .type = Type::choice,
        .choices = {"interior", "boundary", "irregular"},
        .default_value = "boundary",
        .meaning = "where the sums are taken"}});
  discrete.check = kernel.check;
  scene::MethodDescription stability;
  stability.name = "stability";
  stability.meaning = "growth of perturbations of a row of particles under stress (1D; Swegle, Hicks & Attaway 1995)";
  stability.parameters = kernel.parameters;
  stability.parameters.push_back(
      {.name = "smoothing_length", .range = {.lower = 0.5}, .default_value = 1.0, .meaning = "h over the spacing"});
  stability.check = kernel.check;
  return {kernel, constructed, as_printed, discrete, stability};
}

} // namespace

study::Benchmark benchmark() {
  study::Benchmark benchmark;
  auto &description = benchmark.description;
  description.name = "smoothing_functions";
  description.meaning = "kernels and their constructing conditions, Liu, Liu & Lam 2003, sections 2 and 3";
  description.problem = {{.name = "dimension",
                          .type = Type::integer,
                          .range = {.lower = 1, .upper = 3},
                          .default_value = std::int64_t{1},
                          .meaning = "dimension of space"}};
  description.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    if (context.level.counts.empty())
      diagnostics.error({}, "study.levels", "levels of this benchmark are numbers of points of a curve, such as 400");
  };
  description.methods = method_descriptions();
  description.counts_per_level = 1;
  benchmark.make_experiment = [](const scene::Scene &scene, const scene::ProblemVariant &variant,
                                 const std::vector<methods::Method> &) -> std::unique_ptr<study::Experiment> {
    return std::make_unique<SmoothingFunctions>(static_cast<int>(variant.parameters.integer("dimension")),
                                                static_cast<std::uint64_t>(scene.study.integer("seed")));
  };
  return benchmark;
}

} // namespace comparisons::benchmarks::smoothing_functions
