#pragma once

#include "meshless/linear_algebra/large_array.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meshless::linear_algebra {

/// A sparse matrix built row by row, compressed rows; columns of a row increase. Numbers of columns take 32 bits, since
/// large matrices are all but limited by the memory that they pass through; rows may have more than 2^31 entries in
/// all.
class SparseRows {
public:
  using Column = std::int32_t;

  /// @throws std::invalid_argument for more than 2^31 - 1 columns
  explicit SparseRows(std::int64_t n_columns);

  /// Room for so many in all.
  void reserve(std::size_t n_entries);
  /// No rows; their storage is kept.
  void clear();

  /// Appends a row; entries that are exactly zero are left out.
  /// @param columns increasing
  void append_row(std::span<const Column> columns, std::span<const double> values);
  void append_row(std::span<const std::int64_t> columns, std::span<const double> values);

  /// Appends the rows of a matrix with as many columns.
  void append_rows(const SparseRows &rows) { fill(append_place(rows), rows); }
  /// The same in two steps: the place of their entries, then these. Several threads may fill places of their own while
  /// others are appended, as long as there is room.
  /// @returns what `fill` asks for
  std::size_t append_place(const SparseRows &rows);
  void fill(std::size_t place, const SparseRows &rows);
  bool has_room(std::size_t n_entries) const {
    return columns_.size() + n_entries <= std::min(columns_.capacity(), values_.capacity());
  }

  /// Divides every row by its largest absolute entry and returns the divisors: the weak and the
  /// strong form mix rows of stiffness, traction and penalty size.
  /// @throws std::runtime_error naming the row if one is zero or not finite
  std::vector<double> equilibrate_rows();
  /// The same of one row: its divisor.
  /// @param name number of the row in messages, where these rows are part of a larger matrix
  double equilibrate_row(std::size_t row, std::size_t name);

  std::int64_t n_rows() const { return static_cast<std::int64_t>(offsets_.size()) - 1; }
  std::int64_t n_columns() const { return n_columns_; }
  std::int64_t nonzeros() const { return offsets_.back(); }
  std::span<const std::int64_t> offsets() const { return offsets_; }
  std::span<const Column> columns() const { return columns_; }
  std::span<const double> values() const { return values_; }

  /// y = A x
  void multiply(std::span<const double> x, std::span<double> y) const;

private:
  template <typename Integer>
  void append(std::span<const Integer> columns, std::span<const double> values);

  std::int64_t n_columns_;
  std::vector<std::int64_t> offsets_;
  LargeArray<Column> columns_;
  LargeArray<double> values_;
};

/// a A + b B for matrices of the same size.
SparseRows combine(double a, const SparseRows &matrix_a, double b, const SparseRows &matrix_b);

/// Largest |x_i|.
double maximum_norm(std::span<const double> x);
/// |x - y|_2 / |y|_2; 0 if both are zero.
double relative_distance(std::span<const double> x, std::span<const double> y);
/// |A|_inf, the largest sum of a row's absolute entries.
double maximum_norm(const SparseRows &matrix);

/// |b - A x|_inf / (|A|_inf |x|_inf + |b|_inf): how far the system must be changed to make x exact.
double backward_error(const SparseRows &matrix, std::span<const double> x, std::span<const double> b);

} // namespace meshless::linear_algebra
