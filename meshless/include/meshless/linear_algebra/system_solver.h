#pragma once

#include "meshless/linear_algebra/iterative_solver.h"
#include "meshless/linear_algebra/ordering.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace meshless::linear_algebra {

/// Systems of fewer unknowns are solved as fast by sparse LU. (On the plate with a hole the iteration takes a third of
/// its time at 376 unknowns, a quarter at 5200, a ninth at 200000.)
inline constexpr std::int64_t least_unknowns_to_iterate = 200;
/// Sparse LU of larger systems has METIS as its ordering: it is as fast as AMD there, with less fill.
inline constexpr std::int64_t least_unknowns_to_dissect = 40000;

enum class SystemSolver {
  automatic, ///< bicgstab from least_unknowns_to_iterate up, else direct
  direct,    ///< sparse LU
  bicgstab,  ///< solve_iteratively; sparse LU if it does not converge
  gmres,     ///< the same
};

/// What is left open is chosen by size.
struct SolverRequest {
  SystemSolver solver = SystemSolver::automatic;
  std::optional<Ordering> ordering = {};
  std::optional<Preconditioner> preconditioner = {};

  SolverRequest() = default;
  SolverRequest(SystemSolver wanted) : solver(wanted) {} // NOLINT(google-explicit-constructor): a name is a request
};

/// How a system is solved.
struct SolverChoice {
  std::optional<Krylov> krylov = {}; ///< none: sparse LU, which has no preconditioner
  Preconditioner preconditioner = Preconditioner::thinned_coarse;
  Ordering ordering = Ordering::amd;

  friend bool operator==(const SolverChoice &, const SolverChoice &) = default;
};

/// What is taken for a request.
SolverChoice choose(const SolverRequest &request, std::int64_t n_unknowns, std::size_t unknowns_per_particle = 2);

struct SystemSolution {
  std::vector<double> solution;
  int iterations = 0;           ///< 0: by sparse LU
  bool fell_back = false;       ///< to sparse LU, after an iteration that did not converge
  int n_restarts = 0;           ///< of the iteration: KrylovResult::n_restarts
  bool coarse_left_out = false; ///< of the preconditioner: PreconditionedSystem::coarse_left_out
  SolverChoice taken;
  double backward_error = 0;       ///< see linear_algebra::backward_error
  double algebraic_error = 0;      ///< an estimate by tightening: KrylovResult::algebraic_error
  double reciprocal_condition = 0; ///< an estimate
};

/// Solves A x = b.
/// @param unknowns_per_particle iteration needs 2
/// @throws SolveError if A is singular to rounding or memory runs out
SystemSolution solve_system(const SparseRows &matrix, std::span<const double> right_hand_side,
                            const SolverRequest &request, std::size_t unknowns_per_particle = 2);

} // namespace meshless::linear_algebra
