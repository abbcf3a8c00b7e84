#pragma once

#include "meshless/linear_algebra/aligned_vector.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <cstddef>

namespace meshless::linear_algebra {

/// A square band matrix stored by diagonals, each padded to whole cache lines: y_i = sum_k d_k[i] x_{i+k}.
class Diagonals {
public:
  /// All diagonals between the outermost entries of the matrix, times `factor`.
  Diagonals(const SparseRows &matrix, double factor);

  std::size_t n_rows() const { return n_rows_; }
  /// Places that a vector needs before its first and after its last entry.
  static constexpr std::size_t margin(std::size_t half_width) { return padded(half_width) + 8; }
  std::size_t half_width() const { return half_width_; }
  /// Diagonal k = -half_width ... half_width, of row 0 on.
  const double *diagonal(std::ptrdiff_t k) const {
    return values_.data() + static_cast<std::size_t>(k + static_cast<std::ptrdiff_t>(half_width_)) * stride_;
  }
  std::size_t bytes() const { return values_.size() * sizeof(double); }

private:
  static constexpr std::size_t padded(std::size_t n) { return (n + 7) / 8 * 8; }

  std::size_t n_rows_;
  std::size_t half_width_ = 0;
  std::size_t stride_;
  AlignedVector values_;
};

} // namespace meshless::linear_algebra
