#include "meshless/basis/neighbour_pack.h"

#include <algorithm>

namespace meshless::basis {

using linear_algebra::load;
using linear_algebra::Pack;
using linear_algebra::store;

template <int dim>
void NeighbourPack<dim>::assign(const cloud::Particles<dim> &particles, std::span<const cloud::Point<dim>> points,
                                std::span<const std::span<const cloud::Index>> lists) {
  particles_ = &particles;
  size_ = points.size();
  n_slots_ = 0;
  for (std::size_t lane = 0; lane < n_lanes; ++lane) {
    const std::size_t i = std::min(lane, size_ - 1);
    points_[lane] = points[i];
    lists_[lane] = lists[i];
    counts_[lane] = static_cast<double>(lists[i].size());
    n_slots_ = std::max(n_slots_, lists[i].size());
  }
  fill_slots();
  fill_lengths();
  const Pack to_scale = 1 / scale();
  const double *positions = particles.positions().data()->data();
  std::array<Pack, dim> x;
  for (int k = 0; k < dim; ++k) {
    offsets_[k].resize(n_slots_ * n_lanes);
    x[k] = Pack([&](auto lane) { return points_[lane][k]; });
  }
  const Pack own_counts = counts();
  for (std::size_t a = 0; a < n_slots_; ++a)
    for (int k = 0; k < dim; ++k) {
      Pack d = (linear_algebra::gather<dim>(positions + k, &slots_[a * n_lanes]) - x[k]) * to_scale;
      where(own_counts <= static_cast<double>(a), d) = 0;
      store(d, &offsets_[k][a * n_lanes]);
    }
}

template <int dim>
void NeighbourPack<dim>::fill_slots() {
  slots_.resize(n_slots_ * n_lanes);
  for (std::size_t lane = 0; lane < n_lanes; ++lane) {
    const auto list = lists_[lane];
    cloud::Index *slot = slots_.data() + lane;
    for (std::size_t a = 0; a < list.size(); ++a)
      slot[a * n_lanes] = list[a];
    for (std::size_t a = list.size(); a < n_slots_; ++a)
      slot[a * n_lanes] = list.empty() ? 0 : list[0];
  }
}

template <int dim>
void NeighbourPack<dim>::fill_lengths() {
  inverse_h_.resize(n_slots_ * n_lanes);
  const double h = particles_->largest_smoothing_length();
  if (h == particles_->smallest_smoothing_length()) {
    scale_.fill(h);
    std::fill(inverse_h_.begin(), inverse_h_.end(), 1 / h);
    return;
  }
  const double *lengths = particles_->smoothing_lengths().data();
  const Pack own_counts = counts();
  Pack sum = 0;
  for (std::size_t a = 0; a < n_slots_; ++a) {
    Pack inverse = 1 / linear_algebra::gather<1>(lengths, &slots_[a * n_lanes]);
    store(inverse, &inverse_h_[a * n_lanes]);
    where(own_counts <= static_cast<double>(a), inverse) = 0;
    sum += inverse;
  }
  Pack scale = 1;
  where(own_counts > 0, scale) = own_counts / sum;
  store(scale, scale_.data());
}

template class NeighbourPack<1>;
template class NeighbourPack<2>;
template class NeighbourPack<3>;

} // namespace meshless::basis
