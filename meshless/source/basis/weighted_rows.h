#pragma once

#include "kernel_weights.h"
#include "moment_matrix.h"
#include "neighbour_sums.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace meshless::basis {

/// Shape functions phi_J = a . p_J W_J with C a = q at one pack of points, from the moments of all neighbours.
///
/// The monomials p_J = p(xi_J - x) are about the point; phi_J = p(0)^T C^-1 p_J W_J is differentiated with their centre
/// held fast, where q and its derivatives are multiples of unit vectors: with C_k = sum p p^T W,k and C_kl = sum p p^T
/// W,kl
///   C a_k  = q,k  - C_k a                        phi_J,k  = a_k . p_J W_J + a . p_J W_J,k
///   C a_kl = q,kl - C_k a_l - C_l a_k - C_kl a   phi_J,kl = a_kl . p_J W_J + a_k . p_J W_J,l + a_l . p_J W_J,k
///                                                           + a . p_J W_J,kl,
/// which is Zhang & Batra 2008, (4.12) and (4.13), without derivatives of the monomials. The direct
/// derivatives are C a = q,k and C a = q,kl alone.
///
/// @tparam Neighbours SharedNeighbours or OwnNeighbours
template <int dim, int m, typename Neighbours>
class WeightedRows {
  using Pack = linear_algebra::Pack;
  using Matrix = MomentMatrix<dim, m>;
  using Sums = NeighbourSums<dim, m, Neighbours>;
  using Terms = typename Matrix::Terms;
  using Moments = typename Matrix::Moments;
  using Vector = typename Matrix::Vector;
  using Values = ShapeFunctionValues<dim>;
  using Workspace = typename ShapeFunctions<dim>::Workspace;
  static constexpr std::size_t n_lanes = linear_algebra::n_lanes;
  static constexpr int first_hessian = 1 + dim;
  static constexpr int first_differentiated = 1 + dim + Values::n_hessian;

  /// Term of the second derivative (k, l).
  static constexpr std::size_t hessian_term(int k, int l) {
    typename Terms::Exponents exponents{};
    ++exponents[k];
    ++exponents[l];
    return Terms::index_of(exponents);
  }

public:
  /// @param matrix factorised
  /// @param first of the points, in the rows of the values
  WeightedRows(const Sums &sums, const Matrix &matrix, bool refined, const Wanted &wanted, std::size_t first,
               Values &values, Workspace &workspace)
      : sums_(sums), matrix_(matrix), refined_(refined), wanted_(wanted), first_(first), values_(values),
        workspace_(workspace), scale_(sums.neighbours.scale()), inverse_scale_(sums.neighbours.inverse_scale()) {}

  /// What needs no derivatives of weights.
  void write_direct(bool gradient, bool hessian) const {
    std::array<DirectRow, 1 + dim + Values::n_hessian> rows;
    std::size_t n = 0;
    if (wanted_.value)
      rows[n++] = {0, 0, 1};
    if (gradient)
      for (int k = 0; k < dim; ++k)
        rows[n++] = {1 + k, 1 + static_cast<std::size_t>(k), inverse_scale_};
    if constexpr (m >= 2)
      if (hessian) {
        int quantity = first_hessian;
        for (int k = 0; k < dim; ++k)
          for (int l = k; l < dim; ++l, ++quantity)
            rows[n++] = {quantity, hessian_term(k, l), (k == l ? 2 : 1) * inverse_scale_ * inverse_scale_};
      }
    std::size_t i = 0;
    for (; i + Sums::rows_at_a_time <= n; i += Sums::rows_at_a_time)
      write_direct<Sums::rows_at_a_time>(&rows[i]);
    for (; i < n; ++i)
      write_direct<1>(&rows[i]);
  }

  /// Derivatives of the shape function itself; formulas above.
  void write_differentiated(bool gradient, bool second) const {
    differentiate_weights(second);
    const auto derivative = [&](std::size_t which) {
      return workspace_.weight_derivatives.data() + which * sums_.neighbours.size() * n_lanes;
    };
    const Vector g = matrix_.unit_solution(0, 1);
    std::array<Moments, dim> moments; // of C_k
    std::array<Vector, dim> g_k;
    for (int k = 0; k < dim; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      moments[k] = sums_.moments(derivative(axis));
      g_k[k] = Vector{};
      g_k[k][1 + axis] = inverse_scale_;
      Matrix::subtract_product(moments[k], g, g_k[k]);
      matrix_.solve(g_k[k]);
      const auto write = [&](int quantity) {
        sums_.template write<2>({g_k[k], g}, {weights(), derivative(axis)}, row(quantity), values_.stride());
        // Its monomials are reproduced as those of the direct derivative: sum_J phi_J,k p_J = e_k.
        if (refined_)
          refine({quantity, 1 + axis, inverse_scale_});
      };
      if (wanted_.differentiated_gradient)
        write(first_differentiated + k);
      if (gradient)
        write(1 + k);
    }
    if (!second)
      return;
    std::size_t kl = 0;
    for (int k = 0; k < dim; ++k)
      for (int l = k; l < dim; ++l, ++kl) {
        // Order 1 has no such monomial: the second derivative of all its terms is zero.
        const std::size_t term = m >= 2 ? hessian_term(k, l) : 0;
        const Pack unit = m >= 2 ? (k == l ? 2 : 1) / (scale_ * scale_) : Pack(0);
        Vector g_kl{};
        g_kl[term] = unit;
        Matrix::subtract_product(moments[k], g_k[l], g_kl);
        Matrix::subtract_product(moments[l], g_k[k], g_kl);
        Matrix::subtract_product(sums_.moments(derivative(dim + kl)), g, g_kl);
        matrix_.solve(g_kl);
        const int quantity = first_hessian + static_cast<int>(kl);
        sums_.template write<4>({g_kl, g_k[k], g_k[l], g},
                                {weights(), derivative(static_cast<std::size_t>(l)),
                                 derivative(static_cast<std::size_t>(k)), derivative(dim + kl)},
                                row(quantity), values_.stride());
        if (refined_)
          refine({quantity, term, unit});
      }
  }

private:
  /// Row `term` of K (2.11), times `unit`.
  struct DirectRow {
    int quantity;
    std::size_t term;
    Pack unit;
  };

  const double *weights() const { return workspace_.weights.data(); }
  double *row(int quantity) const { return values_.row(quantity, 0) + first_; }

  template <std::size_t n_rows>
  void write_direct(const DirectRow *direct) const {
    std::array<Vector, n_rows> coefficients;
    std::array<double *, n_rows> rows;
    for (std::size_t r = 0; r < n_rows; ++r) {
      coefficients[r] = matrix_.unit_solution(direct[r].term, direct[r].unit);
      rows[r] = row(direct[r].quantity);
    }
    sums_.write_rows(coefficients, weights(), rows, values_.stride());
    for (std::size_t r = 0; r < n_rows && refined_; ++r)
      refine(direct[r]);
  }

  /// One step of refinement: what the row lacks to reproduce the monomials, sum_J phi_J p_J = e_term unit, is measured
  /// on the shape functions themselves, whose rounding is that of the result, not that of the moment matrix; the
  /// correction is added to them for the same reason.
  void refine(const DirectRow &wanted_row) const {
    double *phi = row(wanted_row.quantity);
    Vector residual = sums_.reproduced(phi, values_.stride());
    for (auto &entry : residual)
      entry = -entry;
    residual[wanted_row.term] += wanted_row.unit;
    matrix_.solve(residual);
    sums_.add(residual, weights(), phi, values_.stride());
  }

  /// Derivatives of the weights by the point, as the weights themselves: dim first ones, then the second ones.
  void differentiate_weights(bool second) const {
    const Neighbours neighbours = sums_.neighbours;
    const std::size_t n_weights = neighbours.size() * n_lanes;
    auto &derivatives = workspace_.weight_derivatives;
    derivatives.resize((dim + (second ? Values::n_hessian : 0)) * n_weights);
    for (std::size_t a = 0; a < neighbours.size(); ++a) {
      const auto d = neighbours.offset(a);
      const Pack to_h = scale_ * neighbours.inverse_h(a);
      // Of s^2, by x in units of the scale.
      const Pack slope = linear_algebra::load(&workspace_.slopes[a * n_lanes]) * (to_h * to_h);
      for (int k = 0; k < dim; ++k)
        // s^2 falls as x moves towards the particle
        linear_algebra::store(-slope * d[k] * inverse_scale_,
                              &derivatives[static_cast<std::size_t>(k) * n_weights + a * n_lanes]);
      if (!second)
        continue;
      const Pack curvature = linear_algebra::load(&workspace_.curvatures[a * n_lanes]) * (to_h * to_h) * (to_h * to_h);
      std::size_t kl = dim;
      for (int k = 0; k < dim; ++k)
        for (int l = k; l < dim; ++l, ++kl) {
          Pack value = curvature * d[k] * d[l];
          if (k == l)
            value += slope;
          linear_algebra::store(value * (inverse_scale_ * inverse_scale_), &derivatives[kl * n_weights + a * n_lanes]);
        }
    }
  }

  const Sums &sums_;
  const Matrix &matrix_;
  bool refined_;
  const Wanted &wanted_;
  std::size_t first_;
  Values &values_;
  Workspace &workspace_;
  Pack scale_;
  Pack inverse_scale_;
};

} // namespace meshless::basis
