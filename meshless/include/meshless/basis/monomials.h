#pragma once

#include <array>
#include <cstddef>

namespace meshless::basis {

/// Complete monomials of degree <= order in dim variables, graded: 1; x, y; x^2, x y, y^2; ...
///
/// The papers order the second-order terms differently ((2.3): squares first); the set is the
/// same, and so are all shape functions. Coefficients are those of plain monomials, without the
/// factors 1/2 of the Taylor series.
template <int dim, int order>
class Monomials {
  static constexpr std::size_t binomial(std::size_t n, std::size_t k) {
    std::size_t result = 1;
    for (std::size_t i = 1; i <= k; ++i)
      result = result * (n - k + i) / i;
    return result;
  }

public:
  static constexpr std::size_t size = binomial(order + dim, dim);
  using Exponents = std::array<int, dim>;

  struct Table {
    std::array<Exponents, size> exponents{};
    /// Term t = term parent[t] times coordinate axis[t].
    std::array<std::size_t, size> parent{};
    std::array<int, size> axis{};
  };

  static constexpr Table make_table() {
    Table table;
    std::size_t n = 1;
    std::size_t previous_begin = 0;
    for (int degree = 1; degree <= order; ++degree) {
      const std::size_t begin = n;
      // Every monomial once: extend those of the previous degree by axes not below their last one.
      for (std::size_t t = previous_begin; t < begin; ++t)
        for (int k = last_axis(table.exponents[t]); k < dim; ++k) {
          table.exponents[n] = table.exponents[t];
          ++table.exponents[n][k];
          table.parent[n] = t;
          table.axis[n] = k;
          ++n;
        }
      previous_begin = begin;
    }
    return table;
  }

  static constexpr Table table = make_table();

  /// Index of the term with these exponents.
  static constexpr std::size_t index_of(const Exponents &exponents) {
    for (std::size_t t = 0; t < size; ++t)
      if (table.exponents[t] == exponents)
        return t;
    return size;
  }

private:
  static constexpr int last_axis(const Exponents &exponents) {
    int last = 0;
    for (int k = 0; k < dim; ++k)
      if (exponents[k] > 0)
        last = k;
    return last;
  }

public:
  /// Values of all terms at the offset d (scaled by h), each from its parent by one product.
  template <typename T>
  static void evaluate(const std::array<T, dim> &d, std::array<T, size> &values) {
    values[0] = T(1);
#pragma GCC unroll 64
    for (std::size_t t = 1; t < size; ++t)
      values[t] = values[table.parent[t]] * d[table.axis[t]];
  }
};

/// Number of terms of degree <= order in dim variables.
constexpr std::size_t n_monomials(int dim, int order) {
  std::size_t result = 1;
  for (int k = 1; k <= dim; ++k)
    result = result * static_cast<std::size_t>(order + k) / static_cast<std::size_t>(k);
  return result;
}

} // namespace meshless::basis
