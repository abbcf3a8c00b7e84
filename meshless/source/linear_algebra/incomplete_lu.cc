#include "incomplete_lu.h"

#include <algorithm>
#include <cmath>

namespace meshless::linear_algebra {

namespace {

using Block = BlockRows::Block;

template <typename Right>
Block product(const Block &a, const Right &b) {
  return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]};
}

} // namespace

void IncompleteLu::Triangle::append(Index column, const BlockRows::Block &block) {
  columns.push_back(column);
  blocks.push_back({static_cast<float>(block[0]), static_cast<float>(block[1]), static_cast<float>(block[2]),
                    static_cast<float>(block[3])});
}

void IncompleteLu::Triangle::subtract(std::size_t row, std::span<const double> x, double &sum_1, double &sum_2) const {
  for (std::size_t k = start[row]; k < start[row + 1]; ++k) {
    const auto &a = blocks[k];
    const double x1 = x[2 * std::size_t{columns[k]}];
    const double x2 = x[2 * std::size_t{columns[k]} + 1];
    sum_1 -= a[0] * x1 + a[1] * x2;
    sum_2 -= a[2] * x1 + a[3] * x2;
  }
}

void IncompleteLu::set_pivot(std::size_t row, const BlockRows::Block &pivot) {
  const double determinant = pivot[0] * pivot[3] - pivot[1] * pivot[2];
  const double size = size_of(pivot);
  if (!(std::abs(determinant) > 1e-12 * size * size) || !std::isfinite(determinant)) {
    regular_ = false;
    return;
  }
  const double inverse = 1 / determinant;
  inverse_pivots_[row] = {static_cast<float>(pivot[3] * inverse), static_cast<float>(-pivot[1] * inverse),
                          static_cast<float>(-pivot[2] * inverse), static_cast<float>(pivot[0] * inverse)};
  const double pivot_size = std::sqrt(std::abs(determinant));
  least_pivot_ = row == 0 ? pivot_size : std::min(least_pivot_, pivot_size);
  largest_pivot_ = std::max(largest_pivot_, pivot_size);
}

/// Row by row (the order IKJ): from row i the multiples of the rows before it are taken that its pattern names.
IncompleteLu::IncompleteLu(const BlockRows &matrix, double drop) : inverse_pivots_(matrix.n_rows()) {
  const std::size_t n = matrix.n_rows();
  std::vector<Block> row(n);
  std::vector<char> in_pattern(n, 0);
  std::vector<Index> pattern;
  for (std::size_t i = 0; i < n && regular_; ++i) {
    double largest = 0;
    for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
      largest = std::max(largest, size_of(matrix.blocks[k]));
    pattern.clear();
    for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
      if (const Index j = matrix.columns[k]; j == i || size_of(matrix.blocks[k]) >= drop * largest) {
        row[j] = matrix.blocks[k];
        in_pattern[j] = 1;
        pattern.push_back(j);
      }
    for (const Index k : pattern) {
      if (k >= i)
        break;
      row[k] = product(row[k], inverse_pivots_[k]);
      for (std::size_t q = upper_.start[k]; q < upper_.start[k + 1]; ++q)
        if (const Index j = upper_.columns[q]; in_pattern[j] != 0) {
          const Block change = product(row[k], upper_.blocks[q]);
          for (std::size_t e = 0; e < 4; ++e)
            row[j][e] -= change[e];
        }
    }
    if (in_pattern[i] == 0) {
      regular_ = false;
      return;
    }
    set_pivot(i, row[i]);
    for (const Index j : pattern) {
      if (j < i)
        lower_.append(j, row[j]);
      else if (j > i)
        upper_.append(j, row[j]);
      in_pattern[j] = 0;
    }
    lower_.start.push_back(lower_.columns.size());
    upper_.start.push_back(upper_.columns.size());
  }
  pivot_ratio_ = largest_pivot_ > 0 ? least_pivot_ / largest_pivot_ : 0;
}

void IncompleteLu::solve(std::span<const double> b, std::span<double> x) const {
  const std::size_t n = inverse_pivots_.size();
  for (std::size_t i = 0; i < n; ++i) {
    double sum_1 = b[2 * i];
    double sum_2 = b[2 * i + 1];
    lower_.subtract(i, x, sum_1, sum_2);
    x[2 * i] = sum_1;
    x[2 * i + 1] = sum_2;
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum_1 = x[2 * i];
    double sum_2 = x[2 * i + 1];
    upper_.subtract(i, x, sum_1, sum_2);
    const auto &d = inverse_pivots_[i];
    x[2 * i] = d[0] * sum_1 + d[1] * sum_2;
    x[2 * i + 1] = d[2] * sum_1 + d[3] * sum_2;
  }
}

} // namespace meshless::linear_algebra
