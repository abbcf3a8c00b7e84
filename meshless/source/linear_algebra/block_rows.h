#pragma once

#include "meshless/linear_algebra/large_array.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace meshless::linear_algebra {

/// Compressed rows of 2 x 2 blocks (a11, a12, a21, a22), in an order of their own.
struct BlockRows {
  using Index = std::uint32_t;
  using Block = std::array<double, 4>;

  /// Row and column I of the given matrix become row and column position[I].
  BlockRows(const SparseRows &matrix, std::span<const Index> order);

  std::size_t n_rows() const { return start.size() - 1; }
  /// y = A x
  void multiply(std::span<const double> x, std::span<double> y) const;

  std::vector<std::size_t> start;
  LargeArray<Index> columns;
  LargeArray<Block> blocks;
};

/// Sum of the absolute entries.
inline double size_of(const BlockRows::Block &a) {
  return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]) + std::abs(a[3]);
}

} // namespace meshless::linear_algebra
