#include "meshless/linear_algebra/system_solver.h"

#include "meshless/linear_algebra/sparse_lu.h"

namespace meshless::linear_algebra {

namespace {

Ordering ordering_of_lu(const SolverRequest &request, std::int64_t n_unknowns) {
  return request.ordering.value_or(n_unknowns < least_unknowns_to_dissect ? Ordering::amd : Ordering::metis);
}

} // namespace

SolverChoice choose(const SolverRequest &request, std::int64_t n_unknowns, std::size_t unknowns_per_particle) {
  const PreconditionerSettings standard;
  SolverChoice choice;
  const bool direct = request.solver == SystemSolver::direct ||
                      (request.solver == SystemSolver::automatic && n_unknowns < least_unknowns_to_iterate);
  if (direct || unknowns_per_particle != 2) {
    choice.ordering = ordering_of_lu(request, n_unknowns);
    return choice;
  }
  choice.krylov = request.solver == SystemSolver::gmres ? Krylov::gmres : Krylov::bicgstab;
  choice.preconditioner = request.preconditioner.value_or(standard.preconditioner);
  choice.ordering = request.ordering.value_or(standard.ordering);
  return choice;
}

SystemSolution solve_system(const SparseRows &matrix, std::span<const double> right_hand_side,
                            const SolverRequest &request, std::size_t unknowns_per_particle) {
  SystemSolution result;
  result.taken = choose(request, matrix.n_rows(), unknowns_per_particle);
  if (result.taken.krylov) {
    IterativeSettings settings;
    settings.krylov = *result.taken.krylov;
    settings.preconditioner.preconditioner = result.taken.preconditioner;
    settings.preconditioner.ordering = result.taken.ordering;
    if (auto iterated = solve_iteratively(matrix, right_hand_side, settings)) {
      result.solution = std::move(iterated->solution);
      result.iterations = iterated->iterations;
      result.n_restarts = iterated->n_restarts;
      result.coarse_left_out = iterated->coarse_left_out;
      result.algebraic_error = iterated->algebraic_error;
      result.reciprocal_condition = iterated->reciprocal_condition;
    } else {
      result.fell_back = true;
      result.taken = {.ordering = ordering_of_lu({}, matrix.n_rows())};
    }
  }
  if (!result.taken.krylov) {
    auto lu = solve_lu(matrix, right_hand_side, result.taken.ordering);
    result.solution = std::move(lu.solution);
    result.algebraic_error = lu.algebraic_error;
    result.reciprocal_condition = lu.reciprocal_condition;
  }
  result.backward_error = backward_error(matrix, result.solution, right_hand_side);
  return result;
}

} // namespace meshless::linear_algebra
