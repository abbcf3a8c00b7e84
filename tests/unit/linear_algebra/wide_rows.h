#pragma once

#include "meshless/linear_algebra/sparse_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace wide_rows_sample {

/// A non-symmetric operator of wide rows on an n x n grid of particles with two unknowns each: a smooth kernel of
/// radius 2.5 with a dominant centre, and a coupling of both unknowns. `shuffled`: particles are numbered without
/// order.
inline meshless::linear_algebra::SparseRows wide_rows(std::int64_t n, double centre, bool shuffled = false) {
  const auto number = [&](std::int64_t i, std::int64_t j) {
    const std::int64_t k = i * n + j;
    return shuffled ? (k * 7919) % (n * n) : k; // 7919 is prime and divides no n used here
  };
  std::vector<std::int64_t> where_i(static_cast<std::size_t>(n * n));
  std::vector<std::int64_t> where_j(where_i.size());
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = 0; j < n; ++j) {
      where_i[static_cast<std::size_t>(number(i, j))] = i;
      where_j[static_cast<std::size_t>(number(i, j))] = j;
    }
  meshless::linear_algebra::SparseRows matrix(2 * n * n);
  for (std::size_t k = 0; k < where_i.size(); ++k) {
    const std::int64_t i = where_i[k];
    const std::int64_t j = where_j[k];
    std::vector<std::pair<std::int64_t, std::pair<double, double>>> row; // column, diagonal part, coupling
    for (std::int64_t di = -2; di <= 2; ++di)
      for (std::int64_t dj = -2; dj <= 2; ++dj) {
        if (i + di < 0 || i + di >= n || j + dj < 0 || j + dj >= n)
          continue;
        const double r2 = double(di * di + dj * dj);
        const double value = r2 == 0 ? centre : -std::exp(-r2) * (1 + .1 * double(di));
        row.push_back({number(i + di, j + dj), {value, .2 * double(di * dj) * std::exp(-r2)}});
      }
    std::sort(row.begin(), row.end());
    for (std::int64_t d = 0; d < 2; ++d) {
      std::vector<std::int64_t> columns;
      std::vector<double> values;
      for (const auto &[column, value] : row)
        for (std::int64_t e = 0; e < 2; ++e) {
          columns.push_back(2 * column + e);
          values.push_back(d == e ? value.first : value.second);
        }
      matrix.append_row(columns, values);
    }
  }
  return matrix;
}

/// The centre that makes the rows inside sum to zero, as those of an operator without supports do.
inline double balanced_centre() {
  double sum = 0;
  for (int di = -2; di <= 2; ++di)
    for (int dj = -2; dj <= 2; ++dj)
      if (di != 0 || dj != 0)
        sum += std::exp(-double(di * di + dj * dj));
  return sum;
}

inline std::vector<double> wavy(std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = std::sin(.37 * double(i)) + .1 * std::cos(11. * double(i));
  return x;
}

} // namespace wide_rows_sample
