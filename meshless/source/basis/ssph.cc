#include "meshless/basis/ssph.h"

#include "meshless/basis/monomials.h"
#include "meshless/linear_algebra/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

// g++ 12 sees an index one past the end in the unrolled loops, which they never reach.
#pragma GCC diagnostic ignored "-Warray-bounds"

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

template <int dim, int m>
class Ssph final : public ShapeFunctions<dim> {
  using Terms = Monomials<dim, m>;
  /// The distinct entries of the moment matrix are the monomials of twice the degree.
  using MomentTerms = Monomials<dim, 2 * m>;
  static constexpr std::size_t n = Terms::size;
  static constexpr std::size_t n_moments = MomentTerms::size;
  using Offset = std::array<Pack, dim>;
  using Moments = std::array<Pack, n_moments>;
  using Vector = std::array<Pack, n>;
  using typename ShapeFunctions<dim>::Workspace;

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

  /// Term of the second derivative (k, l).
  static constexpr std::size_t hessian_term(int k, int l)
  {
    typename Terms::Exponents exponents{};
    ++exponents[k];
    ++exponents[l];
    return Terms::index_of(exponents);
  }

public:
  explicit Ssph(const kernels::Kernel &kernel) : kernel_(kernel) {}

  double support() const override { return kernels::support_of(kernel_); }
  int order() const override { return m; }
  std::size_t n_terms() const override { return n; }

  Regularity evaluate(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, const Wanted &wanted,
                      ShapeFunctionValues<dim> &values, Workspace &workspace) const override
  {
    if (wanted.hessian && m < 2)
      throw std::invalid_argument("second derivatives need a basis of order 2 at least");
    values.resize(wanted, candidates.size(), points.stride());
    workspace.weights.resize(candidates.size() * n_lanes);
    workspace.slopes.resize(wanted.differentiated_gradient ? candidates.size() * n_lanes : 0);
    Regularity regularity;
    for (std::size_t first = 0; first < points.stride(); first += n_lanes)
      evaluate_pack(points, candidates, first, wanted, values, workspace, regularity);
    if (regularity.smallest_pivot_ratio <= singular_pivot_ratio)
      regularity.n_neighbours = count_neighbours(points.point(regularity.worst_point), candidates);
    return regularity;
  }

private:
  /// Offsets xi_J - x in units of the scale of the monomials.
  static Offset offset(const Offset &x, const CandidateBatch<dim> &candidates, std::size_t j, double inverse_scale)
  {
    Offset d;
    for (int k = 0; k < dim; ++k)
      d[k] = (candidates.coordinate(k)[j] - x[k]) * inverse_scale;
    return d;
  }

  void evaluate_pack(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, std::size_t first,
                     const Wanted &wanted, ShapeFunctionValues<dim> &values, Workspace &workspace,
                     Regularity &regularity) const
  {
    Offset x;
    for (int k = 0; k < dim; ++k)
      x[k] = load(points.coordinate(k) + first);
    std::visit(
        [&](const auto &kernel) {
          compute_weights(kernel, x, candidates, wanted.differentiated_gradient, workspace);
        },
        kernel_);
    zero_rows(values, first, candidates.size());

    const double scale = candidates.scale();
    const double inverse_scale = 1 / scale;
    Moments moments{};
    for (std::size_t a = 0; a < workspace.active.size(); ++a) {
      const auto d = offset(x, candidates, static_cast<std::size_t>(workspace.active[a]), inverse_scale);
      add_moments(load(&workspace.weights[a * n_lanes]), d, moments);
    }
    std::array<Vector, n> factor; // row i: L_i0 ... L_i,i-1 and 1 / D_i on the diagonal
    const Pack ratios = factorise(moments, factor);
    note_regularity(ratios, first, points.size(), regularity);
    const bool refine = wanted.hessian || any_of(ratios < refined_pivot_ratio);

    if (wanted.value)
      add_row(factor, 0, 1, 0, refine, x, candidates, first, values, workspace);
    if (wanted.gradient)
      for (int k = 0; k < dim; ++k)
        add_row(factor, 1 + static_cast<std::size_t>(k), inverse_scale, 1 + k, refine, x, candidates, first, values,
                workspace);
    if constexpr (m >= 2)
      if (wanted.hessian) {
        int kl = 0;
        for (int k = 0; k < dim; ++k)
          for (int l = k; l < dim; ++l, ++kl)
            add_row(factor, hessian_term(k, l), (k == l ? 2 : 1) * inverse_scale * inverse_scale, 1 + dim + kl,
                    refine, x, candidates, first, values, workspace);
      }
    if (wanted.differentiated_gradient)
      add_differentiated(factor, refine, x, candidates, first, values, workspace);
  }

  /// W_J (and W'/s) of the candidates inside the support of any lane; `active` lists them.
  template <typename Kernel>
  static void compute_weights(const Kernel &kernel, const Offset &x, const CandidateBatch<dim> &candidates,
                              bool with_slopes, Workspace &workspace)
  {
    // A particle on the edge to rounding is outside: W is zero there, its slope is not.
    const double edge = kernel.support() * kernel.support() * (1 - 1e-12);
    workspace.active.clear();
    for (std::size_t j = 0; j < candidates.size(); ++j) {
      Pack s_squared = 0;
      for (int k = 0; k < dim; ++k) {
        const Pack s = (candidates.coordinate(k)[j] - x[k]) * candidates.inverse_h()[j];
        s_squared += s * s;
      }
      const auto inside = s_squared < edge;
      if (none_of(inside))
        continue;
      s_squared = min(s_squared, Pack(edge));
      const std::size_t a = workspace.active.size() * n_lanes;
      workspace.active.push_back(static_cast<cloud::Index>(j));
      Pack weight = kernel.value(s_squared);
      where(!inside, weight) = 0;
      store(weight, &workspace.weights[a]);
      if (with_slopes) {
        Pack slope = kernel.slope(s_squared);
        where(!inside, slope) = 0;
        store(slope, &workspace.slopes[a]);
      }
    }
  }

  static void zero_rows(ShapeFunctionValues<dim> &values, std::size_t first, std::size_t n_candidates)
  {
    const Pack zero = 0;
    for (int quantity = 0; quantity < ShapeFunctionValues<dim>::n_quantities; ++quantity)
      if (values.has(quantity))
        for (std::size_t j = 0; j < n_candidates; ++j)
          store(zero, values.row(quantity, j) + first);
  }

  static void add_moments(const Pack &weight, const Offset &d, Moments &moments)
  {
    Moments terms;
    terms[0] = weight;
    moments[0] += weight;
#pragma GCC unroll 28
    for (std::size_t t = 1; t < n_moments; ++t) {
      terms[t] = terms[MomentTerms::table.parent[t]] * d[MomentTerms::table.axis[t]];
      moments[t] += terms[t];
    }
  }

  /// L D L^T of the moment matrix; returns the smallest pivot ratio of every lane.
  static Pack factorise(const Moments &moments, std::array<Vector, n> &factor)
  {
    Pack smallest = 1;
    Vector pivots;
#pragma GCC unroll 10
    for (std::size_t i = 0; i < n; ++i) {
#pragma GCC unroll 10
      for (std::size_t j = 0; j < i; ++j) {
        Pack sum = moments[moment_of[i][j]];
#pragma GCC unroll 10
        for (std::size_t k = 0; k < j; ++k)
          sum -= factor[i][k] * factor[j][k] * pivots[k];
        factor[i][j] = sum * factor[j][j];
      }
      const Pack diagonal = moments[moment_of[i][i]];
      Pack pivot = diagonal;
#pragma GCC unroll 10
      for (std::size_t k = 0; k < i; ++k)
        pivot -= factor[i][k] * factor[i][k] * pivots[k];
      Pack ratio = pivot / diagonal;
      // Not a number (no neighbour at all) counts as zero.
      where(!(ratio > 0), ratio) = 0;
      smallest = min(smallest, ratio);
      pivots[i] = pivot;
      factor[i][i] = 1 / pivot;
    }
    return smallest;
  }

  static void note_regularity(const Pack &ratios, std::size_t first, std::size_t n_points, Regularity &regularity)
  {
    if (none_of(ratios < regularity.smallest_pivot_ratio))
      return;
    for (std::size_t lane = 0; lane < n_lanes && first + lane < n_points; ++lane)
      if (ratios[lane] < regularity.smallest_pivot_ratio) {
        regularity.smallest_pivot_ratio = ratios[lane];
        regularity.worst_point = first + lane;
      }
  }

  /// Solves C x = b in place.
  static void solve(const std::array<Vector, n> &factor, Vector &b)
  {
#pragma GCC unroll 10
    for (std::size_t i = 1; i < n; ++i)
#pragma GCC unroll 10
      for (std::size_t j = 0; j < i; ++j)
        b[i] -= factor[i][j] * b[j];
#pragma GCC unroll 10
    for (std::size_t i = 0; i < n; ++i)
      b[i] *= factor[i][i];
    for (std::size_t i = n - 1; i > 0; --i)
      for (std::size_t j = 0; j < i; ++j)
        b[j] -= factor[i][j] * b[i];
  }

  static Vector unit_solution(const std::array<Vector, n> &factor, std::size_t term, double scale)
  {
    Vector b{};
    b[term] = scale;
    solve(factor, b);
    return b;
  }

  static Pack dot(const Vector &a, const Vector &b)
  {
    Pack sum = a[0] * b[0];
#pragma GCC unroll 10
    for (std::size_t t = 1; t < n; ++t)
      sum += a[t] * b[t];
    return sum;
  }

  /// Writes row `term` of K (2.11), times `scale`.
  static void add_row(const std::array<Vector, n> &factor, std::size_t term, double scale, int quantity,
                      bool refine, const Offset &x, const CandidateBatch<dim> &candidates, std::size_t first,
                      ShapeFunctionValues<dim> &values, const Workspace &workspace)
  {
    const Vector coefficients = unit_solution(factor, term, scale);
    const double inverse_scale = 1 / candidates.scale();
    for (std::size_t a = 0; a < workspace.active.size(); ++a) {
      const auto j = static_cast<std::size_t>(workspace.active[a]);
      Vector terms;
      Terms::evaluate(offset(x, candidates, j, inverse_scale), terms);
      store(dot(coefficients, terms) * load(&workspace.weights[a * n_lanes]), values.row(quantity, j) + first);
    }
    if (refine)
      refine_row(factor, term, scale, quantity, x, candidates, first, values, workspace);
  }

  /// One step of refinement: what the row lacks to reproduce the monomials, sum_J phi_J p_J = e_term
  /// scale, is measured on the shape functions themselves, whose rounding is that of the result, not
  /// that of the moment matrix; the correction is added to them for the same reason.
  static void refine_row(const std::array<Vector, n> &factor, std::size_t term, double scale, int quantity,
                         const Offset &x, const CandidateBatch<dim> &candidates, std::size_t first,
                         ShapeFunctionValues<dim> &values, const Workspace &workspace)
  {
    const double inverse_scale = 1 / candidates.scale();
    Vector residual{};
    residual[term] = scale;
    Vector terms;
    for (std::size_t a = 0; a < workspace.active.size(); ++a) {
      const auto j = static_cast<std::size_t>(workspace.active[a]);
      Terms::evaluate(offset(x, candidates, j, inverse_scale), terms);
      const Pack shape = load(values.row(quantity, j) + first);
      for (std::size_t t = 0; t < n; ++t)
        residual[t] -= shape * terms[t];
    }
    solve(factor, residual);
    for (std::size_t a = 0; a < workspace.active.size(); ++a) {
      const auto j = static_cast<std::size_t>(workspace.active[a]);
      Terms::evaluate(offset(x, candidates, j, inverse_scale), terms);
      double *row = values.row(quantity, j) + first;
      store(load(row) + dot(residual, terms) * load(&workspace.weights[a * n_lanes]), row);
    }
  }

  /// The derivative of the shape function itself; formula in basis/ssph.h.
  static void add_differentiated(const std::array<Vector, n> &factor, bool refine, const Offset &x,
                                 const CandidateBatch<dim> &candidates, std::size_t first,
                                 ShapeFunctionValues<dim> &values, const Workspace &workspace)
  {
    const double scale = candidates.scale();
    const Vector g = unit_solution(factor, 0, 1);
    for (int k = 0; k < dim; ++k) {
      Moments moments{}; // of C_k
      for (std::size_t a = 0; a < workspace.active.size(); ++a) {
        const auto j = static_cast<std::size_t>(workspace.active[a]);
        const auto d = offset(x, candidates, j, 1 / scale);
        add_moments(weight_derivative(candidates, workspace, a, d[k] * scale), d, moments);
      }
      Vector right{};
#pragma GCC unroll 10
      for (std::size_t i = 0; i < n; ++i)
#pragma GCC unroll 10
        for (std::size_t j = 0; j < n; ++j)
          right[i] -= moments[moment_of[i][j]] * g[j];
      right[1 + static_cast<std::size_t>(k)] += 1 / scale; // K_(k): the direct first derivative
      solve(factor, right);
      for (std::size_t a = 0; a < workspace.active.size(); ++a) {
        const auto j = static_cast<std::size_t>(workspace.active[a]);
        const auto d = offset(x, candidates, j, 1 / scale);
        Vector terms;
        Terms::evaluate(d, terms);
        const Pack derivative = weight_derivative(candidates, workspace, a, d[k] * scale);
        store(dot(right, terms) * load(&workspace.weights[a * n_lanes]) + dot(g, terms) * derivative,
              values.row(1 + dim + ShapeFunctionValues<dim>::n_hessian + k, j) + first);
      }
      // Its monomials are reproduced as those of the direct derivative: sum_J phi_J,k p_J = e_k.
      if (refine)
        refine_row(factor, 1 + static_cast<std::size_t>(k), 1 / scale,
                   1 + dim + ShapeFunctionValues<dim>::n_hessian + k, x, candidates, first, values, workspace);
    }
  }

  /// dW_J / dx_k at the evaluation point: s^2 falls as x moves towards the particle.
  static Pack weight_derivative(const CandidateBatch<dim> &candidates, const Workspace &workspace, std::size_t a,
                                const Pack &distance_k)
  {
    const double inverse_h = candidates.inverse_h()[static_cast<std::size_t>(workspace.active[a])];
    return -load(&workspace.slopes[a * n_lanes]) * distance_k * (inverse_h * inverse_h);
  }

  std::size_t count_neighbours(const cloud::Point<dim> &x, const CandidateBatch<dim> &candidates) const
  {
    const double edge = support() * support() * (1 - 1e-12);
    std::size_t count = 0;
    for (std::size_t j = 0; j < candidates.size(); ++j) {
      double s_squared = 0;
      for (int k = 0; k < dim; ++k) {
        const double s = (candidates.coordinate(k)[j] - x[k]) * candidates.inverse_h()[j];
        s_squared += s * s;
      }
      count += s_squared < edge;
    }
    return count;
  }

  kernels::Kernel kernel_;
};

} // namespace

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_ssph(int order, const kernels::Kernel &kernel)
{
  switch (order) {
  case 1:
    return std::make_unique<Ssph<dim, 1>>(kernel);
  case 2:
    return std::make_unique<Ssph<dim, 2>>(kernel);
  case 3:
    return std::make_unique<Ssph<dim, 3>>(kernel);
  case 4:
    return std::make_unique<Ssph<dim, 4>>(kernel);
  default:
    throw std::invalid_argument(fmt::format("SSPH of order {}; the orders are 1 to 4", order));
  }
}

template std::unique_ptr<ShapeFunctions<1>> make_ssph<1>(int, const kernels::Kernel &);
template std::unique_ptr<ShapeFunctions<2>> make_ssph<2>(int, const kernels::Kernel &);
template std::unique_ptr<ShapeFunctions<3>> make_ssph<3>(int, const kernels::Kernel &);

} // namespace meshless::basis
