#pragma once

#include "meshless/linear_algebra/sparse_rows.h"

#include <optional>
#include <span>
#include <vector>

namespace meshless::linear_algebra {

struct IterativeResult {
  std::vector<double> solution;
  int iterations = 0;
  /// Least over largest diagonal entry of the incomplete factor U: as rough as what sparse LU tells.
  double reciprocal_condition = 0;
};

/// Solves A x = b, with two unknowns a particle (2 I and 2 I + 1), by BiCGSTAB (van der Vorst 1992) with an incomplete
/// factorisation by blocks of 2 x 2.
///
/// The operators of smooth particle bases have wide rows of which little matters: entries of a block row below `drop`
/// of its largest are left out, and the rest is factorised without fill, in single precision, in reverse Cuthill-McKee
/// order. Fill, as in ILUT, made systems of order 3 and 4 diverge, and costs more than it saves.
///
/// The iteration starts anew from the true residual until the backward error is below 1e-15, or does not fall tenfold.
///
/// @return none if the backward error does not come below 1e-13, or a pivot is zero: use sparse LU
/// @throws std::invalid_argument if A is not square with an even number of rows
std::optional<IterativeResult> solve_iteratively(const SparseRows &matrix, std::span<const double> right_hand_side,
                                                 double drop = 2e-3);

} // namespace meshless::linear_algebra
