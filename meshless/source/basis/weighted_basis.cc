#include "weighted_basis.h"

#include "moment_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace meshless::basis {

namespace {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

/// Moment matrices with a smaller pivot ratio have their shape functions refined once: the monomials
/// are then reproduced to rounding all the same. Second derivatives always have: collocation
/// amplifies their rounding by h^-2 (a cubic on 16 x 4 particles, m = 3: relative error 3e-10
/// without, 1e-12 with it).
constexpr double refined_pivot_ratio = 1e-2;

/// Shape functions phi_J = a . p_J W_J with C a = q, from the moments of all neighbours.
///
/// The monomials p_J = p(xi_J - x_0) are taken about a fixed place x_0; phi_J(x) = p(x - x_0)^T C^-1(x) p_J W_J(x)
/// is then differentiated at x = x_0, where q = p(x - x_0) and its derivatives are multiples of unit
/// vectors: with C_k = sum p p^T W,k and C_kl = sum p p^T W,kl
///   C a_k  = q,k  - C_k a                        phi_J,k  = a_k . p_J W_J + a . p_J W_J,k
///   C a_kl = q,kl - C_k a_l - C_l a_k - C_kl a   phi_J,kl = a_kl . p_J W_J + a_k . p_J W_J,l + a_l . p_J W_J,k
///                                                           + a . p_J W_J,kl,
/// which is Zhang & Batra 2008, (4.12) and (4.13), without derivatives of the monomials. The direct
/// derivatives are C a = q,k and C a = q,kl alone.
template <int dim, int m>
class WeightedBasis final : public ShapeFunctions<dim> {
  using Matrix = MomentMatrix<dim, m>;
  using Terms = typename Matrix::Terms;
  using Offset = typename Matrix::Offset;
  using Moments = typename Matrix::Moments;
  using Vector = typename Matrix::Vector;
  using Values = ShapeFunctionValues<dim>;
  using typename ShapeFunctions<dim>::Workspace;
  static constexpr std::size_t n = Matrix::n;
  static constexpr int first_hessian = 1 + dim;
  static constexpr int first_differentiated = 1 + dim + Values::n_hessian;

  /// Term of the second derivative (k, l).
  static constexpr std::size_t hessian_term(int k, int l) {
    typename Terms::Exponents exponents{};
    ++exponents[k];
    ++exponents[l];
    return Terms::index_of(exponents);
  }

  /// What all steps at one pack of points share. Plain pointers, and handed on by value: behind a reference
  /// every store of a pack would make the compiler read all of it again.
  struct Place {
    const cloud::Index *active;
    std::size_t n_active;
    const double *weights;
    const double *slopes;
    const double *curvatures;
    std::array<const double *, dim> coordinates;
    const double *inverse_h;
    Offset x;
    Values &values;
    std::size_t first;
    double scale;
    double inverse_scale;
    bool refine;

    Pack weight(std::size_t a) const { return load(weights + a * n_lanes); }
    double *row(int quantity, std::size_t a) const {
      return values.row(quantity, static_cast<std::size_t>(active[a])) + first;
    }

    /// xi_J - x in units of the scale of the monomials.
    Offset offset(std::size_t a) const {
      const cloud::Index j = active[a];
      Offset d;
      for (int k = 0; k < dim; ++k)
        d[k] = (coordinates[k][j] - x[k]) * inverse_scale;
      return d;
    }
    Vector terms(std::size_t a) const {
      Vector result;
      Terms::evaluate(offset(a), result);
      return result;
    }

    /// dW_J / dx_k: s^2 falls as x moves towards the particle.
    Pack weight_gradient(std::size_t a, const Offset &d, int k) const {
      const double to_h = inverse_h[active[a]];
      return -load(slopes + a * n_lanes) * (d[k] * scale) * (to_h * to_h);
    }
    /// d^2 W_J / dx_k dx_l
    Pack weight_hessian(std::size_t a, const Offset &d, int k, int l) const {
      const double per_h = inverse_h[active[a]];
      const double to_h = scale * per_h;
      Pack result = load(curvatures + a * n_lanes) * (d[k] * to_h) * (d[l] * to_h);
      if (k == l)
        result += load(slopes + a * n_lanes);
      return result * (per_h * per_h);
    }
  };

public:
  WeightedBasis(const Weighing &weighing, DerivativeKind kind)
      : weighing_(weighing), kind_(kind), positive_(kernels::describe(weighing.kernel).non_negative) {}

  double support() const override { return search_radius(kernels::support_of(weighing_.kernel), weighing_.edge); }
  int order() const override { return m; }
  std::size_t n_terms() const override { return n; }

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
    for (std::size_t first = 0; first < points.stride(); first += n_lanes)
      evaluate_pack(points, candidates, first, wanted, derivatives, values, workspace, regularity);
    if (regularity.smallest_pivot_ratio <= singular_pivot_ratio)
      regularity.n_neighbours = count_neighbours<dim>(weighing_, points.point(regularity.worst_point), candidates);
    return regularity;
  }

private:
  void evaluate_pack(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, std::size_t first,
                     const Wanted &wanted, WeightDerivatives derivatives, Values &values, Workspace &workspace,
                     Regularity &regularity) const {
    Offset x;
    for (int k = 0; k < dim; ++k)
      x[k] = load(points.coordinate(k) + first);
    compute_weights<dim>(weighing_, x, candidates, derivatives, workspace);
    zero_rows(values, first, candidates.size());
    Place place{.active = workspace.active.data(),
                .n_active = workspace.active.size(),
                .weights = workspace.weights.data(),
                .slopes = workspace.slopes.data(),
                .curvatures = workspace.curvatures.data(),
                .coordinates = {},
                .inverse_h = candidates.inverse_h(),
                .x = x,
                .values = values,
                .first = first,
                .scale = candidates.scale(),
                .inverse_scale = 1 / candidates.scale(),
                .refine = false};
    for (int k = 0; k < dim; ++k)
      place.coordinates[k] = candidates.coordinate(k);

    Moments moments{};
    for (std::size_t a = 0; a < place.n_active; ++a)
      Matrix::add_moments(place.weight(a), place.offset(a), moments);
    Matrix matrix;
    const Pack ratios = factorise(matrix, moments, first, points.size(), workspace, regularity);
    note_regularity(ratios, first, points.size(), regularity);
    place.refine = wanted.hessian || any_of(ratios < refined_pivot_ratio);

    if (wanted.value)
      add_row(matrix, place, 0, 1, 0);
    if (kind_ == DerivativeKind::direct) {
      if (wanted.gradient)
        for (int k = 0; k < dim; ++k)
          add_row(matrix, place, 1 + static_cast<std::size_t>(k), place.inverse_scale, 1 + k);
      if constexpr (m >= 2)
        if (wanted.hessian) {
          int kl = 0;
          for (int k = 0; k < dim; ++k)
            for (int l = k; l < dim; ++l, ++kl)
              add_row(matrix, place, hessian_term(k, l), (k == l ? 2 : 1) * place.inverse_scale * place.inverse_scale,
                      first_hessian + kl);
        }
    }
    if (derivatives != WeightDerivatives::none)
      add_differentiated(matrix, place, wanted, derivatives == WeightDerivatives::second);
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

  static void zero_rows(Values &values, std::size_t first, std::size_t n_candidates) {
    const Pack zero = 0;
    for (int quantity = 0; quantity < Values::n_quantities; ++quantity)
      if (values.has(quantity))
        for (std::size_t j = 0; j < n_candidates; ++j)
          store(zero, values.row(quantity, j) + first);
  }

  static void note_regularity(const Pack &ratios, std::size_t first, std::size_t n_points, Regularity &regularity) {
    if (none_of(ratios < regularity.smallest_pivot_ratio))
      return;
    for (std::size_t lane = 0; lane < n_lanes && first + lane < n_points; ++lane)
      if (ratios[lane] < regularity.smallest_pivot_ratio) {
        regularity.smallest_pivot_ratio = ratios[lane];
        regularity.worst_point = first + lane;
      }
  }

  /// Writes row `term` of K (2.11), times `scale`.
  [[gnu::noinline]] static void add_row(const Matrix &matrix, const Place place, std::size_t term, double scale,
                                        int quantity) {
    const Vector coefficients = matrix.unit_solution(term, scale);
    for (std::size_t a = 0; a < place.n_active; ++a)
      store(Matrix::dot(coefficients, place.terms(a)) * place.weight(a), place.row(quantity, a));
    if (place.refine)
      refine_row(matrix, place, term, scale, quantity);
  }

  /// One step of refinement: what the row lacks to reproduce the monomials, sum_J phi_J p_J = e_term
  /// scale, is measured on the shape functions themselves, whose rounding is that of the result, not
  /// that of the moment matrix; the correction is added to them for the same reason.
  static void refine_row(const Matrix &matrix, const Place place, std::size_t term, double scale, int quantity) {
    Vector residual{};
    residual[term] = scale;
    for (std::size_t a = 0; a < place.n_active; ++a) {
      const Vector terms = place.terms(a);
      const Pack shape = load(place.row(quantity, a));
      for (std::size_t t = 0; t < n; ++t)
        residual[t] -= shape * terms[t];
    }
    matrix.solve(residual);
    for (std::size_t a = 0; a < place.n_active; ++a) {
      double *row = place.row(quantity, a);
      store(load(row) + Matrix::dot(residual, place.terms(a)) * place.weight(a), row);
    }
  }

  /// Derivatives of the shape function itself; formulas above.
  [[gnu::noinline]] void add_differentiated(const Matrix &matrix, const Place place, const Wanted &wanted,
                                            bool second) const {
    const Vector g = matrix.unit_solution(0, 1);
    const bool as_gradient = kind_ == DerivativeKind::differentiated && wanted.gradient;
    std::array<Moments, dim> all_moments; // of C_k, kept for the second derivatives
    std::array<Vector, dim> g_k;
    for (int k = 0; k < dim; ++k) {
      Moments moments{};
      for (std::size_t a = 0; a < place.n_active; ++a) {
        const Offset d = place.offset(a);
        Matrix::add_moments(place.weight_gradient(a, d, k), d, moments);
      }
      Vector right{};
      right[1 + static_cast<std::size_t>(k)] = place.inverse_scale;
      Matrix::subtract_product(moments, g, right);
      matrix.solve(right);
      if (wanted.differentiated_gradient)
        add_first(matrix, place, k, g, right, first_differentiated + k);
      if (as_gradient)
        add_first(matrix, place, k, g, right, 1 + k);
      if (second) {
        all_moments[k] = moments;
        g_k[k] = right;
      }
    }
    if (second) {
      int kl = 0;
      for (int k = 0; k < dim; ++k)
        for (int l = k; l < dim; ++l, ++kl)
          add_second(matrix, place, k, l, g, g_k, all_moments, first_hessian + kl);
    }
  }

  static void add_first(const Matrix &matrix, const Place place, int k, const Vector g, const Vector g_k,
                        int quantity) {
    for (std::size_t a = 0; a < place.n_active; ++a) {
      const Offset d = place.offset(a);
      Vector terms;
      Terms::evaluate(d, terms);
      store(Matrix::dot(g_k, terms) * place.weight(a) + Matrix::dot(g, terms) * place.weight_gradient(a, d, k),
            place.row(quantity, a));
    }
    // Its monomials are reproduced as those of the direct derivative: sum_J phi_J,k p_J = e_k.
    if (place.refine)
      refine_row(matrix, place, 1 + static_cast<std::size_t>(k), place.inverse_scale, quantity);
  }

  [[gnu::noinline]] static void add_second(const Matrix &matrix, const Place place, int k, int l, const Vector &g,
                                           const std::array<Vector, dim> &g_k, const std::array<Moments, dim> &moments,
                                           int quantity) {
    Moments second{}; // of C_kl
    for (std::size_t a = 0; a < place.n_active; ++a) {
      const Offset d = place.offset(a);
      Matrix::add_moments(place.weight_hessian(a, d, k, l), d, second);
    }
    // Order 1 has no such monomial: the second derivative of all its terms is zero.
    const std::size_t term = m >= 2 ? hessian_term(k, l) : 0;
    const double unit = m >= 2 ? (k == l ? 2 : 1) / (place.scale * place.scale) : 0;
    Vector g_kl{};
    g_kl[term] = unit;
    Matrix::subtract_product(moments[k], g_k[l], g_kl);
    Matrix::subtract_product(moments[l], g_k[k], g_kl);
    Matrix::subtract_product(second, g, g_kl);
    matrix.solve(g_kl);
    for (std::size_t a = 0; a < place.n_active; ++a) {
      const Offset d = place.offset(a);
      Vector terms;
      Terms::evaluate(d, terms);
      store(Matrix::dot(g_kl, terms) * place.weight(a) + Matrix::dot(g_k[k], terms) * place.weight_gradient(a, d, l) +
                Matrix::dot(g_k[l], terms) * place.weight_gradient(a, d, k) +
                Matrix::dot(g, terms) * place.weight_hessian(a, d, k, l),
            place.row(quantity, a));
    }
    if (place.refine)
      refine_row(matrix, place, term, unit, quantity);
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
