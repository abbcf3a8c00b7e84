#pragma once

#include "block_matrix.h"

#include <span>
#include <string>
#include <vector>

namespace fem_reference::linear_algebra
{
/// A pivot that is not usable; `unknown` is its row, or -1 if not known.
struct PivotFailure
{
  int unknown;
  std::string reason;
};

/// Solve A x = b with CHOLMOD: supernodal L L^T, AMD ordering of the nodes.
/// Throws PivotFailure if A is not (numerically) positive definite, SolveFailure on other errors.
std::vector<double> solve_cholesky(const BlockMatrix &matrix, std::span<const double> right_hand_side);

/// Solve A x = b with UMFPACK on the full matrix. Errors as above, for a singular matrix.
std::vector<double> solve_umfpack(const BlockMatrix &matrix, std::span<const double> right_hand_side);
} // namespace fem_reference::linear_algebra
