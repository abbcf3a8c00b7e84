#include "block_matrix.h"

#include "fem_reference/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace fem_reference::linear_algebra {
BlockMatrix::BlockMatrix(std::size_t n_nodes, std::span<const unsigned> cell_start,
                         std::span<const unsigned> cell_nodes) {
  // The cells of every node.
  std::vector<unsigned> start(n_nodes + 1, 0);
  for (const unsigned node : cell_nodes)
    ++start[node + 1];
  for (std::size_t i = 0; i < n_nodes; ++i)
    start[i + 1] += start[i];
  std::vector<unsigned> cells(cell_nodes.size());
  {
    std::vector<unsigned> next(start.begin(), start.end() - 1);
    for (unsigned c = 0; c + 1 < cell_start.size(); ++c)
      for (unsigned k = cell_start[c]; k < cell_start[c + 1]; ++k)
        cells[next[cell_nodes[k]]++] = c;
  }

  constexpr auto no_column = std::numeric_limits<unsigned>::max();
  std::vector<unsigned> seen_in(n_nodes, no_column);
  block_start.reserve(n_nodes + 1);
  block_start.push_back(0);
  // 16 bits of room below the limit of 4 entries a block.
  constexpr std::size_t most_blocks = std::numeric_limits<int>::max() / 4;
  for (unsigned j = 0; j < n_nodes; ++j) {
    const auto first = static_cast<std::ptrdiff_t>(block_rows.size());
    for (unsigned k = start[j]; k < start[j + 1]; ++k)
      for (const unsigned i : cell_nodes.subspan(cell_start[cells[k]], cell_start[cells[k] + 1] - cell_start[cells[k]]))
        if (i >= j && seen_in[i] != j) {
          seen_in[i] = j;
          block_rows.push_back(static_cast<int>(i));
        }
    std::sort(block_rows.begin() + first, block_rows.end());
    if (block_rows.size() > most_blocks)
      throw SolveFailure(
          fmt::format("the matrix of {} unknowns has more than 2^31 entries; use a coarser mesh", 2 * n_nodes));
    block_start.push_back(static_cast<int>(block_rows.size()));
  }
  values.assign(4 * block_rows.size() - n_nodes, 0.);
}

int BlockMatrix::find(unsigned row, unsigned column) const {
  const int *begin = block_rows.data() + block_start[column];
  const int *end = block_rows.data() + block_start[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, static_cast<int>(row)) - block_rows.data());
}

void BlockMatrix::scalar_pattern(std::vector<int> &column_start, std::vector<int> &rows) const {
  column_start.resize(static_cast<std::size_t>(n_rows()) + 1);
  rows.resize(values.size());
  int entry = 0;
  for (int j = 0; j < n_nodes(); ++j)
    for (int s = 0; s < 2; ++s) {
      column_start[static_cast<std::size_t>(2 * j + s)] = entry;
      for (int k = block_start[j]; k < block_start[j + 1]; ++k)
        for (int r = (k == block_start[j] ? s : 0); r < 2; ++r)
          rows[entry++] = 2 * block_rows[k] + r;
    }
  column_start.back() = entry;
}

void multiply(const BlockMatrix &matrix, std::span<const double> x, std::span<double> y,
              std::span<double> absolute_row_sums) {
  std::fill(y.begin(), y.end(), 0.);
  std::fill(absolute_row_sums.begin(), absolute_row_sums.end(), 0.);
  std::size_t entry = 0;
  for (int j = 0; j < matrix.n_nodes(); ++j)
    for (int s = 0; s < 2; ++s) {
      const int column = 2 * j + s;
      double sum = 0;
      double absolute_sum = 0;
      for (int k = matrix.block_start[j]; k < matrix.block_start[j + 1]; ++k)
        for (int r = (k == matrix.block_start[j] ? s : 0); r < 2; ++r) {
          const int row = 2 * matrix.block_rows[k] + r;
          const double value = matrix.values[entry++];
          sum += value * x[row];
          absolute_sum += std::abs(value);
          if (row == column)
            continue;
          y[row] += value * x[column];
          if (!absolute_row_sums.empty())
            absolute_row_sums[row] += std::abs(value);
        }
      y[column] += sum;
      if (!absolute_row_sums.empty())
        absolute_row_sums[column] += absolute_sum;
    }
}
} // namespace fem_reference::linear_algebra
