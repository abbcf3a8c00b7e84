#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace fem_reference::linear_algebra {
/// Lower triangle of a symmetric matrix of 2 x 2 blocks, in compressed columns.
///
/// Block column j holds the block rows block_rows[block_start[j]] = j < ... , sorted. The scalar
/// columns 2 j and 2 j + 1 follow each other in `values`; the entry (2 j, 2 j + 1) is left out.
/// 32-bit indices, as CHOLMOD's fast interface takes.
class BlockMatrix {
public:
  /// Sparsity of a space whose unknowns couple within cells: those of cell c are cell_nodes[cell_start[c]] to
  /// cell_nodes[cell_start[c + 1] - 1]. Throws SolveFailure if the number of entries exceeds 32 bits.
  BlockMatrix(std::size_t n_nodes, std::span<const unsigned> cell_start, std::span<const unsigned> cell_nodes);

  int n_nodes() const { return static_cast<int>(block_start.size()) - 1; }
  int n_rows() const { return 2 * n_nodes(); }
  std::size_t n_nonzeros_lower() const { return values.size(); }

  /// Position in `block_rows` of block (row, column), row >= column; the block must exist.
  int find(unsigned row, unsigned column) const;

  /// First entry of scalar column 2 j in `values`, from the block position: columns before take
  /// 4 m - 1 entries each.
  std::size_t first_entry(unsigned column) const { return 4 * static_cast<std::size_t>(block_start[column]) - column; }

  /// Row pointers and indices of the scalar matrix, sorted.
  void scalar_pattern(std::vector<int> &column_start, std::vector<int> &rows) const;

  std::vector<int> block_start;
  std::vector<int> block_rows;
  std::vector<double> values;
};

/// y = A x for the symmetric matrix, and the row sums of |A| if `absolute_row_sums` is not empty.
void multiply(const BlockMatrix &matrix, std::span<const double> x, std::span<double> y,
              std::span<double> absolute_row_sums);
} // namespace fem_reference::linear_algebra
