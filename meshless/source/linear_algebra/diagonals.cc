#include "meshless/linear_algebra/diagonals.h"

#include <algorithm>
#include <cstdlib>

namespace meshless::linear_algebra {

Diagonals::Diagonals(const SparseRows &matrix, double factor)
    : n_rows_(static_cast<std::size_t>(matrix.n_rows())), stride_(padded(n_rows_)) {
  const auto for_entries = [&](auto f) {
    for (std::int64_t i = 0; i < matrix.n_rows(); ++i)
      for (auto e = matrix.offsets()[static_cast<std::size_t>(i)];
           e < matrix.offsets()[static_cast<std::size_t>(i) + 1]; ++e)
        f(i, matrix.columns()[static_cast<std::size_t>(e)], matrix.values()[static_cast<std::size_t>(e)]);
  };
  for_entries([&](std::int64_t i, std::int64_t j, double) {
    half_width_ = std::max(half_width_, static_cast<std::size_t>(std::abs(j - i)));
  });
  values_.assign((2 * half_width_ + 1) * stride_, 0.0);
  for_entries([&](std::int64_t i, std::int64_t j, double value) {
    const auto k = static_cast<std::size_t>(j - i + static_cast<std::int64_t>(half_width_));
    values_[k * stride_ + static_cast<std::size_t>(i)] = factor * value;
  });
}

} // namespace meshless::linear_algebra
