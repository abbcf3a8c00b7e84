#include "incomplete_lu.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace meshless::linear_algebra {

namespace {

using Block = BlockRows::Block;
using Index = BlockRows::Index;

template <typename Right>
Block product(const Block &a, const Right &b) {
  return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]};
}

/// Leaves the columns of the `most` largest blocks that are not below `least`, increasing.
void keep_largest(const std::vector<Block> &row, double least, std::size_t most, std::vector<Index> &columns) {
  std::erase_if(columns, [&](Index j) { return size_of(row[j]) < least; });
  if (columns.size() > most) {
    // Of equal blocks the lower column: the order is one, whatever the sort does.
    const auto larger = [&](Index a, Index b) {
      const double size_a = size_of(row[a]);
      const double size_b = size_of(row[b]);
      return size_a != size_b ? size_a > size_b : a < b;
    };
    std::nth_element(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(most), columns.end(), larger);
    columns.resize(most);
  }
  std::sort(columns.begin(), columns.end());
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

IncompleteLu::IncompleteLu(const BlockRows &matrix, const Dropping &dropping) : inverse_pivots_(matrix.n_rows()) {
  if (dropping.fill > 0)
    factorise_with_fill(matrix, dropping);
  else
    factorise_without_fill(matrix, dropping.drop);
  pivot_ratio_ = largest_pivot_ > 0 ? least_pivot_ / largest_pivot_ : 0;
}

std::size_t IncompleteLu::bytes() const {
  constexpr std::size_t per_block = sizeof(Index) + sizeof(SingleBlock);
  return per_block * (lower_.columns.size() + upper_.columns.size()) +
         inverse_pivots_.size() * (sizeof(SingleBlock) + 2 * sizeof(std::size_t));
}

/// Row by row (the order IKJ): from row i the multiples of the rows before it are taken that its pattern names.
void IncompleteLu::factorise_without_fill(const BlockRows &matrix, double drop) {
  for (Triangle *triangle : {&lower_, &upper_}) { // at once: room that is not used is never touched
    triangle->columns.reserve(matrix.columns.size() / 2);
    triangle->blocks.reserve(matrix.columns.size() / 2);
  }
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
}

/// The same with the blocks that arise on the way, as many as `dropping` allows.
void IncompleteLu::factorise_with_fill(const BlockRows &matrix, const Dropping &dropping) {
  const std::size_t n = matrix.n_rows();
  std::vector<Block> row(n);
  std::vector<char> in_row(n, 0);
  std::vector<Index> to_eliminate; // a heap, the least column first
  std::vector<Index> left;
  std::vector<Index> right;
  for (std::size_t i = 0; i < n && regular_; ++i) {
    const std::size_t length = matrix.start[i + 1] - matrix.start[i];
    double largest = 0;
    to_eliminate.clear();
    left.clear();
    right.clear();
    for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
      const Index j = matrix.columns[k];
      largest = std::max(largest, size_of(matrix.blocks[k]));
      row[j] = matrix.blocks[k];
      in_row[j] = 1;
      (j < i ? to_eliminate : right).push_back(j); // columns increase: a sorted list is a heap
    }
    if (in_row[i] == 0) {
      regular_ = false;
      return;
    }
    const double least = dropping.drop * largest;
    while (!to_eliminate.empty()) {
      const Index k = to_eliminate.front();
      std::pop_heap(to_eliminate.begin(), to_eliminate.end(), std::greater<>());
      to_eliminate.pop_back();
      row[k] = product(row[k], inverse_pivots_[k]);
      if (size_of(row[k]) < least) {
        in_row[k] = 0;
        continue;
      }
      left.push_back(k);
      for (std::size_t q = upper_.start[k]; q < upper_.start[k + 1]; ++q) {
        const Index j = upper_.columns[q];
        if (in_row[j] == 0) {
          in_row[j] = 1;
          row[j] = {};
          if (j < i) {
            to_eliminate.push_back(j);
            std::push_heap(to_eliminate.begin(), to_eliminate.end(), std::greater<>());
          } else
            right.push_back(j);
        }
        const Block change = product(row[k], upper_.blocks[q]);
        for (std::size_t e = 0; e < 4; ++e)
          row[j][e] -= change[e];
      }
    }
    set_pivot(i, row[i]);
    for (const Index j : left)
      in_row[j] = 0;
    for (const Index j : right)
      in_row[j] = 0;
    std::erase(right, static_cast<Index>(i));
    const auto most = static_cast<std::size_t>(.5 * dropping.fill * static_cast<double>(length)) + 1;
    keep_largest(row, least, most, left);
    keep_largest(row, least, most, right);
    for (const Index j : left)
      lower_.append(j, row[j]);
    for (const Index j : right)
      upper_.append(j, row[j]);
    lower_.start.push_back(lower_.columns.size());
    upper_.start.push_back(upper_.columns.size());
  }
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
