#pragma once

#include "meshless/linear_algebra/sparse_rows.h"

#include <cstdint>
#include <span>
#include <vector>

namespace meshless::linear_algebra {

/// Systems of fewer unknowns are solved as fast by sparse LU.
inline constexpr std::int64_t least_unknowns_to_iterate = 1000;

enum class SystemSolver {
  direct,    ///< sparse LU
  iterative, ///< solve_iteratively; sparse LU if it does not converge
  automatic, ///< iterative from least_unknowns_to_iterate up
};

struct SystemSolution {
  std::vector<double> solution;
  int iterations = 0;              ///< 0: by sparse LU
  bool fell_back = false;          ///< to sparse LU, after an iteration that did not converge
  double backward_error = 0;       ///< see linear_algebra::backward_error
  double reciprocal_condition = 0; ///< an estimate
};

/// Solves A x = b.
/// @param unknowns_per_particle iteration needs 2
/// @throws SolveError if A is singular to rounding or memory runs out
SystemSolution solve_system(const SparseRows &matrix, std::span<const double> right_hand_side, SystemSolver solver,
                            std::size_t unknowns_per_particle = 2);

} // namespace meshless::linear_algebra
