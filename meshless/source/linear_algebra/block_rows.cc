#include "block_rows.h"

#include <algorithm>
#include <limits>

namespace meshless::linear_algebra {

namespace {

using Index = BlockRows::Index;

/// Calls function(block column, entries of both rows) for the blocks of block row `i`, columns increasing.
template <typename Function>
void for_each_block(const SparseRows &matrix, std::size_t i, const Function &function) {
  const auto offsets = matrix.offsets();
  const auto columns = matrix.columns();
  const auto values = matrix.values();
  auto a = static_cast<std::size_t>(offsets[2 * i]);
  const auto end_a = static_cast<std::size_t>(offsets[2 * i + 1]);
  auto b = end_a;
  const auto end_b = static_cast<std::size_t>(offsets[2 * i + 2]);
  constexpr auto none = std::numeric_limits<std::int64_t>::max();
  while (a < end_a || b < end_b) {
    const std::int64_t column = std::min(a < end_a ? columns[a] / 2 : none, b < end_b ? columns[b] / 2 : none);
    BlockRows::Block block{};
    for (; a < end_a && columns[a] / 2 == column; ++a)
      block[static_cast<std::size_t>(columns[a] % 2)] = values[a];
    for (; b < end_b && columns[b] / 2 == column; ++b)
      block[static_cast<std::size_t>(2 + columns[b] % 2)] = values[b];
    function(static_cast<Index>(column), block);
  }
}

} // namespace

BlockRows::BlockRows(const SparseRows &matrix, std::span<const Index> order) {
  const std::size_t n = order.size();
  std::vector<Index> position(n);
  for (std::size_t k = 0; k < n; ++k)
    position[order[k]] = static_cast<Index>(k);
  start.reserve(n + 1);
  start.push_back(0);
  columns.reserve(static_cast<std::size_t>(matrix.nonzeros()) / 4);
  blocks.reserve(columns.capacity());
  std::vector<std::pair<Index, Block>> row;
  for (const Index i : order) {
    row.clear();
    for_each_block(matrix, i, [&](Index column, const Block &block) { row.emplace_back(position[column], block); });
    std::sort(row.begin(), row.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    for (const auto &[column, block] : row) {
      columns.push_back(column);
      blocks.push_back(block);
    }
    start.push_back(columns.size());
  }
}

void BlockRows::multiply(std::span<const double> x, std::span<double> y) const {
  for (std::size_t i = 0; i < n_rows(); ++i) {
    double sum_1 = 0;
    double sum_2 = 0;
    for (std::size_t k = start[i]; k < start[i + 1]; ++k) {
      const auto &a = blocks[k];
      const double x1 = x[2 * std::size_t{columns[k]}];
      const double x2 = x[2 * std::size_t{columns[k]} + 1];
      sum_1 += a[0] * x1 + a[1] * x2;
      sum_2 += a[2] * x1 + a[3] * x2;
    }
    y[2 * i] = sum_1;
    y[2 * i + 1] = sum_2;
  }
}

} // namespace meshless::linear_algebra
