#include "weighted_basis.h"

#include "moment_matrix.h"
#include "monomial_table.h"
#include "neighbour_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace meshless::basis {

namespace {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

/// Moment matrices with a smaller pivot ratio have their shape functions refined once: the monomials are then
/// reproduced to rounding all the same. Second derivatives need it sooner, for collocation amplifies their rounding by
/// h^-2 (a cubic on 16 x 4 particles, m = 3: relative error 3e-10 without, 1e-12 with it); inside of even clouds the
/// ratio is .5 for m = 2, .3 for m = 3.
constexpr double refined_pivot_ratio = 1e-2;
constexpr double refined_for_second_derivatives = .4;

/// How far from the centre of the monomials the points may lie, in units of the scale (the mean h): rounding grows with
/// the power 2 m of this distance over the width of the kernel.
constexpr double largest_offset = 1;

/// Shape functions phi_J = a . p_J W_J with C a = q, from the moments of all neighbours.
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
/// Sums over neighbours are taken about one centre for all points, where the monomials of a neighbour are numbers in a
/// table (NeighbourSums); moments are moved to the point and coefficients back from it (Translation).
template <int dim, int m>
class WeightedBasis final : public ShapeFunctions<dim> {
  using Matrix = MomentMatrix<dim, m>;
  using Sums = NeighbourSums<dim, m>;
  using Terms = typename Matrix::Terms;
  using Offset = typename Matrix::Offset;
  using Moments = typename Matrix::Moments;
  using Vector = typename Matrix::Vector;
  using Values = ShapeFunctionValues<dim>;
  using typename ShapeFunctions<dim>::Workspace;
  static constexpr int first_hessian = 1 + dim;
  static constexpr int first_differentiated = 1 + dim + Values::n_hessian;

  /// Term of the second derivative (k, l).
  static constexpr std::size_t hessian_term(int k, int l) {
    typename Terms::Exponents exponents{};
    ++exponents[k];
    ++exponents[l];
    return Terms::index_of(exponents);
  }

  /// What all steps at one pack of points share.
  struct Place {
    Sums sums;
    const double *weights;
    const CandidateBatch<dim> &candidates;
    Offset x;
    Offset offset; ///< of the points from the centre of the table, in units of the scale
    Values &values;
    std::size_t first;
    double scale;
    double inverse_scale;
    bool refine;

    double *row(int quantity) const { return values.row(quantity, 0) + first; }
    std::size_t stride() const { return values.stride(); }
    Moments moments(const double *weights_) const {
      auto result = sums.moments(weights_);
      Translation<dim, 2 * m>::move_moments(offset, result);
      return result;
    }
    Vector about_centre(Vector coefficients) const {
      Translation<dim, m>::move_coefficients(offset, coefficients);
      return coefficients;
    }
  };

public:
  WeightedBasis(const Weighing &weighing, DerivativeKind kind)
      : weighing_(weighing), kind_(kind), positive_(kernels::describe(weighing.kernel).non_negative) {}

  double support() const override { return search_radius(kernels::support_of(weighing_.kernel), weighing_.edge); }
  int order() const override { return m; }
  std::size_t n_terms() const override { return Matrix::n; }

  Regularity evaluate(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, const Wanted &wanted,
                      Values &values, Workspace &workspace) const override {
    if (wanted.hessian && m < 2 && kind_ == DerivativeKind::direct)
      throw std::invalid_argument("second derivatives need a basis of order 2 at least");
    if (weighing_.volumes)
      require_volumes(candidates);
    const bool differentiated = kind_ == DerivativeKind::differentiated;
    const WeightDerivatives derivatives = differentiated && wanted.hessian ? WeightDerivatives::second
                                          : wanted.differentiated_gradient || (differentiated && wanted.gradient)
                                              ? WeightDerivatives::first
                                              : WeightDerivatives::none;
    values.resize(wanted, candidates.size(), points.stride());
    const std::size_t n_weights = candidates.size() * n_lanes;
    workspace.weights.resize(n_weights);
    workspace.slopes.resize(derivatives == WeightDerivatives::none ? 0 : n_weights);
    workspace.curvatures.resize(derivatives == WeightDerivatives::second ? n_weights : 0);
    Regularity regularity;
    for (std::size_t first = 0; first < points.stride(); first += n_lanes) {
      if (!centre_table(points, first, candidates)) {
        evaluate_points(points, first, candidates, wanted, values, workspace, regularity);
        continue;
      }
      evaluate_pack(points, candidates, first, wanted, derivatives, values, workspace, regularity);
    }
    if (regularity.smallest_pivot_ratio <= singular_pivot_ratio)
      regularity.n_neighbours = count_neighbours<dim>(weighing_, points.point(regularity.worst_point), candidates);
    return regularity;
  }

private:
  /// A table of monomials with its centre near the points of the pack; false: they are too far from each other.
  static bool centre_table(const PointBatch<dim> &points, std::size_t first, const CandidateBatch<dim> &candidates) {
    auto &table = candidates.monomials();
    const double limit = largest_offset * candidates.scale();
    const auto near = [&](const cloud::Point<dim> &centre) {
      Pack squared = 0;
      for (int k = 0; k < dim; ++k) {
        const Pack d = load(points.coordinate(k) + first) - centre[k];
        squared += d * d;
      }
      return all_of(squared <= limit * limit);
    };
    cloud::Point<dim> centre = table.centre;
    if (!near(centre)) {
      for (int k = 0; k < dim; ++k)
        centre[k] = reduce(load(points.coordinate(k) + first)) / n_lanes;
      if (!near(centre))
        return false;
      table.degree = 0;
    }
    if (table.degree != 2 * m)
      tabulate_monomials<dim, 2 * m>(candidates, centre);
    return true;
  }

  /// The points of a pack one by one, where they are far from each other.
  void evaluate_points(const PointBatch<dim> &points, std::size_t first, const CandidateBatch<dim> &candidates,
                       const Wanted &wanted, Values &values, Workspace &workspace, Regularity &regularity) const {
    PointBatch<dim> single;
    for (std::size_t i = first; i < first + n_lanes; ++i) {
      const auto x = points.point(std::min(i, points.size() - 1));
      single.assign(std::span(&x, 1));
      const auto own = evaluate(single, candidates, wanted, workspace.one_point, workspace);
      if (i < points.size()) {
        regularity.n_indefinite += own.n_indefinite;
        note_regularity(own.smallest_pivot_ratio, i, regularity);
      }
      for (int quantity = 0; quantity < Values::n_quantities; ++quantity)
        if (values.has(quantity))
          for (std::size_t j = 0; j < candidates.size(); ++j)
            values.row(quantity, j)[i] = workspace.one_point.row(quantity, j)[0];
    }
  }

  void evaluate_pack(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, std::size_t first,
                     const Wanted &wanted, WeightDerivatives derivatives, Values &values, Workspace &workspace,
                     Regularity &regularity) const {
    const auto &table = candidates.monomials();
    const double inverse_scale = 1 / candidates.scale();
    Offset x;
    Offset offset;
    for (int k = 0; k < dim; ++k) {
      x[k] = load(points.coordinate(k) + first);
      offset[k] = (x[k] - table.centre[k]) * inverse_scale;
    }
    compute_weights<dim>(weighing_, x, candidates, derivatives, workspace);
    zero_rows(values, first, workspace.active);
    Place place{.sums = {workspace.active.data(), workspace.active.size(), table.rows.data()},
                .weights = workspace.weights.data(),
                .candidates = candidates,
                .x = x,
                .offset = offset,
                .values = values,
                .first = first,
                .scale = candidates.scale(),
                .inverse_scale = inverse_scale,
                .refine = false};
    Matrix matrix;
    const Pack ratios = factorise(matrix, place.moments(place.weights), first, points.size(), workspace, regularity);
    note_regularity(ratios, first, points.size(), regularity);
    place.refine = any_of(ratios < (wanted.hessian ? refined_for_second_derivatives : refined_pivot_ratio));

    if (wanted.value)
      write_direct(matrix, place, 0, 1, 0);
    if (kind_ == DerivativeKind::direct) {
      if (wanted.gradient)
        for (int k = 0; k < dim; ++k)
          write_direct(matrix, place, 1 + static_cast<std::size_t>(k), place.inverse_scale, 1 + k);
      if constexpr (m >= 2)
        if (wanted.hessian) {
          int kl = 0;
          for (int k = 0; k < dim; ++k)
            for (int l = k; l < dim; ++l, ++kl)
              write_direct(matrix, place, hessian_term(k, l),
                           (k == l ? 2 : 1) * place.inverse_scale * place.inverse_scale, first_hessian + kl);
        }
    }
    if (derivatives != WeightDerivatives::none)
      write_differentiated(matrix, place, wanted, derivatives == WeightDerivatives::second, workspace);
  }

  /// The moment matrix of a kernel with negative values need not be positive definite: where its pivots are
  /// negative or small it is factorised with complete pivoting.
  Pack factorise(Matrix &matrix, const Moments &moments, std::size_t first, std::size_t n_points, Workspace &workspace,
                 Regularity &regularity) const {
    Pack ratios = matrix.factorise(moments);
    if (!positive_ && any_of(ratios < refined_pivot_ratio)) {
      for (std::size_t lane = 0; lane < n_lanes && first + lane < n_points; ++lane)
        regularity.n_indefinite += ratios[lane] < -singular_pivot_ratio;
      workspace.factors.resize(n_lanes);
      ratios = matrix.factorise_pivoted(moments, workspace.factors);
    }
    return max(ratios, Pack(0));
  }

  /// Candidates that are no neighbours of any lane.
  static void zero_rows(Values &values, std::size_t first, const std::vector<cloud::Index> &active) {
    const Pack zero = 0;
    for (int quantity = 0; quantity < Values::n_quantities; ++quantity)
      if (values.has(quantity)) {
        std::size_t j = 0;
        for (const cloud::Index next : active) {
          for (; j < static_cast<std::size_t>(next); ++j)
            store(zero, values.row(quantity, j) + first);
          ++j;
        }
        for (; j < values.n_candidates(); ++j)
          store(zero, values.row(quantity, j) + first);
      }
  }

  static void note_regularity(const Pack &ratios, std::size_t first, std::size_t n_points, Regularity &regularity) {
    if (none_of(ratios < regularity.smallest_pivot_ratio))
      return;
    for (std::size_t lane = 0; lane < n_lanes && first + lane < n_points; ++lane)
      note_regularity(ratios[lane], first + lane, regularity);
  }
  /// Of singular points the first remains: which of them rounding makes the smallest says nothing.
  static void note_regularity(double ratio, std::size_t point, Regularity &regularity) {
    if (ratio < regularity.smallest_pivot_ratio && regularity.smallest_pivot_ratio > singular_pivot_ratio) {
      regularity.smallest_pivot_ratio = ratio;
      regularity.worst_point = point;
    }
  }

  /// Writes row `term` of K (2.11), times `scale`.
  static void write_direct(const Matrix &matrix, const Place &place, std::size_t term, double scale, int quantity) {
    place.sums.template write<1>({place.about_centre(matrix.unit_solution(term, scale))}, {place.weights},
                                 place.row(quantity), place.stride());
    if (place.refine)
      refine(matrix, place, term, scale, quantity);
  }

  /// One step of refinement: what the row lacks to reproduce the monomials, sum_J phi_J p_J = e_term
  /// scale, is measured on the shape functions themselves, whose rounding is that of the result, not
  /// that of the moment matrix; the correction is added to them for the same reason.
  static void refine(const Matrix &matrix, const Place &place, std::size_t term, double scale, int quantity) {
    Vector residual = place.sums.reproduced(place.candidates, place.x, place.row(quantity), place.stride());
    for (auto &entry : residual)
      entry = -entry;
    residual[term] += scale;
    matrix.solve(residual);
    place.sums.add(place.about_centre(residual), place.weights, place.row(quantity), place.stride());
  }

  /// Derivatives of the weights by the point, as the weights themselves: dim first ones, then the second ones.
  static void differentiate_weights(const Place &place, bool second, Workspace &workspace) {
    const auto &candidates = place.candidates;
    const std::size_t n_weights = place.sums.n_active * n_lanes;
    auto &derivatives = workspace.weight_derivatives;
    derivatives.resize((dim + (second ? Values::n_hessian : 0)) * n_weights);
    for (std::size_t a = 0; a < place.sums.n_active; ++a) {
      const auto j = static_cast<std::size_t>(place.sums.active[a]);
      const double to_h = candidates.inverse_h()[j] * candidates.inverse_h()[j];
      const Pack slope = load(&workspace.slopes[a * n_lanes]) * to_h;
      Offset d;
      for (int k = 0; k < dim; ++k) {
        d[k] = candidates.coordinate(k)[j] - place.x[k];
        // s^2 falls as x moves towards the particle
        store(-slope * d[k], &derivatives[static_cast<std::size_t>(k) * n_weights + a * n_lanes]);
      }
      if (!second)
        continue;
      const Pack curvature = load(&workspace.curvatures[a * n_lanes]) * (to_h * to_h);
      std::size_t kl = dim;
      for (int k = 0; k < dim; ++k)
        for (int l = k; l < dim; ++l, ++kl) {
          Pack value = curvature * d[k] * d[l];
          if (k == l)
            value += slope;
          store(value, &derivatives[kl * n_weights + a * n_lanes]);
        }
    }
  }

  /// Derivatives of the shape function itself; formulas above.
  void write_differentiated(const Matrix &matrix, const Place &place, const Wanted &wanted, bool second,
                            Workspace &workspace) const {
    differentiate_weights(place, second, workspace);
    const auto derivative = [&](std::size_t which) {
      return workspace.weight_derivatives.data() + which * place.sums.n_active * n_lanes;
    };
    const Vector g = matrix.unit_solution(0, 1);
    const Vector g_centre = place.about_centre(g);
    std::array<Moments, dim> moments; // of C_k
    std::array<Vector, dim> g_k;
    std::array<Vector, dim> g_k_centre;
    for (int k = 0; k < dim; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      moments[k] = place.moments(derivative(axis));
      g_k[k] = Vector{};
      g_k[k][1 + axis] = place.inverse_scale;
      Matrix::subtract_product(moments[k], g, g_k[k]);
      matrix.solve(g_k[k]);
      g_k_centre[k] = place.about_centre(g_k[k]);
      const auto write = [&](int quantity) {
        place.sums.template write<2>({g_k_centre[k], g_centre}, {place.weights, derivative(axis)}, place.row(quantity),
                                     place.stride());
        // Its monomials are reproduced as those of the direct derivative: sum_J phi_J,k p_J = e_k.
        if (place.refine)
          refine(matrix, place, 1 + axis, place.inverse_scale, quantity);
      };
      if (wanted.differentiated_gradient)
        write(first_differentiated + k);
      if (kind_ == DerivativeKind::differentiated && wanted.gradient)
        write(1 + k);
    }
    if (!second)
      return;
    std::size_t kl = 0;
    for (int k = 0; k < dim; ++k)
      for (int l = k; l < dim; ++l, ++kl) {
        // Order 1 has no such monomial: the second derivative of all its terms is zero.
        const std::size_t term = m >= 2 ? hessian_term(k, l) : 0;
        const double unit = m >= 2 ? (k == l ? 2 : 1) / (place.scale * place.scale) : 0;
        Vector g_kl{};
        g_kl[term] = unit;
        Matrix::subtract_product(moments[k], g_k[l], g_kl);
        Matrix::subtract_product(moments[l], g_k[k], g_kl);
        Matrix::subtract_product(place.moments(derivative(dim + kl)), g, g_kl);
        matrix.solve(g_kl);
        const int quantity = first_hessian + static_cast<int>(kl);
        place.sums.template write<4>({place.about_centre(g_kl), g_k_centre[k], g_k_centre[l], g_centre},
                                     {place.weights, derivative(static_cast<std::size_t>(l)),
                                      derivative(static_cast<std::size_t>(k)), derivative(dim + kl)},
                                     place.row(quantity), place.stride());
        if (place.refine)
          refine(matrix, place, term, unit, quantity);
      }
  }

  Weighing weighing_;
  DerivativeKind kind_;
  bool positive_;
};

} // namespace

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_weighted_basis(const char *name, int order, const Weighing &weighing,
                                                         DerivativeKind kind) {
  switch (order) {
  case 1:
    return std::make_unique<WeightedBasis<dim, 1>>(weighing, kind);
  case 2:
    return std::make_unique<WeightedBasis<dim, 2>>(weighing, kind);
  case 3:
    return std::make_unique<WeightedBasis<dim, 3>>(weighing, kind);
  case 4:
    return std::make_unique<WeightedBasis<dim, 4>>(weighing, kind);
  default:
    throw std::invalid_argument(fmt::format("{} of order {}; the orders are 1 to 4", name, order));
  }
}

#define INSTANTIATE(dim)                                                                                               \
  template std::unique_ptr<ShapeFunctions<dim>> make_weighted_basis<dim>(const char *, int, const Weighing &,          \
                                                                         DerivativeKind);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::basis
