#pragma once

#include "block_rows.h"

namespace meshless::linear_algebra {

/// What incomplete factors leave out.
struct Dropping {
  /// Blocks smaller than this part of the largest of their row of A: before the factorisation without fill, while it
  /// goes on with fill.
  double drop = 0;
  /// 0: without fill, on the pattern of what is left of A, ILU(0). Else ILUT (Saad 1994): the row of L and that of U
  /// keep their largest blocks, together this many times the row of A.
  double fill = 0;
};

/// A ~ L U by blocks. L has a unit diagonal. In single precision: it is a preconditioner, and half the bytes are half
/// the time.
class IncompleteLu {
public:
  IncompleteLu(const BlockRows &matrix, const Dropping &dropping);

  /// False if a pivot block is singular or not finite; the object is then of no use.
  bool regular() const { return regular_; }
  std::size_t bytes() const;
  double pivot_ratio() const { return pivot_ratio_; }
  /// x = (L U)^-1 b; both may be the same.
  void solve(std::span<const double> b, std::span<double> x) const;

private:
  using Index = BlockRows::Index;
  using SingleBlock = std::array<float, 4>;
  struct Triangle {
    std::vector<std::size_t> start{0};
    LargeArray<Index> columns;
    LargeArray<SingleBlock> blocks;

    void append(Index column, const BlockRows::Block &block);
    void subtract(std::size_t row, std::span<const double> x, double &sum_1, double &sum_2) const;
  };

  void factorise_without_fill(const BlockRows &matrix, double drop);
  void factorise_with_fill(const BlockRows &matrix, const Dropping &dropping);
  void set_pivot(std::size_t row, const BlockRows::Block &pivot);

  Triangle lower_;
  Triangle upper_;
  std::vector<SingleBlock> inverse_pivots_;
  bool regular_ = true;
  double pivot_ratio_ = 0;
  double least_pivot_ = 0;
  double largest_pivot_ = 0;
};

} // namespace meshless::linear_algebra
