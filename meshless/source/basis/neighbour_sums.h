#pragma once

#include "meshless/basis/monomials.h"
#include "meshless/basis/shape_functions.h"
#include "meshless/linear_algebra/pack.h"

#include <array>
#include <cstddef>
#include <utility>

namespace meshless::basis {

/// The loops over the neighbours of one pack of points: sums of weights times monomials, and shape functions from their
/// coefficients. The monomials come from the table of the candidates, one number for all lanes, so that a neighbour
/// costs one multiplication and addition a term and nothing else.
///
/// All of them are plain pointers, and functions take them by value: behind a reference every store of a pack would
/// make the compiler read all of it again.
template <int dim, int m>
struct NeighbourSums {
  using Pack = linear_algebra::Pack;
  static constexpr std::size_t n = Monomials<dim, m>::size;
  static constexpr std::size_t n_moments = Monomials<dim, 2 * m>::size;
  using Vector = std::array<Pack, n>;
  using Moments = std::array<Pack, n_moments>;

  const cloud::Index *active; ///< candidates that are neighbours of a lane
  std::size_t n_active;
  const double *table; ///< monomials of degree <= 2 m of all candidates

  const double *terms(std::size_t a) const { return table + static_cast<std::size_t>(active[a]) * n_moments; }

  /// sum_J W_J p_J over all terms of degree <= 2 m.
  /// @param weights of neighbour a at a * n_lanes
  Moments moments(const double *weights) const {
    Moments result;
    sum_blocks<0>(weights, result.data());
    return result;
  }

  /// sum_J phi_J p_J over the terms of the basis about the points x themselves: about the centre of the table rounding
  /// would be that of monomials as large as the distance between the two.
  /// @param row phi of candidate j at j * stride
  Vector reproduced(const CandidateBatch<dim> &candidates, const std::array<Pack, dim> x, const double *row,
                    std::size_t stride) const {
    std::array<const double *, dim> coordinates;
    for (int k = 0; k < dim; ++k)
      coordinates[k] = candidates.coordinate(k);
    const double inverse_scale = 1 / candidates.scale();
    Vector result{};
    for (std::size_t a = 0; a < n_active; ++a) {
      const auto j = static_cast<std::size_t>(active[a]);
      std::array<Pack, dim> d;
      for (int k = 0; k < dim; ++k)
        d[k] = (coordinates[k][j] - x[k]) * inverse_scale;
      Vector own;
      Monomials<dim, m>::evaluate(d, own);
      const Pack phi = linear_algebra::load(row + j * stride);
      result[0] += phi;
#pragma GCC unroll 36
      for (std::size_t t = 1; t < n; ++t)
        result[t] += phi * own[t];
    }
    return result;
  }

  /// phi_J = sum_i c_i . p_J W_i,J
  template <std::size_t n_parts>
  void write(const std::array<Vector, n_parts> c, const std::array<const double *, n_parts> weights, double *row,
             std::size_t stride) const {
    for (std::size_t a = 0; a < n_active; ++a)
      linear_algebra::store(combined(c, weights, a), row + static_cast<std::size_t>(active[a]) * stride);
  }

  /// phi_J += c . p_J W_J
  void add(const Vector c, const double *weights, double *row, std::size_t stride) const {
    for (std::size_t a = 0; a < n_active; ++a) {
      double *phi = row + static_cast<std::size_t>(active[a]) * stride;
      linear_algebra::store(linear_algebra::load(phi) + combined<1>({c}, {weights}, a), phi);
    }
  }

private:
  /// Sums that the registers hold at a time (32 of AVX-512, 16 otherwise), beside the weight.
  static constexpr std::size_t largest_block = linear_algebra::n_lanes >= 8 ? 28 : 12;

  template <std::size_t begin>
  void sum_blocks(const double *weights, Pack *result) const {
    constexpr std::size_t n_blocks = (n_moments - begin + largest_block - 1) / largest_block;
    constexpr std::size_t size = (n_moments - begin + n_blocks - 1) / n_blocks;
    sum_block<begin, size>(weights, result);
    if constexpr (begin + size < n_moments)
      sum_blocks<begin + size>(weights, result);
  }

  template <std::size_t begin, std::size_t size>
  [[gnu::noinline]] void sum_block(const double *weights, Pack *result) const {
    [&]<std::size_t... t>(std::index_sequence<t...>) {
      std::array<Pack, size> sums{};
      for (std::size_t a = 0; a < n_active; ++a) {
        const Pack weight = linear_algebra::load(weights + a * linear_algebra::n_lanes);
        const double *p = terms(a) + begin;
        ((sums[t] += weight * p[t]), ...);
      }
      ((result[begin + t] = sums[t]), ...);
    }
    (std::make_index_sequence<size>());
  }

  template <std::size_t n_parts>
  Pack combined(const std::array<Vector, n_parts> &c, const std::array<const double *, n_parts> &weights,
                std::size_t a) const {
    const double *p = terms(a);
    Pack sum = 0;
    for (std::size_t i = 0; i < n_parts; ++i) {
      Pack polynomial = c[i][0];
#pragma GCC unroll 36
      for (std::size_t t = 1; t < n; ++t)
        polynomial += c[i][t] * p[t];
      sum += polynomial * linear_algebra::load(weights[i] + a * linear_algebra::n_lanes);
    }
    return sum;
  }
};

} // namespace meshless::basis
