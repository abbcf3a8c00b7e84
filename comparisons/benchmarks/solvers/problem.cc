#include "comparisons/benchmarks/solvers/problem.h"

#include "comparisons/benchmarks/solvers/systems.h"
#include "comparisons/methods/solver_keys.h"

#include "fem_reference/linear_algebra/algebraic_multigrid.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/stopwatch.h"
#include "meshless/linear_algebra/system_solver.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace comparisons::benchmarks::solvers {

namespace {

namespace linear_algebra = meshless::linear_algebra;
using linear_algebra::KrylovResult;
using meshless::elasticity::LinearSystem;
using scene::Parameters;
using scene::Type;
using MlCycle = fem_reference::linear_algebra::AlgebraicMultigrid;
using fem_reference::linear_algebra::Aggregation;

constexpr const char *ml = "ml";
constexpr const char *ml_unsymmetric = "ml_unsymmetric";

/// What an alternative has found, and what it took.
struct Outcome {
  KrylovResult solved;
  double setup = 0; ///< s
  double solve = 0; ///< s
  std::optional<std::size_t> bytes = {};
};

/// As the methods do: with iterative refinement, and the algebraic error from it (linear_algebra::LuResult).
Outcome by_sparse_lu(const LinearSystem &system, linear_algebra::Ordering ordering) {
  Outcome outcome;
  meshless::linear_algebra::Stopwatch watch;
  const linear_algebra::SparseLu lu(system.matrix, ordering);
  outcome.setup = watch.lap();
  auto result = linear_algebra::solve_lu(lu, system.matrix, system.right_hand_side);
  outcome.solve = watch.lap();
  outcome.bytes = lu.bytes();
  outcome.solved.solution = std::move(result.solution);
  outcome.solved.algebraic_error = result.algebraic_error;
  outcome.solved.converged = true;
  return outcome;
}

linear_algebra::KrylovTolerance tolerance_of(const Parameters &p) {
  return {.backward_error = p.real("backward_error"), .max_iterations = static_cast<int>(p.integer("max_iterations"))};
}

Outcome by_incomplete_factors(const LinearSystem &system, linear_algebra::Krylov krylov, const Parameters &p) {
  linear_algebra::PreconditionerSettings settings;
  settings.preconditioner = linear_algebra::preconditioner_of(p.text("preconditioner"));
  settings.ordering = linear_algebra::ordering_of(p.text("ordering"));
  if (p.has("drop"))
    settings.drop = p.real("drop");
  settings.fill = p.real("fill");
  Outcome outcome;
  meshless::linear_algebra::Stopwatch watch;
  linear_algebra::PreconditionedSystem preconditioned(system.matrix, settings);
  outcome.setup = watch.lap();
  outcome.solved = preconditioned.solve(krylov, system.right_hand_side, tolerance_of(p));
  outcome.solve = watch.lap();
  outcome.bytes = preconditioned.bytes();
  return outcome;
}

Outcome by_ml(const System &system, linear_algebra::Krylov krylov, const Parameters &p) {
  const auto &matrix = system.equations().matrix;
  const auto aggregation = p.text("preconditioner") == ml ? Aggregation::smoothed : Aggregation::smoothed_unsymmetric;
  MlCycle::start(); // once, and no part of the method's time
  Outcome outcome;
  meshless::linear_algebra::Stopwatch watch;
  const MlCycle cycle({matrix.offsets(), matrix.columns(), matrix.values()}, system.weak->positions(), aggregation);
  outcome.setup = watch.lap();
  outcome.solved = linear_algebra::solve_krylov(
      krylov, [&](auto x, auto y) { matrix.multiply(x, y); }, linear_algebra::maximum_norm(matrix),
      [&](auto r, auto x) { cycle.apply(r, x); }, system.equations().right_hand_side, tolerance_of(p));
  outcome.solve = watch.lap();
  return outcome;
}

bool is_ml(const Parameters &p) { return p.has("preconditioner") && p.text("preconditioner").starts_with(ml); }

Outcome solve(const System &system, const scene::MethodRequest &request) {
  const auto &p = request.parameters;
  if (request.name == "umfpack")
    return by_sparse_lu(system.equations(), linear_algebra::ordering_of(p.text("ordering")));
  const auto krylov = linear_algebra::krylov_of(request.name);
  return is_ml(p) ? by_ml(system, krylov, p) : by_incomplete_factors(system.equations(), krylov, p);
}

/// Names for the report.
std::map<std::string, std::string> names_of(const scene::MethodRequest &request) {
  std::map<std::string, std::string> names{{"method", request.name}};
  const auto &p = request.parameters;
  if (!is_ml(p)) // which numbers its aggregates itself
    names["ordering"] = p.text("ordering");
  if (p.has("preconditioner"))
    names["preconditioner"] = p.text("preconditioner");
  return names;
}

/// What the methods take by themselves, with nothing of it changed.
bool is_chosen(const scene::MethodRequest &request, std::int64_t n_unknowns) {
  const auto &p = request.parameters;
  if (names_of(request) != methods::names_of(linear_algebra::choose({}, n_unknowns)) || p.has("drop"))
    return false;
  return !p.has("backward_error") || p.real("backward_error") == linear_algebra::KrylovTolerance{}.backward_error;
}

class Solvers final : public study::Experiment {
public:
  Solvers(const scene::Scene &scene, const Parameters &problem)
      : scene_(scene), systems_(problem.text("system"), problem.integer("order"), scene.study.integer("seed")) {}

  void prepare() const override {
    for (const auto &method : scene_.methods)
      for (const auto &level : method.levels)
        systems_.at(level);
  }

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path & /*series_directory*/, reports::Cell &cell) const override {
    const System &system = systems_.at(level);
    const auto &equations = system.equations();
    cell.n_points = static_cast<std::int64_t>(system.n_points());
    cell.n_dofs = equations.matrix.n_rows();
    cell.nonzeros = equations.matrix.nonzeros();
    cell.linear_solver = names_of(request);
    cell.parameters["chosen"] = is_chosen(request, equations.matrix.n_rows());
    const auto outcome = solve(system, request);
    const auto &solved = outcome.solved;
    const double backward_error =
        linear_algebra::backward_error(equations.matrix, solved.solution, equations.right_hand_side);
    if (!solved.converged)
      throw std::runtime_error(fmt::format("no convergence: a backward error of {:.1e} after {} iterations",
                                           backward_error, solved.iterations));
    cell.seconds["setup"] = {outcome.setup, outcome.setup, outcome.setup};
    cell.seconds["solve"] = {outcome.solve, outcome.solve, outcome.solve};
    const double total = outcome.setup + outcome.solve;
    cell.seconds["total"] = {total, total, total};
    if (!with_errors)
      return;
    const double algebraic = linear_algebra::relative_distance(solved.solution, system.solution);
    cell.errors["algebraic_error"] = algebraic;
    cell.quantities = {{"backward_error", backward_error},
                       {"discretisation_error", system.discretisation_error},
                       {"algebraic_over_discretisation", algebraic / system.discretisation_error},
                       {"estimated_error", solved.algebraic_error}};
    if (solved.iterations > 0)
      cell.quantities["solver_iterations"] = solved.iterations;
    if (outcome.bytes)
      cell.quantities["factor_bytes"] = static_cast<double>(*outcome.bytes);
  }

  /// Measured of order 2, whose rows have some 150 entries.
  study::Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const override {
    study::Estimate e;
    e.n_points = static_cast<double>(systems_.n_points(level));
    e.n_dofs = 2 * e.n_points;
    const double matrix_bytes = 16 * 150 * e.n_dofs;
    const double power = e.n_dofs * std::sqrt(e.n_dofs);
    const bool direct = request.name == "umfpack";
    e.bytes = matrix_bytes + (direct ? 45 * power : matrix_bytes);
    e.seconds = direct ? 6e-7 * power : 4e-5 * e.n_dofs;
    return e;
  }

private:
  const scene::Scene &scene_;
  mutable Systems systems_;
};

std::vector<scene::Declaration> iteration_keys() {
  auto preconditioners = methods::preconditioner_names();
  preconditioners.insert(preconditioners.end(), {ml, ml_unsymmetric});
  return {{.name = "preconditioner",
           .type = Type::choice,
           .choices = std::move(preconditioners),
           .default_value = "thinned+coarse",
           .meaning =
               "incomplete factors on the matrix's pattern, on it less what is small, or with fill, each alone or "
               "with a coarse system; Trilinos ML with rigid-body modes, for symmetric or unsymmetric matrices"},
          {.name = "ordering",
           .type = Type::choice,
           .choices = methods::ordering_names(),
           .default_value = "rcm",
           .meaning = "order of elimination of incomplete factors"},
          {.name = "drop",
           .range = {.lower = 0, .upper = 1},
           .meaning = "blocks below this part of the largest of their row are left out; if absent 2e-3, of ilut 1e-2"},
          {.name = "fill",
           .range = {.lower = 0, .upper = 100, .lower_open = true},
           .default_value = 2.0,
           .meaning = "of ilut: blocks of a row of the factors over those of the matrix"},
          {.name = "backward_error",
           .range = {.lower = 1e-16, .upper = 1e-3},
           .default_value = 1e-15,
           .meaning = "at which the iteration ends; what is a hundred times larger is accepted"},
          {.name = "max_iterations",
           .type = Type::integer,
           .range = {.lower = 1, .upper = 100000},
           .default_value = std::int64_t{500},
           .meaning = "after which it is given up"}};
}

std::vector<scene::MethodDescription> method_descriptions() {
  std::vector<scene::MethodDescription> result(1);
  result[0].name = "umfpack";
  result[0].meaning = "sparse LU with partial pivoting";
  result[0].parameters = {{.name = "ordering",
                           .type = Type::choice,
                           .choices = methods::ordering_names(),
                           .default_value = "amd",
                           .meaning = "order of elimination"}};
  for (const auto &krylov : linear_algebra::krylov_table()) {
    auto &method = result.emplace_back();
    method.name = krylov.name;
    method.meaning = krylov.meaning;
    method.parameters = iteration_keys();
  }
  return result;
}

} // namespace

study::Benchmark benchmark() {
  study::Benchmark benchmark;
  auto &description = benchmark.description;
  description.name = "solvers";
  description.meaning = "linear solvers, orderings and preconditioners on systems of weak1";
  description.problem = {{.name = "system",
                          .type = Type::choice,
                          .choices = {"cantilever", "plate_with_hole"},
                          .default_value = "plate_with_hole",
                          .meaning = "whose system: on a grid, or on a graded cloud around a hole"},
                         {.name = "order",
                          .type = Type::integer,
                          .range = {.lower = 1, .upper = 4},
                          .default_value = std::int64_t{2},
                          .meaning = "order of the basis"}};
  description.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    if (context.level.counts.empty() || context.level.counts[0] < 100)
      diagnostics.error({}, "study.levels", "levels of this benchmark are numbers of particles from 100 up");
  };
  description.methods = method_descriptions();
  description.counts_per_level = 1;
  benchmark.make_experiment = [](const scene::Scene &scene, const scene::ProblemVariant &variant,
                                 const std::vector<methods::Method> &) -> std::unique_ptr<study::Experiment> {
    return std::make_unique<Solvers>(scene, variant.parameters);
  };
  return benchmark;
}

} // namespace comparisons::benchmarks::solvers
