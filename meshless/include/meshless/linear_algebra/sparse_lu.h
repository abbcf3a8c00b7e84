#pragma once

#include "meshless/linear_algebra/sparse_rows.h"

#include <span>
#include <stdexcept>
#include <vector>

namespace meshless::linear_algebra {

/// A system that cannot be solved: singular, or out of memory.
class SolveError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

struct LuResult {
  std::vector<double> solution;
  /// Reciprocal condition estimate of the factor U's diagonal (UMFPACK), 0 = singular.
  double reciprocal_condition = 0;
};

/// Solves A x = b by sparse LU with partial pivoting (UMFPACK, multifrontal, BLAS-3), with its
/// iterative refinement.
/// @throws SolveError if A is singular to rounding or memory runs out
LuResult solve_lu(const SparseRows &matrix, std::span<const double> right_hand_side);

} // namespace meshless::linear_algebra
