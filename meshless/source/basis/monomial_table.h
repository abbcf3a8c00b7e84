#pragma once

#include "meshless/basis/monomials.h"
#include "meshless/basis/shape_functions.h"
#include "meshless/linear_algebra/pack.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace meshless::basis {

/// Change of centre of monomials of degree <= `degree`: from those about x_0 to those about x_0 + d.
///
/// Along one axis x^k becomes (x - d)^k by k steps x^i -= d x^(i-1), i = k ... 1, each on what the step before left:
/// elementary operations on pairs of terms, one list for all axes. The transposed list, backwards, carries the
/// coefficients of a polynomial the other way.
template <int dim, int degree>
class Translation {
  using Terms = Monomials<dim, degree>;
  using Pack = linear_algebra::Pack;
  using Vector = std::array<Pack, Terms::size>;

  struct Step {
    std::size_t to = 0;
    std::size_t from = 0;
    int axis = 0;
  };

  template <typename Visitor>
  static constexpr void visit_steps(const Visitor &visit) {
    for (int axis = 0; axis < dim; ++axis)
      for (int pass = 1; pass <= degree; ++pass)
        for (int power = degree; power >= pass; --power)
          for (std::size_t t = 0; t < Terms::size; ++t)
            if (Terms::table.exponents[t][axis] == power) {
              auto lower = Terms::table.exponents[t];
              --lower[axis];
              visit(Step{t, Terms::index_of(lower), axis});
            }
  }
  static constexpr std::size_t n_steps = [] {
    std::size_t n = 0;
    visit_steps([&](const Step &) { ++n; });
    return n;
  }();
  static constexpr auto steps = [] {
    std::array<Step, n_steps> list{};
    std::size_t n = 0;
    visit_steps([&](const Step &step) { list[n++] = step; });
    return list;
  }();
  static constexpr bool unrolled = n_steps <= 96;

public:
  /// Moments about x_0 become those about x_0 + d.
  static void move_moments(const std::array<Pack, dim> &d, Vector &v) {
    if constexpr (unrolled)
      [&]<std::size_t... i>(std::index_sequence<i...>) {
        ((v[steps[i].to] -= d[steps[i].axis] * v[steps[i].from]), ...);
      }
    (std::make_index_sequence<n_steps>());
    else for (const auto &step : steps) v[step.to] -= d[step.axis] * v[step.from];
  }

  /// Coefficients of a polynomial in monomials about x_0 + d become those about x_0.
  static void move_coefficients(const std::array<Pack, dim> &d, Vector &v) {
    if constexpr (unrolled)
      [&]<std::size_t... i>(std::index_sequence<i...>) {
        ((v[steps[n_steps - 1 - i].from] -= d[steps[n_steps - 1 - i].axis] * v[steps[n_steps - 1 - i].to]), ...);
      }
    (std::make_index_sequence<n_steps>());
    else for (std::size_t i = n_steps; i-- > 0;) v[steps[i].from] -= d[steps[i].axis] * v[steps[i].to];
  }
};

/// Fills the monomials (xi_J - x_0) / scale of degree <= `degree` of all candidates, about one place x_0 for all points
/// of a batch: at every pair of point and candidate they are then read, not computed.
template <int dim, int degree>
void tabulate_monomials(const CandidateBatch<dim> &candidates, const cloud::Point<dim> &centre) {
  using linear_algebra::load;
  using linear_algebra::n_lanes;
  using linear_algebra::Pack;
  using Terms = Monomials<dim, degree>;
  constexpr std::size_t n = Terms::size;
  auto &table = candidates.monomials();
  table.degree = degree;
  table.centre = centre;
  table.rows.resize(candidates.size() * n);
  const double inverse_scale = 1 / candidates.scale();
  for (std::size_t first = 0; first < candidates.size(); first += n_lanes) {
    const std::size_t lanes = std::min<std::size_t>(n_lanes, candidates.size() - first);
    std::array<Pack, dim> d;
    for (int k = 0; k < dim; ++k) {
      std::array<double, n_lanes> x{};
      std::copy_n(candidates.coordinate(k) + first, lanes, x.begin());
      d[k] = (load(x.data()) - centre[k]) * inverse_scale;
    }
    std::array<Pack, n> terms;
    Terms::evaluate(d, terms);
    for (std::size_t lane = 0; lane < lanes; ++lane)
#pragma GCC unroll 8 // one number a turn would cost more than the monomials
      for (std::size_t t = 0; t < n; ++t)
        table.rows[(first + lane) * n + t] = terms[t][lane];
  }
}

} // namespace meshless::basis
