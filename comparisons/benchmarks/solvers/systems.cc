#include "comparisons/benchmarks/solvers/systems.h"

#include "comparisons/benchmarks/cantilever/problem.h"
#include "comparisons/benchmarks/plate_with_hole/problem.h"
#include "comparisons/methods/particle_keys.h"
#include "comparisons/metrics/error_norms.h"
#include "comparisons/scene/default_parameters.h"

#include "meshless/linear_algebra/sparse_lu.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::benchmarks::solvers {

namespace {

namespace linear_algebra = meshless::linear_algebra;
using scene::Value;

std::unique_ptr<problems::PlaneProblem> problem_of(const std::string &name, std::int64_t seed) {
  const bool cantilever = name == "cantilever";
  const auto description = cantilever ? cantilever::description() : plate_with_hole::description();
  scene::Scene scene;
  scene.material = scene::default_parameters(description.material, {});
  scene.study = scene::default_parameters(
      {{.name = "seed", .type = scene::Type::integer, .default_value = seed, .meaning = "of generated clouds"}}, {});
  scene.effects = {"elasticity"};
  std::map<std::string, Value> given;
  if (cantilever) {
    scene.effects.emplace_back("body_force");
    given["solution"] = std::string("trigonometric");
  }
  const scene::ProblemVariant variant{scene::default_parameters(description.problem, given), {}};
  return cantilever ? cantilever::make_problem(scene, variant) : plate_with_hole::make_problem(scene, variant);
}

/// Sparse LU, refined with residuals in extended precision until they are rounding.
std::vector<double> tightest_solution(const meshless::elasticity::LinearSystem &system) {
  const auto &matrix = system.matrix;
  const linear_algebra::SparseLu lu(matrix, linear_algebra::Ordering::metis);
  const std::size_t n = system.right_hand_side.size();
  std::vector<double> residual(system.right_hand_side);
  std::vector<double> correction(n);
  std::vector<long double> x(n, 0);
  constexpr int steps = 3;
  for (int step = 0; step <= steps; ++step) {
    lu.solve(residual, correction, linear_algebra::SparseLu::Refinement::none);
    for (std::size_t i = 0; i < n; ++i)
      x[i] += correction[i];
    for (std::size_t i = 0; i < n; ++i) {
      long double left = system.right_hand_side[i];
      for (auto k = static_cast<std::size_t>(matrix.offsets()[i]);
           k < static_cast<std::size_t>(matrix.offsets()[i + 1]); ++k)
        left -= static_cast<long double>(matrix.values()[k]) * x[static_cast<std::size_t>(matrix.columns()[k])];
      residual[i] = static_cast<double>(left);
    }
  }
  return {x.begin(), x.end()};
}

/// Places along the width of the largest grid of squares, five times as long as wide, of at most n particles.
int places_across(std::int64_t n) {
  int k = 2;
  while ((5 * std::int64_t{k} + 1) * (k + 1) <= n)
    ++k;
  return k;
}

scene::Level grid_level(std::int64_t n) {
  const int across = places_across(n);
  const int along = 5 * (across - 1) + 1;
  return {.counts = {along, across}, .spacing = {}, .text = fmt::format("{}x{}", along, across)};
}

} // namespace

Systems::Systems(const std::string &name, std::int64_t order, std::int64_t seed)
    : problem_(problem_of(name, seed)),
      method_(scene::default_parameters(methods::particle_keys(methods::Form::weak1), {{"order", order}})),
      grid_(name == "cantilever") {}

std::int64_t Systems::n_points(const scene::Level &level) const {
  if (!grid_)
    return level.counts.at(0);
  const auto counts = grid_level(level.counts.at(0)).counts;
  return std::int64_t{counts[0]} * counts[1];
}

const System &Systems::at(const scene::Level &level) {
  if (const auto found = systems_.find(level.text); found != systems_.end())
    return found->second;
  const scene::Level own = grid_ ? grid_level(level.counts.at(0)) : level;
  const methods::SolveRequest request{problem_->statement(), [&] { return problem_->cloud(own); },
                                      [&] { return problem_->mesh(own); }, method_};
  System system;
  system.weak = methods::weak_system(request, "weak1");
  system.solution = tightest_solution(system.equations());
  system.discretisation_error =
      metrics::error_norms(*system.weak->solution(system.solution), *problem_, problem_->quadrature(own))
          .at("displacement_l2_relative");
  return systems_.emplace(level.text, std::move(system)).first->second;
}

} // namespace comparisons::benchmarks::solvers
