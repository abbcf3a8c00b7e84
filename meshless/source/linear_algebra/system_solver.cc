#include "meshless/linear_algebra/system_solver.h"

#include "meshless/linear_algebra/iterative_solver.h"
#include "meshless/linear_algebra/sparse_lu.h"

namespace meshless::linear_algebra {

SystemSolution solve_system(const SparseRows &matrix, std::span<const double> right_hand_side, SystemSolver solver,
                            std::size_t unknowns_per_particle) {
  const bool iterate = unknowns_per_particle == 2 &&
                       (solver == SystemSolver::iterative ||
                        (solver == SystemSolver::automatic && matrix.n_rows() >= least_unknowns_to_iterate));
  SystemSolution result;
  if (iterate) {
    if (auto iterated = solve_iteratively(matrix, right_hand_side)) {
      result.solution = std::move(iterated->solution);
      result.iterations = iterated->iterations;
      result.reciprocal_condition = iterated->reciprocal_condition;
    } else
      result.fell_back = true;
  }
  if (result.solution.empty()) {
    auto lu = solve_lu(matrix, right_hand_side);
    result.solution = std::move(lu.solution);
    result.reciprocal_condition = lu.reciprocal_condition;
  }
  result.backward_error = backward_error(matrix, result.solution, right_hand_side);
  return result;
}

} // namespace meshless::linear_algebra
