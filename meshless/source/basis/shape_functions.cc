#include "meshless/basis/shape_functions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meshless::basis {

namespace {

/// An odd number of packs, each a line of the cache: the same pack of points of all candidates then lies in different
/// sets of the cache, not in a few that overflow.
std::size_t spread_over_cache(std::size_t stride) {
  const std::size_t n_packs = stride / linear_algebra::n_lanes;
  return n_packs == 0 ? 0 : (n_packs | 1) * linear_algebra::n_lanes;
}

} // namespace

template <int dim>
void PointBatch<dim>::assign(std::span<const cloud::Point<dim>> points) {
  size_ = points.size();
  stride_ = linear_algebra::padded(size_);
  for (int k = 0; k < dim; ++k) {
    coordinates_[k].resize(stride_);
    for (std::size_t i = 0; i < stride_; ++i)
      coordinates_[k][i] = points[std::min(i, size_ - 1)][k];
  }
}

template <int dim>
void PointBatch<dim>::assign(const std::array<std::span<const double>, dim> &coordinates) {
  size_ = coordinates[0].size();
  stride_ = linear_algebra::padded(size_);
  for (int k = 0; k < dim; ++k) {
    coordinates_[k].assign(coordinates[k].begin(), coordinates[k].end());
    coordinates_[k].resize(stride_, size_ == 0 ? 0.0 : coordinates[k].back());
  }
}

template <int dim>
cloud::Point<dim> PointBatch<dim>::point(std::size_t i) const {
  cloud::Point<dim> result;
  for (int k = 0; k < dim; ++k)
    result[k] = coordinates_[k][i];
  return result;
}

template <int dim>
void CandidateBatch<dim>::assign(const cloud::Particles<dim> &particles, std::span<const cloud::Index> candidates,
                                 const cloud::Point<dim> &about) {
  monomials_.degree = 0;
  monomials_.centre = about;
  const std::size_t n = candidates.size();
  inverse_h_.resize(n);
  volumes_.resize(particles.has_volumes() ? n : 0);
  for (int k = 0; k < dim; ++k) {
    coordinates_[k].resize(n);
    flattenings_[k].resize(particles.has_flattenings() ? n : 0);
  }
  double sum = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const auto particle = static_cast<std::size_t>(candidates[j]);
    for (int k = 0; k < dim; ++k)
      coordinates_[k][j] = particles.position(particle)[k];
    const double h = particles.smoothing_length(particle);
    inverse_h_[j] = 1 / h;
    if (particles.has_volumes())
      volumes_[j] = particles.volumes()[particle];
    if (particles.has_flattenings())
      for (int k = 0; k < dim; ++k)
        flattenings_[k][j] = particles.flattenings()[particle][k];
    sum += h;
  }
  scale_ = n == 0 ? 1 : sum / static_cast<double>(n);
}

template <int dim>
void ShapeFunctionValues<dim>::resize(const Wanted &wanted, std::size_t n_candidates, std::size_t stride) {
  n_candidates_ = n_candidates;
  stride_ = spread_over_cache(stride);
  std::size_t n_slots = 0;
  const auto assign = [&](int first, int count, bool on) {
    for (int i = 0; i < count; ++i)
      slot_[first + i] = on ? n_slots++ : absent;
  };
  assign(0, 1, wanted.value);
  assign(1, dim, wanted.gradient);
  assign(1 + dim, n_hessian, wanted.hessian);
  assign(1 + dim + n_hessian, dim, wanted.differentiated_gradient);
  data_.resize(n_slots * n_candidates * stride_);
}

template <int dim>
Regularity ShapeFunctions<dim>::evaluate_own(const NeighbourPack<dim> &pack, const Wanted &wanted,
                                             ShapeFunctionValues<dim> &values, Workspace &workspace) const {
  values.resize(wanted, pack.n_slots(), linear_algebra::n_lanes);
  Regularity regularity;
  auto &single = workspace.one_point;
  for (std::size_t i = 0; i < pack.size(); ++i) {
    workspace.own_point.assign(std::span(&pack.point(i), 1));
    workspace.own_candidates.assign(pack.particles(), pack.list(i), pack.point(i));
    const auto own = evaluate(workspace.own_point, workspace.own_candidates, wanted, single, workspace);
    regularity.n_indefinite += own.n_indefinite;
    if (own.smallest_pivot_ratio < regularity.smallest_pivot_ratio) {
      regularity.smallest_pivot_ratio = own.smallest_pivot_ratio;
      regularity.n_neighbours = own.n_neighbours;
      regularity.worst_point = i;
    }
    for (int quantity = 0; quantity < ShapeFunctionValues<dim>::n_quantities; ++quantity)
      if (values.has(quantity))
        for (std::size_t a = 0; a < pack.n_slots(); ++a)
          values.row(quantity, a)[i] = a < pack.list(i).size() ? single.row(quantity, a)[0] : 0;
  }
  return regularity;
}

namespace {

template <int dim>
[[noreturn]] void throw_singular(const Regularity &regularity, const cloud::Point<dim> &point,
                                 const ShapeFunctions<dim> &basis) {
  const std::size_t n = regularity.n_neighbours;
  const std::string count = n < basis.n_terms()
                                ? fmt::format("too few neighbours, {} for {} terms: they", n, basis.n_terms())
                                : fmt::format("its {} neighbours", n);
  const std::string cause =
      fmt::format("{} do not lie on {} distinct lines of particles in every direction, as order {} needs", count,
                  basis.order() + 1, basis.order());
  throw SingularMomentMatrix(fmt::format(
      "singular moment matrix at ({:.6g}): {} (smallest pivot ratio {:.1e}); enlarge the support (now {} h), lower "
      "the order, or add particles there",
      fmt::join(point, ", "), cause, regularity.smallest_pivot_ratio, basis.support()));
}

} // namespace

template <int dim>
void require_regular(const Regularity &regularity, const PointBatch<dim> &points, const ShapeFunctions<dim> &basis) {
  if (!(regularity.smallest_pivot_ratio > singular_pivot_ratio))
    throw_singular<dim>(regularity, points.point(regularity.worst_point), basis);
}

template <int dim>
void require_regular(const Regularity &regularity, const NeighbourPack<dim> &pack, const ShapeFunctions<dim> &basis) {
  if (!(regularity.smallest_pivot_ratio > singular_pivot_ratio))
    throw_singular<dim>(regularity, pack.point(regularity.worst_point), basis);
}

#define INSTANTIATE(dim)                                                                                               \
  template class PointBatch<dim>;                                                                                      \
  template class CandidateBatch<dim>;                                                                                  \
  template class ShapeFunctionValues<dim>;                                                                             \
  template class ShapeFunctions<dim>;                                                                                  \
  template void require_regular<dim>(const Regularity &, const PointBatch<dim> &, const ShapeFunctions<dim> &);        \
  template void require_regular<dim>(const Regularity &, const NeighbourPack<dim> &, const ShapeFunctions<dim> &);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::basis
