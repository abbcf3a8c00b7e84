#pragma once

#include "monomial_table.h"

#include "meshless/basis/monomials.h"
#include "meshless/basis/shape_functions.h"
#include "meshless/linear_algebra/pack.h"

#include <array>
#include <cstddef>
#include <utility>

namespace meshless::basis {

/// Neighbours that the points of a pack share: candidates, their monomials from the table about one centre, one number
/// for all lanes. A neighbour costs one multiplication and addition a term and nothing else.
template <int dim, int m>
struct SharedNeighbours {
  using Pack = linear_algebra::Pack;
  static constexpr std::size_t n = Monomials<dim, m>::size;
  static constexpr std::size_t n_moments = Monomials<dim, 2 * m>::size;

  const cloud::Index *active; ///< candidates that are neighbours of a lane
  std::size_t n_active;
  const double *table;                         ///< monomials of degree <= 2 m of all candidates
  std::array<const double *, dim> coordinates; ///< of the candidates
  const double *inverse_lengths;               ///< 1 / h of the candidates
  std::array<Pack, dim> x;                     ///< the points
  std::array<Pack, dim> offset_from_centre;    ///< of the points from the centre of the table, in units of the scale
  double scale_length;
  double inverse_scale_length;

  std::size_t size() const { return n_active; }
  /// Row of the values that belongs to neighbour a.
  std::size_t row(std::size_t a) const { return static_cast<std::size_t>(active[a]); }
  const double *terms(std::size_t a) const { return table + row(a) * n_moments; }
  double inverse_h(std::size_t a) const { return inverse_lengths[row(a)]; }
  Pack scale() const { return scale_length; }
  Pack inverse_scale() const { return inverse_scale_length; }

  /// (xi_J - x) / scale.
  std::array<Pack, dim> offset(std::size_t a) const {
    std::array<Pack, dim> d;
    for (int k = 0; k < dim; ++k)
      d[k] = (coordinates[k][row(a)] - x[k]) * inverse_scale_length;
    return d;
  }

  /// Adds the moments from `begin` on to the sums.
  template <std::size_t begin, std::size_t... t>
  void add_moments(std::size_t a, const Pack weight, std::array<Pack, sizeof...(t)> &sums,
                   std::index_sequence<t...>) const {
    const double *p = terms(a) + begin;
    ((sums[t] += weight * p[t]), ...);
  }

  void move_to_points(std::array<Pack, n_moments> &moments) const {
    Translation<dim, 2 * m>::move_moments(offset_from_centre, moments);
  }
  void move_from_points(std::array<Pack, n> &coefficients) const {
    Translation<dim, m>::move_coefficients(offset_from_centre, coefficients);
  }
};

/// Neighbours of every lane's own: monomials about the points themselves, computed where they are needed.
template <int dim, int m>
struct OwnNeighbours {
  using Pack = linear_algebra::Pack;
  using Terms = Monomials<dim, m>;
  using Moments = Monomials<dim, 2 * m>;
  static constexpr std::size_t n = Terms::size;
  static constexpr std::size_t n_moments = Moments::size;

  std::size_t n_slots;
  std::array<const double *, dim> offsets; ///< (xi_J - x) / scale of slot a at a * n_lanes
  const double *inverse_lengths;           ///< 1 / h_J likewise
  Pack scale_lengths;
  Pack inverse_scale_lengths;

  std::size_t size() const { return n_slots; }
  std::size_t row(std::size_t a) const { return a; }
  Pack inverse_h(std::size_t a) const { return linear_algebra::load(inverse_lengths + a * linear_algebra::n_lanes); }
  Pack scale() const { return scale_lengths; }
  Pack inverse_scale() const { return inverse_scale_lengths; }
  std::array<Pack, dim> offset(std::size_t a) const {
    std::array<Pack, dim> d;
    for (int k = 0; k < dim; ++k)
      d[k] = linear_algebra::load(offsets[k] + a * linear_algebra::n_lanes);
    return d;
  }
  std::array<Pack, n> terms(std::size_t a) const {
    std::array<Pack, n> p;
    Terms::evaluate(offset(a), p);
    return p;
  }

  /// Every moment of a degree above m is a product of two terms of the basis, the first of degree m.
  static constexpr auto factors = [] {
    std::array<std::array<std::size_t, 2>, n_moments> pairs{};
    for (std::size_t t = n; t < n_moments; ++t)
      for (std::size_t first = 0; first < n; ++first) {
        auto rest = Moments::table.exponents[t];
        int degree = 0;
        bool divides = true;
        for (int k = 0; k < dim; ++k) {
          degree += Terms::table.exponents[first][k];
          rest[k] -= Terms::table.exponents[first][k];
          divides = divides && rest[k] >= 0;
        }
        if (divides && degree == m)
          pairs[t] = {first, Terms::index_of(rest)};
      }
    return pairs;
  }();

  template <std::size_t begin, std::size_t... t>
  void add_moments(std::size_t a, const Pack weight, std::array<Pack, sizeof...(t)> &sums,
                   std::index_sequence<t...>) const {
    const auto p = terms(a);
    std::array<Pack, n> weighted;
#pragma GCC unroll 36
    for (std::size_t i = 0; i < n; ++i)
      weighted[i] = weight * p[i];
    const auto add = [&]<std::size_t moment>(std::integral_constant<std::size_t, moment>, Pack &sum) {
      if constexpr (moment < n)
        sum += weighted[moment];
      else
        sum += weighted[factors[moment][0]] * p[factors[moment][1]];
    };
    (add(std::integral_constant<std::size_t, begin + t>{}, sums[t]), ...);
  }

  void move_to_points(std::array<Pack, n_moments> &) const {}
  void move_from_points(std::array<Pack, n> &) const {}
};

/// The loops over the neighbours of one pack of points: sums of weights times monomials, and shape functions from their
/// coefficients.
///
/// All of them are plain pointers, and functions take them by value: behind a reference every store of a pack would
/// make the compiler read all of it again.
template <int dim, int m, typename Neighbours>
struct NeighbourSums {
  using Pack = linear_algebra::Pack;
  static constexpr std::size_t n = Monomials<dim, m>::size;
  static constexpr std::size_t n_moments = Monomials<dim, 2 * m>::size;
  using Vector = std::array<Pack, n>;
  using Moments = std::array<Pack, n_moments>;
  /// Rows that are written at a time: their coefficients stay in registers.
  static constexpr std::size_t rows_at_a_time = linear_algebra::n_lanes < 8 || n > 12 ? 1 : 24 / n;

  Neighbours neighbours;

  /// sum_J W_J p_J over all terms of degree <= 2 m, about the points.
  /// @param weights of neighbour a at a * n_lanes
  Moments moments(const double *weights) const {
    Moments result;
    sum_blocks<0>(weights, result.data());
    neighbours.move_to_points(result);
    return result;
  }

  /// sum_J phi_J p_J over the terms of the basis about the points themselves: about the centre of a table rounding
  /// would be that of monomials as large as the distance between the two.
  /// @param row phi of row j at j * stride
  Vector reproduced(const double *row, std::size_t stride) const {
    const Neighbours own = neighbours;
    Vector result{};
    for (std::size_t a = 0; a < own.size(); ++a) {
      Vector p;
      Monomials<dim, m>::evaluate(own.offset(a), p);
      const Pack phi = linear_algebra::load(row + own.row(a) * stride);
      result[0] += phi;
#pragma GCC unroll 36
      for (std::size_t t = 1; t < n; ++t)
        result[t] += phi * p[t];
    }
    return result;
  }

  /// phi_J = sum_i c_i . p_J W_i,J
  /// @param c about the points
  template <std::size_t n_parts>
  void write(std::array<Vector, n_parts> c, const std::array<const double *, n_parts> weights, double *row,
             std::size_t stride) const {
    const Neighbours own = neighbours;
    for (auto &part : c)
      own.move_from_points(part);
    for (std::size_t a = 0; a < own.size(); ++a)
      linear_algebra::store(combined(c, weights, a, own.terms(a)), row + own.row(a) * stride);
  }

  /// phi_J = c . p_J W_J, several rows.
  template <std::size_t n_rows>
  void write_rows(std::array<Vector, n_rows> c, const double *weights, const std::array<double *, n_rows> rows,
                  std::size_t stride) const {
    const Neighbours own = neighbours;
    for (auto &row : c)
      own.move_from_points(row);
    for (std::size_t a = 0; a < own.size(); ++a) {
      const auto p = own.terms(a);
      for (std::size_t r = 0; r < n_rows; ++r)
        linear_algebra::store(combined<1>({c[r]}, {weights}, a, p), rows[r] + own.row(a) * stride);
    }
  }

  /// phi_J += c . p_J W_J
  void add(Vector c, const double *weights, double *row, std::size_t stride) const {
    const Neighbours own = neighbours;
    own.move_from_points(c);
    for (std::size_t a = 0; a < own.size(); ++a) {
      double *phi = row + own.row(a) * stride;
      linear_algebra::store(linear_algebra::load(phi) + combined<1>({c}, {weights}, a, own.terms(a)), phi);
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
    [&]<std::size_t... t>(std::index_sequence<t...> all) {
      const Neighbours own = neighbours;
      std::array<Pack, size> sums{};
      for (std::size_t a = 0; a < own.size(); ++a)
        own.template add_moments<begin>(a, linear_algebra::load(weights + a * linear_algebra::n_lanes), sums, all);
      ((result[begin + t] = sums[t]), ...);
    }
    (std::make_index_sequence<size>());
  }

  template <std::size_t n_parts, typename TermsOfNeighbour>
  static Pack combined(const std::array<Vector, n_parts> &c, const std::array<const double *, n_parts> &weights,
                       std::size_t a, const TermsOfNeighbour &p) {
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
