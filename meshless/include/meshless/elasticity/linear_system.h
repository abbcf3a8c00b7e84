#pragma once

#include "meshless/linear_algebra/sparse_rows.h"

#include <vector>

namespace meshless::elasticity {

/// The discrete equations of a cloud for the coefficients u1, u2 of every particle, interleaved, m. Every row is
/// divided by its largest absolute entry.
struct LinearSystem {
  linear_algebra::SparseRows matrix;
  std::vector<double> right_hand_side; ///< m
};

} // namespace meshless::elasticity
