#include "meshless/basis/dense_lu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meshless::basis {

namespace {

/// The power of two next to 1 / x; 1 for zero.
double inverse_power_of_two(double x) { return x > 0 && std::isfinite(x) ? std::exp2(-std::ilogb(x)) : 1; }

} // namespace

void DenseLu::resize(std::size_t n) {
  n_ = n;
  data_.assign(n * n, 0.0);
  row_.resize(n);
  column_.resize(n);
  row_scale_.resize(n);
  column_scale_.resize(n);
  scratch_.resize(n);
}

double DenseLu::factorise() {
  auto &a = *this;
  for (std::size_t i = 0; i < n_; ++i) {
    double largest = 0;
    for (std::size_t j = 0; j < n_; ++j)
      largest = std::max(largest, std::abs(a(i, j)));
    row_scale_[i] = inverse_power_of_two(largest);
    for (std::size_t j = 0; j < n_; ++j)
      a(i, j) *= row_scale_[i];
  }
  for (std::size_t j = 0; j < n_; ++j) {
    double largest = 0;
    for (std::size_t i = 0; i < n_; ++i)
      largest = std::max(largest, std::abs(a(i, j)));
    column_scale_[j] = inverse_power_of_two(largest);
    for (std::size_t i = 0; i < n_; ++i)
      a(i, j) *= column_scale_[j];
  }
  for (std::size_t k = 0; k < n_; ++k)
    row_[k] = column_[k] = k;

  double smallest = std::numeric_limits<double>::infinity();
  double largest_pivot = 0;
  for (std::size_t k = 0; k < n_; ++k) {
    std::size_t p = k;
    std::size_t q = k;
    double largest = -1;
    for (std::size_t i = k; i < n_; ++i)
      for (std::size_t j = k; j < n_; ++j) {
        const double entry = std::abs(a(i, j));
        if (!std::isfinite(entry))
          return 0;
        if (entry > largest) {
          largest = entry;
          p = i;
          q = j;
        }
      }
    if (largest == 0)
      return 0;
    for (std::size_t j = 0; j < n_; ++j)
      std::swap(a(k, j), a(p, j));
    for (std::size_t i = 0; i < n_; ++i)
      std::swap(a(i, k), a(i, q));
    std::swap(row_[k], row_[p]);
    std::swap(column_[k], column_[q]);
    smallest = std::min(smallest, largest);
    largest_pivot = std::max(largest_pivot, largest);
    for (std::size_t i = k + 1; i < n_; ++i) {
      const double factor = a(i, k) / a(k, k);
      a(i, k) = factor;
      for (std::size_t j = k + 1; j < n_; ++j)
        a(i, j) -= factor * a(k, j);
    }
  }
  return smallest / largest_pivot;
}

void DenseLu::solve(std::span<double> b) {
  const auto &a = *this;
  const auto entry = [&](std::size_t i, std::size_t j) { return a.data_[i * n_ + j]; };
  for (std::size_t i = 0; i < n_; ++i) {
    double sum = b[row_[i]] * row_scale_[row_[i]];
    for (std::size_t j = 0; j < i; ++j)
      sum -= entry(i, j) * scratch_[j];
    scratch_[i] = sum;
  }
  for (std::size_t i = n_; i-- > 0;) {
    for (std::size_t j = i + 1; j < n_; ++j)
      scratch_[i] -= entry(i, j) * scratch_[j];
    scratch_[i] /= entry(i, i);
  }
  for (std::size_t i = 0; i < n_; ++i)
    b[column_[i]] = scratch_[i] * column_scale_[column_[i]];
}

void DenseLu::solve_transposed(std::span<double> b) {
  const auto entry = [&](std::size_t i, std::size_t j) { return data_[i * n_ + j]; };
  for (std::size_t i = 0; i < n_; ++i) {
    double sum = b[column_[i]] * column_scale_[column_[i]];
    for (std::size_t j = 0; j < i; ++j)
      sum -= entry(j, i) * scratch_[j];
    scratch_[i] = sum / entry(i, i);
  }
  for (std::size_t i = n_; i-- > 0;)
    for (std::size_t j = i + 1; j < n_; ++j)
      scratch_[i] -= entry(j, i) * scratch_[j];
  for (std::size_t i = 0; i < n_; ++i)
    b[row_[i]] = scratch_[i] * row_scale_[row_[i]];
}

} // namespace meshless::basis
