#pragma once

#include "meshless/linear_algebra/ordering.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <memory>
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
  /// Estimate of the solution's error by tightening, as KrylovResult::algebraic_error: x' is the solution without
  /// iterative refinement.
  double algebraic_error = 0;
  /// Reciprocal condition estimate of the factor U's diagonal (UMFPACK), 0 = singular.
  double reciprocal_condition = 0;
};

/// A factorised sparse matrix, for several right-hand sides. The matrix must outlive it and stay as it is.
class SparseLu {
public:
  /// @throws SolveError if A is singular to rounding or memory runs out
  explicit SparseLu(const SparseRows &matrix, Ordering ordering = Ordering::amd);
  ~SparseLu();
  SparseLu(const SparseLu &) = delete;
  SparseLu &operator=(const SparseLu &) = delete;

  enum class Refinement { iterative, none };
  /// x with A x = b. Both have n_rows() entries.
  /// @throws SolveError if an unknown is not finite
  void solve(std::span<const double> right_hand_side, std::span<double> solution,
             Refinement refinement = Refinement::iterative) const;
  double reciprocal_condition() const;
  /// Of the factors.
  std::size_t bytes() const;

private:
  struct Handles;
  const SparseRows &matrix_;
  std::unique_ptr<Handles> handles_;
};

/// Solves A x = b with the factors of A.
LuResult solve_lu(const SparseLu &lu, const SparseRows &matrix, std::span<const double> right_hand_side);

/// Solves A x = b by sparse LU with partial pivoting (UMFPACK, multifrontal, BLAS-3), with its
/// iterative refinement.
/// @throws SolveError if A is singular to rounding or memory runs out
LuResult solve_lu(const SparseRows &matrix, std::span<const double> right_hand_side, Ordering ordering = Ordering::amd);

} // namespace meshless::linear_algebra
