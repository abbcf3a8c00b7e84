#pragma once

#include "block_matrix.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace fem_reference::linear_algebra {
/// A pivot that is not usable; `unknown` is its row, or -1 if not known.
struct PivotFailure {
  int unknown;
  std::string reason;
};

/// A factorised matrix. It does not refer to the matrix unless said otherwise.
class DirectSolver {
public:
  DirectSolver() = default;
  DirectSolver(const DirectSolver &) = delete;
  DirectSolver &operator=(const DirectSolver &) = delete;
  virtual ~DirectSolver() = default;
  virtual std::vector<double> solve(std::span<const double> right_hand_side) = 0;
};

/// CHOLMOD: supernodal L L^T, AMD ordering of the nodes.
/// Throws PivotFailure if A is not (numerically) positive definite, SolveFailure on other errors.
std::unique_ptr<DirectSolver> factorise_cholesky(const BlockMatrix &matrix);

/// UMFPACK: L U of the full matrix with the same ordering. Errors as above, for a singular matrix.
std::unique_ptr<DirectSolver> factorise_umfpack(const BlockMatrix &matrix);
} // namespace fem_reference::linear_algebra
