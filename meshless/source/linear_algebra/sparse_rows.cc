#include "meshless/linear_algebra/sparse_rows.h"

#include "meshless/linear_algebra/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace meshless::linear_algebra {

SparseRows::SparseRows(std::int64_t n_columns) : n_columns_(n_columns), offsets_(1, 0) {
  if (n_columns > std::numeric_limits<Column>::max())
    throw std::invalid_argument(
        fmt::format("a matrix of {} columns; at most {} are possible", n_columns, std::numeric_limits<Column>::max()));
}

void SparseRows::reserve(std::size_t n_entries) {
  columns_.reserve(n_entries);
  values_.reserve(n_entries);
}

void SparseRows::clear() {
  offsets_.resize(1);
  columns_.clear();
  values_.clear();
}

void SparseRows::append_row(std::span<const Column> columns, std::span<const double> values) {
  append(columns, values);
}

void SparseRows::append_row(std::span<const std::int64_t> columns, std::span<const double> values) {
  append(columns, values);
}

template <typename Integer>
void SparseRows::append(std::span<const Integer> columns, std::span<const double> values) {
  // Without a branch: zeros are scattered.
  std::size_t end = columns_.size();
  columns_.resize(end + columns.size());
  values_.resize(end + columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns_[end] = static_cast<Column>(columns[k]);
    values_[end] = values[k];
    end += values[k] != 0;
  }
  columns_.resize(end);
  values_.resize(end);
  offsets_.push_back(static_cast<std::int64_t>(end));
}

std::size_t SparseRows::append_place(const SparseRows &rows) {
  const auto first = offsets_.back();
  columns_.resize(columns_.size() + rows.columns_.size());
  values_.resize(values_.size() + rows.values_.size());
  for (std::size_t row = 1; row < rows.offsets_.size(); ++row)
    offsets_.push_back(first + rows.offsets_[row]);
  return static_cast<std::size_t>(first);
}

void SparseRows::fill(std::size_t place, const SparseRows &rows) {
  std::copy(rows.columns_.begin(), rows.columns_.end(), columns_.data() + place);
  std::copy(rows.values_.begin(), rows.values_.end(), values_.data() + place);
}

std::vector<double> SparseRows::equilibrate_rows() {
  std::vector<double> divisors(static_cast<std::size_t>(n_rows()));
  for (std::size_t row = 0; row < divisors.size(); ++row)
    divisors[row] = equilibrate_row(row, row);
  return divisors;
}

double SparseRows::equilibrate_row(std::size_t row, std::size_t name) {
  const std::span<double> entries(values_.data() + offsets_[row],
                                  static_cast<std::size_t>(offsets_[row + 1] - offsets_[row]));
  const std::size_t n_packed = entries.size() / n_lanes * n_lanes;
  Pack of_lanes = 0, products = 0; // a product with 0 is 0 if the entry is finite, and else NaN
  for (std::size_t k = 0; k < n_packed; k += n_lanes) {
    const Pack pack = load(&entries[k]);
    of_lanes = max(of_lanes, abs(pack));
    products += 0 * pack;
  }
  double largest = hmax(of_lanes), product = reduce(products);
  for (std::size_t k = n_packed; k < entries.size(); ++k) {
    largest = std::max(largest, std::abs(entries[k]));
    product += 0 * entries[k];
  }
  if (product != 0)
    throw std::runtime_error(fmt::format("row {} of the system has an entry that is not finite", name));
  if (largest == 0)
    throw std::runtime_error(fmt::format("row {} of the system is zero", name));
  for (double &entry : entries)
    entry /= largest;
  return largest;
}

void SparseRows::multiply(std::span<const double> x, std::span<double> y) const {
  for (std::size_t row = 0; row + 1 < offsets_.size(); ++row) {
    double sum = 0;
    for (auto k = offsets_[row]; k < offsets_[row + 1]; ++k)
      sum += values_[static_cast<std::size_t>(k)] * x[static_cast<std::size_t>(columns_[static_cast<std::size_t>(k)])];
    y[row] = sum;
  }
}

double maximum_norm(std::span<const double> x) {
  double largest = 0;
  for (const double value : x)
    largest = std::max(largest, std::abs(value));
  return largest;
}

double relative_distance(std::span<const double> x, std::span<const double> y) {
  double distance = 0;
  double length = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    distance += (x[i] - y[i]) * (x[i] - y[i]);
    length += y[i] * y[i];
  }
  return distance > 0 ? std::sqrt(distance / length) : 0;
}

double maximum_norm(const SparseRows &matrix) {
  double largest = 0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(matrix.n_rows()); ++row) {
    double sum = 0;
    for (auto k = matrix.offsets()[row]; k < matrix.offsets()[row + 1]; ++k)
      sum += std::abs(matrix.values()[static_cast<std::size_t>(k)]);
    largest = std::max(largest, sum);
  }
  return largest;
}

double backward_error(const SparseRows &matrix, std::span<const double> x, std::span<const double> b) {
  std::vector<double> residual(b.size());
  matrix.multiply(x, residual);
  for (std::size_t row = 0; row < b.size(); ++row)
    residual[row] = b[row] - residual[row];
  const double scale = maximum_norm(matrix) * maximum_norm(x) + maximum_norm(b);
  return scale > 0 ? maximum_norm(residual) / scale : 0;
}

SparseRows combine(double a, const SparseRows &matrix_a, double b, const SparseRows &matrix_b) {
  SparseRows sum(matrix_a.n_columns());
  std::vector<std::int64_t> columns;
  std::vector<double> values;
  for (std::size_t row = 0; row < static_cast<std::size_t>(matrix_a.n_rows()); ++row) {
    columns.clear();
    values.clear();
    auto i = static_cast<std::size_t>(matrix_a.offsets()[row]);
    auto j = static_cast<std::size_t>(matrix_b.offsets()[row]);
    const auto end_i = static_cast<std::size_t>(matrix_a.offsets()[row + 1]);
    const auto end_j = static_cast<std::size_t>(matrix_b.offsets()[row + 1]);
    while (i < end_i || j < end_j) {
      const bool from_a = j == end_j || (i < end_i && matrix_a.columns()[i] <= matrix_b.columns()[j]);
      const bool from_b = i == end_i || (j < end_j && matrix_b.columns()[j] <= matrix_a.columns()[i]);
      columns.push_back(from_a ? matrix_a.columns()[i] : matrix_b.columns()[j]);
      values.push_back((from_a ? a * matrix_a.values()[i] : 0) + (from_b ? b * matrix_b.values()[j] : 0));
      i += from_a;
      j += from_b;
    }
    sum.append_row(columns, values);
  }
  return sum;
}

} // namespace meshless::linear_algebra
