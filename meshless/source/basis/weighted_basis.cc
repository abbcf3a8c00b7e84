#include "weighted_basis.h"

#include "weighted_rows.h"

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

/// Points that share candidates have their sums taken about one centre, where the monomials of a neighbour are numbers
/// in a table; moments are moved to the point and coefficients back from it (Translation). Points with neighbours of
/// their own have monomials about themselves.
template <int dim, int m>
class WeightedBasis final : public ShapeFunctions<dim> {
  using Matrix = MomentMatrix<dim, m>;
  using Moments = typename Matrix::Moments;
  using Values = ShapeFunctionValues<dim>;
  using typename ShapeFunctions<dim>::Workspace;

public:
  WeightedBasis(const Weighing &weighing, DerivativeKind kind)
      : weighing_(weighing), kind_(kind), positive_(kernels::describe(weighing.kernel).non_negative) {}

  double support() const override { return search_radius(kernels::support_of(weighing_.kernel), weighing_.edge); }
  int order() const override { return m; }
  std::size_t n_terms() const override { return Matrix::n; }

  Regularity evaluate(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, const Wanted &wanted,
                      Values &values, Workspace &workspace) const override {
    check_wanted(wanted);
    if (weighing_.volumes)
      require_volumes(candidates);
    values.resize(wanted, candidates.size(), points.stride());
    Regularity regularity;
    for (std::size_t first = 0; first < points.stride(); first += n_lanes) {
      if (!centre_table(points, first, candidates)) {
        evaluate_points(points, first, candidates, wanted, values, workspace, regularity);
        continue;
      }
      evaluate_pack(points, candidates, first, wanted, values, workspace, regularity);
    }
    if (regularity.smallest_pivot_ratio <= singular_pivot_ratio)
      regularity.n_neighbours = count_neighbours<dim>(weighing_, points.point(regularity.worst_point), candidates);
    return regularity;
  }

  Regularity evaluate_own(const NeighbourPack<dim> &pack, const Wanted &wanted, Values &values,
                          Workspace &workspace) const override {
    check_wanted(wanted);
    if (weighing_.volumes)
      require_volumes(pack);
    values.resize(wanted, pack.n_slots(), n_lanes);
    compute_weights<dim>(weighing_, pack, derivatives_for(wanted), workspace);
    OwnNeighbours<dim, m> neighbours{.n_slots = pack.n_slots(),
                                     .offsets = {},
                                     .inverse_lengths = pack.inverse_h(),
                                     .scale_lengths = pack.scale(),
                                     .inverse_scale_lengths = 1 / pack.scale()};
    for (int k = 0; k < dim; ++k)
      neighbours.offsets[k] = pack.offset(k);
    Regularity regularity;
    write_rows(neighbours, wanted, 0, pack.size(), values, workspace, regularity);
    if (regularity.smallest_pivot_ratio <= singular_pivot_ratio) {
      const std::size_t worst = regularity.worst_point;
      workspace.own_candidates.assign(pack.particles(), pack.list(worst), pack.point(worst));
      regularity.n_neighbours = count_neighbours<dim>(weighing_, pack.point(worst), workspace.own_candidates);
    }
    return regularity;
  }

private:
  void check_wanted(const Wanted &wanted) const {
    if (wanted.hessian && m < 2 && kind_ == DerivativeKind::direct)
      throw std::invalid_argument("second derivatives need a basis of order 2 at least");
  }

  bool differentiates(bool wanted) const { return wanted && kind_ == DerivativeKind::differentiated; }
  WeightDerivatives derivatives_for(const Wanted &wanted) const {
    return differentiates(wanted.hessian)                                      ? WeightDerivatives::second
           : wanted.differentiated_gradient || differentiates(wanted.gradient) ? WeightDerivatives::first
                                                                               : WeightDerivatives::none;
  }

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
                     const Wanted &wanted, Values &values, Workspace &workspace, Regularity &regularity) const {
    const auto &table = candidates.monomials();
    SharedNeighbours<dim, m> neighbours{.active = nullptr,
                                        .n_active = 0,
                                        .table = table.rows.data(),
                                        .coordinates = {},
                                        .inverse_lengths = candidates.inverse_h(),
                                        .x = {},
                                        .offset_from_centre = {},
                                        .scale_length = candidates.scale(),
                                        .inverse_scale_length = 1 / candidates.scale()};
    for (int k = 0; k < dim; ++k) {
      neighbours.coordinates[k] = candidates.coordinate(k);
      neighbours.x[k] = load(points.coordinate(k) + first);
      neighbours.offset_from_centre[k] = (neighbours.x[k] - table.centre[k]) * neighbours.inverse_scale_length;
    }
    compute_weights<dim>(weighing_, neighbours.x, candidates, derivatives_for(wanted), workspace);
    neighbours.active = workspace.active.data();
    neighbours.n_active = workspace.active.size();
    zero_rows(values, first, workspace.active);
    write_rows(neighbours, wanted, first, points.size(), values, workspace, regularity);
  }

  /// From weights in the workspace to the rows of `first` and the following lanes.
  /// @param n_points of the batch
  template <typename Neighbours>
  void write_rows(const Neighbours &neighbours, const Wanted &wanted, std::size_t first, std::size_t n_points,
                  Values &values, Workspace &workspace, Regularity &regularity) const {
    const NeighbourSums<dim, m, Neighbours> sums{neighbours};
    Matrix matrix;
    const Pack ratios =
        factorise(matrix, sums.moments(workspace.weights.data()), first, n_points, workspace, regularity);
    note_regularity(ratios, first, n_points, regularity);
    const bool refined = any_of(ratios < (wanted.hessian ? refined_for_second_derivatives : refined_pivot_ratio));
    const WeightedRows<dim, m, Neighbours> rows(sums, matrix, refined, wanted, first, values, workspace);
    const bool direct = kind_ == DerivativeKind::direct;
    rows.write_direct(direct && wanted.gradient, direct && wanted.hessian);
    if (derivatives_for(wanted) != WeightDerivatives::none)
      rows.write_differentiated(!direct && wanted.gradient, !direct && wanted.hessian);
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
