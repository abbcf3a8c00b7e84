#include "fem_reference/elasticity/plane_elasticity.h"

#include "../linear_algebra/direct_solvers.h"
#include "../multigrid/multigrid.h"
#include "../stopwatch.h"
#include "mixed.h"
#include "solution.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
double norm(std::span<const double> x) {
  double sum = 0;
  for (const double value : x)
    sum += value * value;
  return std::sqrt(sum);
}

double maximum_norm(std::span<const double> x) {
  double maximum = 0;
  for (const double value : x)
    maximum = std::max(maximum, std::abs(value));
  return maximum;
}

void measure_residual(const linear_algebra::BlockMatrix &matrix, const std::vector<double> &right_hand_side,
                      PlaneSolution::Implementation &solution) {
  std::vector<double> residual(right_hand_side.size());
  std::vector<double> row_sums(right_hand_side.size());
  multiply(matrix, solution.values, residual, row_sums);
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] -= right_hand_side[i];
  const double largest = maximum_norm(residual);
  if (largest == 0)
    return; // no loads at all, for instance
  solution.relative_residual = norm(residual) / norm(right_hand_side);
  solution.backward_error =
      largest / (maximum_norm(row_sums) * maximum_norm(solution.values) + maximum_norm(right_hand_side));
}

std::unique_ptr<linear_algebra::DirectSolver> factorise(LinearSolver solver, const linear_algebra::BlockMatrix &matrix,
                                                        const Discretisation &discretisation) {
  try {
    return solver == LinearSolver::cholesky ? linear_algebra::factorise_cholesky(matrix)
                                            : linear_algebra::factorise_umfpack(matrix);
  } catch (const linear_algebra::PivotFailure &failure) {
    std::string where;
    if (failure.unknown >= 0) {
      const auto node = static_cast<std::size_t>(failure.unknown) / 2;
      const auto position = discretisation.original_position(node);
      where = fmt::format(" at the equation of u{} at ({}, {})", failure.unknown % 2 + 1, position[0], position[1]);
    }
    throw SolveFailure(
        fmt::format("the stiffness of {} unknowns is singular or not positive definite{}: {}; look for parts of the "
                    "mesh that hang together in one vertex only, and for nu too close to 1/2 in plane strain",
                    matrix.n_rows(), where, failure.reason));
  }
}

/// The prescribed values to the last bit: the factorisation returns them with rounding.
void impose(const EssentialData &essential, std::vector<double> &displacement) {
  for (std::size_t i = 0; i < displacement.size(); ++i)
    if (essential.prescribed[i] != 0)
      displacement[i] = essential.values[i];
}

/// The residual of the free unknowns, by cells.
std::vector<double> free_residual(const PlaneSolution::Implementation &solution) {
  auto residual = internal_forces(solution.discretisation, solution.materials, solution.values).forces;
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] = solution.essential.prescribed[i] != 0 ? 0 : solution.loads.nodal[i] - residual[i];
  return residual;
}

/// One step of iterative refinement with the accurate residual.
void correct(linear_algebra::DirectSolver &solver, PlaneSolution::Implementation &solution) {
  const auto &prescribed = solution.essential.prescribed;
  auto &displacement = solution.values;
  auto correction = solver.solve(free_residual(solution));
  for (std::size_t i = 0; i < displacement.size(); ++i)
    if (prescribed[i] == 0)
      displacement[i] += correction[i];
    else
      correction[i] = 0;
  if (const double size = norm(displacement); size > 0)
    solution.algebraic_error = norm(correction) / size;
}

void check_finite(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw SolveFailure(fmt::format("the solution is not finite at unknown {}", i));
}

void solve_mixed_system(const PlaneProblem &problem, PlaneSolution::Implementation &solution, Seconds &seconds) {
  Stopwatch stopwatch;
  solution.essential = essential_data(problem, solution.discretisation);
  solution.loads = loads(problem, solution.discretisation);
  seconds.assembly = stopwatch.lap();
  auto result = solve_mixed(solution.discretisation, problem.materials, solution.essential, solution.loads);
  solution.values = std::move(result.displacement);
  solution.cell_pressure = std::move(result.cell_pressure);
  solution.n_dofs = result.n_dofs;
  solution.nonzeros = result.nonzeros;
  solution.backward_error = result.backward_error;
  impose(solution.essential, solution.values);
  check_finite(solution.values);
  seconds.solve = stopwatch.lap();
}

/// Corrections of the prescribed displacements, continued by zero: the first is the solution. What it leaves is the
/// rounding of its recurrence, and the second, with the residual computed anew, ends on the first's level.
void solve_without_matrix(const PlaneProblem &problem, const Options &options, PlaneSolution::Implementation &solution,
                          Seconds &seconds) {
  Stopwatch stopwatch;
  solution.essential = essential_data(problem, solution.discretisation);
  solution.loads = loads(problem, solution.discretisation);
  solution.thermal_strain = problem.thermal_strain;
  solution.values = solution.essential.values;
  multigrid::Multigrid solver(solution.discretisation, solution.materials, solution.essential.prescribed);
  seconds.assembly = stopwatch.lap();

  constexpr double tolerance = 1e-12;
  auto residual = free_residual(solution);
  const double first = norm(residual);
  std::vector<double> correction(residual.size());
  for (int step = 0; step <= options.corrections && norm(residual) > tolerance * first; ++step) {
    const double left = norm(residual) / first;
    solution.iterations += solver.solve(residual, std::min(tolerance / left, .1), correction).iterations;
    for (std::size_t i = 0; i < correction.size(); ++i)
      solution.values[i] += correction[i];
    residual = free_residual(solution);
    if (const double size = norm(solution.values); size > 0)
      solution.algebraic_error = norm(correction) / size * norm(residual) / (left * first);
  }
  check_finite(solution.values);
  solution.n_dofs = solution.values.size();
  if (first > 0)
    solution.relative_residual = norm(residual) / first;
  const double size_of_terms =
      solver.largest_diagonal() * maximum_norm(solution.values) + maximum_norm(solution.loads.nodal);
  if (size_of_terms > 0)
    solution.backward_error = maximum_norm(residual) / size_of_terms; // from above: |K| is at least its diagonal
  seconds.solve = stopwatch.lap();
}
} // namespace

PlaneSolution solve(const PlaneProblem &problem, const Options &options) {
  if (options.degree < 1 || options.degree > max_degree)
    throw InvalidInput(fmt::format("element degree {}: expected 1 to {} (Q1 ... Q{}, P1 ... P{})", options.degree,
                                   max_degree, max_degree, max_degree));
  if (options.mixed && options.degree != 2)
    throw InvalidInput(fmt::format("element degree {}: Taylor-Hood elements have degree 2", options.degree));
  Seconds seconds;
  auto solution = std::make_shared<PlaneSolution::Implementation>(
      problem.materials, discretise(problem.mesh, options.degree, seconds.mesh, seconds.degrees_of_freedom));
  const auto &discretisation = solution->discretisation;
  check_materials(problem);
  check_conditions(problem);

  if (options.mixed) {
    solve_mixed_system(problem, *solution, seconds);
    solution->seconds = seconds;
    return PlaneSolution(std::move(solution));
  }
  if (options.solver == LinearSolver::multigrid) {
    solve_without_matrix(problem, options, *solution, seconds);
    solution->seconds = seconds;
    return PlaneSolution(std::move(solution));
  }
  Stopwatch stopwatch;
  linear_algebra::BlockMatrix matrix(discretisation.n_nodes(), discretisation.cell_start, discretisation.cell_nodes);
  seconds.degrees_of_freedom += stopwatch.lap();

  solution->essential = essential_data(problem, discretisation);
  assemble_stiffness(discretisation, problem.materials, matrix);
  solution->loads = loads(problem, discretisation);
  solution->thermal_strain = problem.thermal_strain;
  auto right_hand_side = solution->loads.nodal;
  eliminate(solution->essential, matrix, right_hand_side);
  seconds.assembly = stopwatch.lap();

  const auto solver = factorise(options.solver, matrix, discretisation);
  solution->values = solver->solve(right_hand_side);
  impose(solution->essential, solution->values);
  for (int step = 0; step < options.corrections; ++step)
    correct(*solver, *solution);
  check_finite(solution->values);
  measure_residual(matrix, right_hand_side, *solution);
  solution->n_dofs = solution->values.size();
  solution->nonzeros = 2 * matrix.n_nonzeros_lower() - static_cast<std::size_t>(matrix.n_rows());
  seconds.solve = stopwatch.lap();
  solution->seconds = seconds;
  return PlaneSolution(std::move(solution));
}
} // namespace fem_reference::elasticity
