#include "comparisons/benchmarks/function_approximation/problem.h"

#include "comparisons/benchmarks/function_approximation/arrangement.h"
#include "comparisons/benchmarks/function_approximation/estimate.h"
#include "comparisons/metrics/memory.h"
#include "comparisons/metrics/slopes.h"
#include "comparisons/reports/files.h"
#include "comparisons/scene/expression.h"

#include "fem_reference/approximation/lagrange_interpolant.h"

#include "meshless/basis/basis_table.h"
#include "meshless/basis/derivative_operators.h"
#include "meshless/basis/grouped_evaluation.h"
#include "meshless/cloud/candidate_search.h"
#include "meshless/kernels/kernel_table.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

namespace comparisons::benchmarks::function_approximation {

namespace {

using meshless::linear_algebra::Stopwatch;
using scene::Declaration;
using scene::Parameters;
using scene::Type;

meshless::kernels::Kernel kernel_of(const Parameters &parameters) {
  std::optional<double> support;
  std::optional<double> parameter;
  if (parameters.has("support"))
    support = parameters.real("support");
  if (parameters.has("kernel_parameter"))
    parameter = parameters.real("kernel_parameter");
  return meshless::kernels::make_kernel(parameters.text("kernel"), support, parameter);
}

/// The scene's order, else 2 or what the basis has nearest to it.
int order_of(const Parameters &parameters) {
  if (parameters.has("order"))
    return static_cast<int>(parameters.integer("order"));
  const auto &basis = meshless::basis::describe_basis(parameters.text("basis"));
  return std::clamp(2, basis.lowest_order, basis.highest_order);
}

/// Second derivatives at the particles, and at any point.
bool has_hessian_at_particles(const Parameters &parameters) {
  const auto &basis = meshless::basis::describe_basis(parameters.text("basis"));
  return !basis.hessian_anywhere || basis.highest_order == 0 || order_of(parameters) >= 2;
}

bool has_hessian_anywhere(const Parameters &parameters) {
  return meshless::basis::describe_basis(parameters.text("basis")).hessian_anywhere &&
         has_hessian_at_particles(parameters);
}

meshless::basis::BasisOptions options_of(const Parameters &parameters) {
  meshless::basis::BasisOptions options;
  options.volumes = parameters.boolean("volumes");
  options.edge =
      parameters.text("edge") == "included" ? meshless::basis::EdgeRule::included : meshless::basis::EdgeRule::excluded;
  return options;
}

/// The particles, basis and coefficients of one cell: evaluates anywhere.
template <int dim>
class ParticleEstimate {
public:
  ParticleEstimate(const Arrangement<dim> &arrangement, const Parameters &parameters, const Expression &function)
      : particles_(make_particles(arrangement, parameters)),
        basis_(meshless::basis::make_basis<dim>(parameters.text("basis"), order_of(parameters), kernel_of(parameters),
                                                options_of(parameters))),
        has_hessian_(has_hessian_anywhere(parameters)), has_hessian_at_particles_(has_hessian_at_particles(parameters)),
        search_(particles_, basis_->support()) {
    for (const auto &x : arrangement.positions) {
      std::array<double, 3> point{};
      std::copy(x.begin(), x.end(), point.begin());
      coefficients_.push_back(function.value(point));
    }
  }

  Values<dim> evaluate(std::span<const std::array<double, dim>> points) const {
    Values<dim> result;
    result.resize(points.size());
    const meshless::basis::GroupedEvaluation<dim> evaluation(*basis_, search_);
    evaluation.visit(points, {.value = true, .gradient = true, .hessian = has_hessian()},
                     [&](const auto &group) { add(group, result); });
    return result;
  }

  /// At the particles: there every basis has its second derivatives, some only there.
  /// @param n_indefinite particles whose moment matrix was not positive definite
  Values<dim> evaluate_at_particles(std::size_t &n_indefinite) const {
    Values<dim> result;
    result.resize(particles_.size());
    const auto operators = meshless::basis::make_derivative_operators<dim>(
        *basis_, particles_, {.value = true, .gradient = true, .hessian = has_hessian_at_particles_});
    n_indefinite = operators.n_indefinite;
    operators.value->multiply(coefficients_, result.value);
    std::vector<double> product(particles_.size());
    for (std::size_t k = 0; k < operators.gradient.size(); ++k) {
      operators.gradient[k].multiply(coefficients_, product);
      for (std::size_t i = 0; i < product.size(); ++i)
        result.gradient[i][k] = product[i];
    }
    for (std::size_t kl = 0; kl < operators.hessian.size(); ++kl) {
      operators.hessian[kl].multiply(coefficients_, product);
      for (std::size_t i = 0; i < product.size(); ++i)
        result.hessian[i][kl] = product[i];
    }
    return result;
  }

  /// Second derivatives at any point.
  bool has_hessian() const { return has_hessian_; }

  /// Rows of shape functions for all particles at one point: value, first, second derivative (1D).
  const meshless::basis::ShapeFunctions<dim> &basis() const { return *basis_; }
  const meshless::cloud::CandidateSearch<dim> &search() const { return search_; }

private:
  static meshless::cloud::Particles<dim> make_particles(const Arrangement<dim> &arrangement,
                                                        const Parameters &parameters) {
    auto h = arrangement.spacing;
    for (double &length : h)
      length *= parameters.real("smoothing_length");
    return {arrangement.positions, std::move(h), arrangement.volumes};
  }

  void add(const typename meshless::basis::GroupedEvaluation<dim>::Group &group, Values<dim> &result) const {
    for (std::size_t p = 0; p < group.points.size(); ++p)
      for (std::size_t j = 0; j < group.n_neighbours(p); ++j) {
        const double f = coefficients_[static_cast<std::size_t>(group.neighbour(j, p))];
        const std::size_t i = group.points[p];
        result.value[i] += group.values.value(j)[p] * f;
        for (int k = 0; k < dim; ++k)
          result.gradient[i][static_cast<std::size_t>(k)] += group.values.gradient(k, j)[p] * f;
        if (has_hessian_)
          for (int kl = 0; kl < Values<dim>::n_hessian; ++kl)
            result.hessian[i][static_cast<std::size_t>(kl)] += group.values.hessian(kl, j)[p] * f;
      }
  }

  meshless::cloud::Particles<dim> particles_;
  std::unique_ptr<meshless::basis::ShapeFunctions<dim>> basis_;
  bool has_hessian_;
  bool has_hessian_at_particles_;
  meshless::cloud::CandidateSearch<dim> search_;
  std::vector<double> coefficients_;
};

/// c1 and c2 of (6.13), (6.14) from the shape functions of an interior particle and from the kernel.
void add_coefficients(const ParticleEstimate<1> &estimate, const Arrangement<1> &arrangement,
                      const Parameters &parameters, std::map<std::string, double> &quantities) {
  const std::size_t n = arrangement.positions.size();
  const double factor = parameters.real("smoothing_length");
  const auto kernel = kernel_of(parameters);
  const double reach = factor * meshless::kernels::support_of(kernel);
  if (n < 7 || parameters.text("basis") != "ssph" || order_of(parameters) != 2 || reach <= 2 || reach > 3)
    return; // the formulas hold for four neighbours
  const auto weight = [&](double steps) {
    const double s = steps / factor;
    return std::visit([&](const auto &k) { return k.value(s * s); }, kernel);
  };
  const double w0 = weight(0);
  const double w1 = weight(1);
  const double w2 = weight(2);
  quantities["c1_formula"] = (w2 / w0) / (1 + 16 * w2 / w1 + 18 * w2 / w0);
  quantities["c2_formula"] = (w2 / w1) / (w2 / w1 + 0.25);
  const std::size_t centre = n / 2;
  const meshless::basis::GroupedEvaluation<1> evaluation(estimate.basis(), estimate.search());
  evaluation.visit({&arrangement.positions[centre], 1}, {.value = true, .gradient = true}, [&](const auto &group) {
    for (std::size_t j = 0; j < group.n_neighbours(0); ++j) {
      const auto particle = static_cast<std::size_t>(group.neighbour(j, 0));
      if (particle == centre + 1)
        quantities["c1"] = group.values.value(j)[0] / 12;
      if (particle == centre + 2)
        quantities["c2"] = group.values.gradient(0, j)[0] * 4 * arrangement.spacing[centre];
    }
  });
}

/// Between the first and the last particle along an axis: outside of it a cell-centred row of particles
/// has too few neighbours on one side, and the papers never estimate there.
struct Hull {
  double begin = 0;
  double end = 1;
};

template <int dim>
Hull hull_of(const Arrangement<dim> &arrangement) {
  Hull hull{arrangement.positions[0][0], arrangement.positions[0][0]};
  for (const auto &position : arrangement.positions) {
    hull.begin = std::min(hull.begin, position[0]);
    hull.end = std::max(hull.end, position[0]);
  }
  return hull;
}

std::vector<std::array<double, 1>> line(const Hull &hull, int n) {
  std::vector<std::array<double, 1>> points;
  for (int i = 0; i <= n; ++i)
    points.push_back({hull.begin + (hull.end - hull.begin) * i / n});
  return points;
}

/// Estimates and shape functions on a fine line, Figs. 1 and 2.
void write_series(const ParticleEstimate<1> &estimate, const Expression &function, const Hull &hull,
                  const std::filesystem::path &directory, reports::Cell &cell) {
  const auto points = line(hull, 200);
  const auto computed = estimate.evaluate(points);
  const auto exact = exact_values<1>(function, points);
  std::string text = "x,f,f_x,f_xx,exact_f,exact_f_x,exact_f_xx\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{},{},{},{},{},{},{}\n", points[i][0], computed.value[i], computed.gradient[i][0],
                        computed.hessian[i][0], exact.value[i], exact.gradient[i][0], exact.hessian[i][0]);
  const std::string file = study::series_file(cell, "estimate");
  reports::write_file_atomically(directory / file, text);
  cell.series.push_back({"estimate", file});
}

void write_shape_functions(const ParticleEstimate<1> &estimate, const Hull &hull,
                           const std::filesystem::path &directory, reports::Cell &cell) {
  // The shape functions of the particle nearest to the middle.
  const auto points = line(hull, 400);
  const auto middle = static_cast<meshless::cloud::Index>(estimate.search().particles().size() / 2);
  std::vector<std::array<double, 3>> shapes(points.size());
  const meshless::basis::GroupedEvaluation<1> evaluation(estimate.basis(), estimate.search());
  evaluation.visit(points, {.value = true, .gradient = true, .hessian = true}, [&](const auto &group) {
    for (std::size_t p = 0; p < group.points.size(); ++p)
      for (std::size_t j = 0; j < group.n_neighbours(p); ++j)
        if (group.neighbour(j, p) == middle)
          shapes[group.points[p]] = {group.values.value(j)[p], group.values.gradient(0, j)[p],
                                     group.values.hessian(0, j)[p]};
  });
  std::string text = "x,shape,shape_x,shape_xx\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{},{},{},{}\n", points[i][0], shapes[i][0], shapes[i][1], shapes[i][2]);
  const std::string file = study::series_file(cell, "shape_function");
  reports::write_file_atomically(directory / file, text);
  cell.series.push_back({"shape_function", file});
}

template <int dim>
class Approximation final : public study::Experiment {
public:
  Approximation(const Parameters &problem, std::uint64_t seed)
      : function_(problem.text("function"), dim), arrangement_(problem.text("arrangement")),
        jitter_(problem.real("jitter")), seed_(seed) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &series_directory, reports::Cell &cell) const override {
    if (request.name == "fem")
      run_fem(request, level, with_errors, cell);
    else
      try {
        run_particles(request, level, with_errors, series_directory, cell);
      } catch (const meshless::basis::SingularMomentMatrix &error) {
        throw methods::Refused(error.what());
      }
  }

  study::Estimate estimate(const scene::MethodRequest &, const scene::Level &level) const override {
    const auto arrangement = arrange<dim>(arrangement_, level.counts.at(0), jitter_, seed_);
    study::Estimate e;
    e.n_points = static_cast<double>(arrangement.positions.size());
    e.n_dofs = e.n_points;
    e.bytes = 1e3 * e.n_points;
    e.seconds = 1e-5 * e.n_points;
    return e;
  }

private:
  /// The function at the particles of a level and at the points of its quadrature: numerical derivatives are
  /// dear, and all methods need the same.
  struct Exact {
    Values<dim> at_particles;
    WeightedPoints<dim> rule;
    Values<dim> at_points;
  };

  const Exact &exact_at(const std::string &key, const Arrangement<dim> &arrangement) const {
    if (const auto found = exact_.find(key); found != exact_.end())
      return found->second;
    Exact exact;
    exact.at_particles = exact_values<dim>(function_, arrangement.positions);
    const auto n =
        static_cast<int>(std::lround(std::pow(static_cast<double>(arrangement.positions.size()), 1.0 / dim)));
    const Hull hull = hull_of(arrangement);
    exact.rule = quadrature<dim>(hull.begin, hull.end, quadrature_cells(n));
    exact.at_points = exact_values<dim>(function_, exact.rule.points);
    return exact_[key] = std::move(exact);
  }

  int quadrature_cells(int n) const { return dim == 1 ? std::max(200, 2 * n) : dim == 2 ? 2 * n : n; }

  void run_particles(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
                     const std::filesystem::path &series_directory, reports::Cell &cell) const {
    const int n = level.counts.at(0);
    const metrics::PeakMemory memory;
    Stopwatch watch;
    const auto arrangement = arrange<dim>(arrangement_, n, jitter_, seed_);
    const double points_seconds = watch.lap();
    const ParticleEstimate<dim> estimate(arrangement, request.parameters, function_);
    const double neighbour_seconds = watch.lap();
    std::size_t n_indefinite = 0;
    const auto at_particles = estimate.evaluate_at_particles(n_indefinite);
    const double basis_seconds = watch.lap();
    const double total = points_seconds + neighbour_seconds + basis_seconds;
    cell.memory_bytes = memory.bytes();
    cell.dimension = dim;
    cell.n_points = static_cast<std::int64_t>(arrangement.positions.size());
    cell.n_dofs = cell.n_points;
    for (const auto &[phase, seconds] :
         {std::pair{"points", points_seconds}, std::pair{"neighbours", neighbour_seconds},
          std::pair{"basis", basis_seconds}, std::pair{"total", total}})
      cell.seconds[phase] = {seconds, seconds, seconds};
    if (n_indefinite > 0)
      cell.warnings.push_back(
          fmt::format("the moment matrix of {} particles is not positive definite, as the kernel is "
                      "negative in places; solved by LU with complete pivoting",
                      n_indefinite));
    if (!with_errors)
      return;
    if (n_indefinite > 0)
      cell.quantities["n_pivoted"] = static_cast<double>(n_indefinite);
    watch.lap();
    const auto &exact = exact_at(level.text, arrangement);
    add_errors<dim>(at_particles, exact.at_particles, arrangement.volumes, "_sum", cell.errors);
    add_errors<dim>(estimate.evaluate(exact.rule.points), exact.at_points, exact.rule.weights, "", cell.errors);
    if (!estimate.has_hessian())
      cell.errors.erase("h2");
    if (!has_hessian_at_particles(request.parameters))
      cell.errors.erase("h2_sum");
    if constexpr (dim == 1) {
      if (arrangement_ == "uniform")
        add_coefficients(estimate, arrangement, request.parameters, cell.quantities);
      if (!series_directory.empty() && estimate.has_hessian()) {
        write_series(estimate, function_, hull_of(arrangement), series_directory, cell);
        write_shape_functions(estimate, hull_of(arrangement), series_directory, cell);
      }
    }
    const double evaluation = watch.lap();
    cell.seconds["evaluation"] = {evaluation, evaluation, evaluation};
  }

  void run_fem(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
               reports::Cell &cell) const {
    const int n = level.counts.at(0);
    const int degree = request.parameters.text("element").back() - '0';
    Stopwatch watch;
    // As many nodes an axis as there are particles, to the nearest whole number of cells.
    const int n_cells = std::max(1, static_cast<int>(std::lround(static_cast<double>(n - 1) / degree)));
    const fem_reference::approximation::LagrangeInterpolant<dim> interpolant(
        [&](const std::array<double, dim> &x) {
          std::array<double, 3> point{};
          std::copy(x.begin(), x.end(), point.begin());
          return function_.value(point);
        },
        degree, n_cells);
    const double total = watch.lap();
    cell.n_dofs = static_cast<std::int64_t>(interpolant.n_dofs());
    cell.dimension = dim;
    cell.n_points = cell.n_dofs;
    cell.seconds["total"] = {total, total, total};
    if (!with_errors)
      return;
    const auto evaluate = [&](std::span<const std::array<double, dim>> points) {
      Values<dim> values;
      values.resize(points.size());
      interpolant.evaluate(points, values.value, values.gradient, values.hessian);
      return values;
    };
    // The same points as for the particle methods, and the interpolant's own domain is the unit interval.
    const auto arrangement = arrange<dim>("uniform", n, 0, 0);
    const auto &exact = exact_at("uniform " + level.text, arrangement);
    add_errors<dim>(evaluate(exact.rule.points), exact.at_points, exact.rule.weights, "", cell.errors);
    add_errors<dim>(evaluate(arrangement.positions), exact.at_particles, arrangement.volumes, "_sum", cell.errors);
    const double evaluation = watch.lap();
    cell.seconds["evaluation"] = {evaluation, evaluation, evaluation};
  }

  Expression function_;
  std::string arrangement_;
  double jitter_;
  std::uint64_t seed_;
  mutable std::map<std::string, Exact> exact_;
};

std::unique_ptr<study::Experiment> make_experiment(const scene::Scene &scene, const scene::ProblemVariant &variant,
                                                   const std::vector<methods::Method> &) {
  const auto &problem = variant.parameters;
  const auto seed = static_cast<std::uint64_t>(scene.study.integer("seed"));
  switch (problem.integer("dimension")) {
  case 1:
    return std::make_unique<Approximation<1>>(problem, seed);
  case 2:
    return std::make_unique<Approximation<2>>(problem, seed);
  default:
    return std::make_unique<Approximation<3>>(problem, seed);
  }
}

void check_problem(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &problem = context.problem;
  const auto dim = static_cast<int>(problem.integer("dimension"));
  try {
    const Expression function(problem.text("function"), dim);
    for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0})
      function.value({x, x, x});
  } catch (const std::exception &error) {
    diagnostics.error(problem.location("function"), "problem.function", error.what(),
                      "an expression such as \"sin(8*(1-x))/sin(8)\", finite on [0, 1]");
  }
  if (context.level.counts.empty())
    diagnostics.error({}, "study.levels",
                      "levels of this benchmark are numbers of particles along an axis, such as 20");
  else if (context.level.counts[0] < 3)
    diagnostics.error({}, "study.levels",
                      fmt::format("{} particles along an axis; at least 3 are needed", context.level.counts[0]));
}

void check_estimate(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &method = context.method;
  const char *key = method.is_given("kernel_parameter") ? "kernel_parameter"
                    : method.is_given("support")        ? "support"
                                                        : "kernel";
  try {
    const auto kernel = kernel_of(method);
    key = "basis";
    const auto order = order_of(method);
    switch (context.problem.integer("dimension")) {
    case 1:
      meshless::basis::make_basis<1>(method.text("basis"), order, kernel, options_of(method));
      break;
    case 2:
      meshless::basis::make_basis<2>(method.text("basis"), order, kernel, options_of(method));
      break;
    default:
      meshless::basis::make_basis<3>(method.text("basis"), order, kernel, options_of(method));
    }
  } catch (const std::exception &error) {
    diagnostics.error(method.location(key), context.method_key + "." + key, error.what());
  }
}

std::vector<std::string> names_of_kernels() {
  std::vector<std::string> names;
  for (const auto &kernel : meshless::kernels::kernel_table())
    names.emplace_back(kernel.name);
  return names;
}

std::vector<std::string> names_of_bases() {
  std::vector<std::string> names;
  for (const auto &basis : meshless::basis::basis_table())
    names.emplace_back(basis.name);
  return names;
}

scene::MethodDescription estimate_description() {
  const auto positive = scene::Range{.lower = 0, .lower_open = true};
  scene::MethodDescription method;
  method.name = "estimate";
  method.meaning = "kernel estimate of the function by a meshless basis";
  method.parameters = {
      {.name = "basis",
       .type = Type::choice,
       .choices = names_of_bases(),
       .default_value = "ssph",
       .meaning = "how shape functions are made"},
      {.name = "kernel",
       .type = Type::choice,
       .choices = names_of_kernels(),
       .default_value = "revised_gauss",
       .meaning = "kernel W of the basis"},
      {.name = "kernel_parameter", .range = positive, .meaning = "the kernel's own parameter, such as the decay a"},
      {.name = "support", .range = positive, .meaning = "support in units of h, for kernels with a free cut-off"},
      {.name = "order",
       .type = Type::integer,
       .range = {.lower = 0, .upper = 4},
       .meaning = "degree of the complete monomials; if absent 2, or the basis's own"},
      {.name = "smoothing_length", .range = positive, .default_value = 1.5, .meaning = "h over the local spacing"},
      {.name = "volumes", .type = Type::boolean, .default_value = true, .meaning = "weigh with m/rho"},
      {.name = "edge",
       .type = Type::choice,
       .choices = {"excluded", "included"},
       .default_value = "excluded",
       .meaning = "particles exactly on the edge of a support, to 1e-12: W = 0 there, its derivatives are not"},
  };
  method.check = check_estimate;
  return method;
}

scene::MethodDescription fem_description() {
  scene::MethodDescription method;
  method.name = "fem";
  method.meaning = "finite-element interpolant with as many nodes as particles";
  method.parameters = {{.name = "element",
                        .type = Type::choice,
                        .choices = {"Q1", "Q2", "Q3", "Q4"},
                        .default_value = "Q1",
                        .meaning = "Lagrange element"}};
  return method;
}

} // namespace

study::Benchmark benchmark() {
  study::Benchmark benchmark;
  auto &description = benchmark.description;
  description.name = "function_approximation";
  description.meaning = "kernel estimates of a function, Zhang & Batra 2008, sections 6.1 and 6.2";
  description.problem = {
      {.name = "function",
       .type = Type::text,
       .default_value = "sin(8*(1-x))/sin(8)",
       .meaning = "f, an expression in x (y, z)"},
      {.name = "dimension",
       .type = Type::integer,
       .range = {.lower = 1, .upper = 3},
       .default_value = std::int64_t{1},
       .meaning = "1: unit interval, 2: square, 3: cube"},
      {.name = "arrangement",
       .type = Type::choice,
       .choices = {"uniform", "graded", "jittered"},
       .default_value = "uniform",
       .meaning = "how the particles lie"},
      {.name = "jitter",
       .range = {.lower = 0, .upper = 0.49},
       .default_value = 0.25,
       .meaning = "largest random move in spacings, for the jittered arrangement"},
  };
  description.effects = {};
  description.check = check_problem;
  description.methods = {estimate_description(), fem_description()};
  description.counts_per_level = 1;
  benchmark.make_experiment = make_experiment;
  benchmark.finish = [](std::vector<reports::Cell> &cells) {
    for (const char *error : {"l2_sum", "h1_sum", "h2_sum", "l2", "h1", "h2"})
      metrics::add_slopes(error, cells);
  };
  return benchmark;
}

} // namespace comparisons::benchmarks::function_approximation
