#pragma once

#include "meshless/basis/dense_lu.h"
#include "meshless/basis/monomials.h"
#include "meshless/linear_algebra/pack.h"

#include <array>
#include <span>
#include <vector>

// g++ 12 sees an index one past the end in the unrolled loops, which they never reach.
#pragma GCC diagnostic ignored "-Warray-bounds"

namespace meshless::basis {

/// The moment matrix C = sum_J p_J p_J^T W_J of a basis of degree m, one point a SIMD lane: only its distinct entries,
/// the moments of the monomials of twice the degree, are summed; it is factorised as L D L^T without
/// pivoting (symmetric and, for a positive kernel, positive definite), or where that fails for a kernel
/// with negative values by LU with complete pivoting, lane by lane.
template <int dim, int m>
class MomentMatrix {
  using Pack = linear_algebra::Pack;

public:
  using Terms = Monomials<dim, m>;
  using MomentTerms = Monomials<dim, 2 * m>;
  static constexpr std::size_t n = Terms::size;
  static constexpr std::size_t n_moments = MomentTerms::size;
  using Offset = std::array<Pack, dim>;
  using Moments = std::array<Pack, n_moments>;
  using Vector = std::array<Pack, n>;

  /// Entry (a, b) of the moment matrix in the list of distinct moments.
  static constexpr auto moment_of = [] {
    std::array<std::array<std::size_t, n>, n> index{};
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        typename Terms::Exponents sum{};
        for (int k = 0; k < dim; ++k)
          sum[k] = Terms::table.exponents[a][k] + Terms::table.exponents[b][k];
        index[a][b] = MomentTerms::index_of(sum);
      }
    return index;
  }();

  /// Leaves the factor uninitialised: it is large.
  MomentMatrix() {} // NOLINT(modernize-use-equals-default): = default would set it to zero

  /// result -= C v
  static void subtract_product(const Moments &moments, const Vector &v, Vector &result) {
#pragma GCC unroll 10
    for (std::size_t i = 0; i < n; ++i)
#pragma GCC unroll 10
      for (std::size_t j = 0; j < n; ++j)
        result[i] -= moments[moment_of[i][j]] * v[j];
  }

  static Pack dot(const Vector &a, const Vector &b) {
    Pack sum = a[0] * b[0];
#pragma GCC unroll 10
    for (std::size_t t = 1; t < n; ++t)
      sum += a[t] * b[t];
    return sum;
  }

  /// L D L^T; returns the smallest pivot over its diagonal entry of every lane, negative if the lane's
  /// matrix is not positive definite, 0 if it is not a number (no neighbour at all).
  Pack factorise(const Moments &moments) {
    pivoted_ = {};
    Pack smallest = 1;
    Vector pivots;
#pragma GCC unroll 10
    for (std::size_t i = 0; i < n; ++i) {
#pragma GCC unroll 10
      for (std::size_t j = 0; j < i; ++j) {
        Pack sum = moments[moment_of[i][j]];
#pragma GCC unroll 10
        for (std::size_t k = 0; k < j; ++k)
          sum -= factor_[i][k] * factor_[j][k] * pivots[k];
        factor_[i][j] = sum * factor_[j][j];
      }
      const Pack diagonal = moments[moment_of[i][i]];
      Pack pivot = diagonal;
#pragma GCC unroll 10
      for (std::size_t k = 0; k < i; ++k)
        pivot -= factor_[i][k] * factor_[i][k] * pivots[k];
      // Zeros, of a point without neighbours or of a singular matrix, are to be found and not to be divided by.
      Pack ratio = pivot / one_for_zero(abs(diagonal));
      where(ratio != ratio, ratio) = 0;
      smallest = min(smallest, ratio);
      pivots[i] = pivot;
      factor_[i][i] = 1 / one_for_zero(pivot);
      where(pivot == 0, factor_[i][i]) = 0;
    }
    return smallest;
  }

  /// Factorises again with complete pivoting; later solutions use that.
  /// @param lanes one solver a lane, kept by reference
  /// @returns the smallest pivot over the largest of every lane
  Pack factorise_pivoted(const Moments &moments, std::span<DenseLu> lanes) {
    pivoted_ = lanes;
    Pack ratios = 0;
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      lanes[lane].resize(n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          lanes[lane](i, j) = moments[moment_of[i][j]][lane];
      ratios[lane] = lanes[lane].factorise();
    }
    return ratios;
  }

  /// Solves C x = b in place.
  void solve(Vector &b) const {
    if (!pivoted_.empty()) {
      solve_pivoted(b);
      return;
    }
#pragma GCC unroll 10
    for (std::size_t i = 1; i < n; ++i)
#pragma GCC unroll 10
      for (std::size_t j = 0; j < i; ++j)
        b[i] -= factor_[i][j] * b[j];
#pragma GCC unroll 10
    for (std::size_t i = 0; i < n; ++i)
      b[i] *= factor_[i][i];
    for (std::size_t i = n - 1; i > 0; --i)
      for (std::size_t j = 0; j < i; ++j)
        b[j] -= factor_[i][j] * b[i];
  }

  Vector unit_solution(std::size_t term, const Pack &scale) const {
    Vector b{};
    b[term] = scale;
    solve(b);
    return b;
  }

private:
  static Pack one_for_zero(Pack x) {
    where(x == 0, x) = 1;
    return x;
  }

  void solve_pivoted(Vector &b) const {
    std::array<double, n> lane_values;
    for (std::size_t lane = 0; lane < pivoted_.size(); ++lane) {
      for (std::size_t i = 0; i < n; ++i)
        lane_values[i] = b[i][lane];
      pivoted_[lane].solve(lane_values);
      for (std::size_t i = 0; i < n; ++i)
        b[i][lane] = lane_values[i];
    }
  }

  std::array<Vector, n> factor_; ///< row i: L_i0 ... L_i,i-1 and 1 / D_i on the diagonal
  std::span<DenseLu> pivoted_;
};

} // namespace meshless::basis
