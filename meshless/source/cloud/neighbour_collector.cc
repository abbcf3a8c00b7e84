#include "meshless/cloud/neighbour_collector.h"

#include "meshless/linear_algebra/pack.h"

#include <algorithm>
#include <cmath>

namespace meshless::cloud {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;

template <int dim>
void NeighbourCollector<dim>::find_candidates(std::span<const Point<dim>> points) {
  Point<dim> low = points[0];
  Point<dim> high = points[0];
  for (const auto &x : points)
    for (int k = 0; k < dim; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  Point<dim> centre;
  for (int k = 0; k < dim; ++k)
    centre[k] = 0.5 * (low[k] + high[k]);
  const auto &particles = search_->particles();
  // Slack of rounding, so that the farthest point is covered.
  const double slack = 1e-12 * particles.largest_smoothing_length();
  search_->collect(centre, std::sqrt(distance_squared<dim>(centre, high)) + slack, candidates_);

  const std::size_t n = candidates_.size();
  const std::size_t n_padded = linear_algebra::padded(n);
  candidates_.resize(n_padded, 0);
  for (auto &coordinate : coordinates_)
    coordinate.resize(n_padded);
  reach_squared_.resize(n_padded);
  for (std::size_t c = 0; c < n_padded; ++c) {
    const auto j = static_cast<std::size_t>(candidates_[c]);
    const double reach = search_->support() * particles.smoothing_length(j);
    reach_squared_[c] = c < n ? reach * reach : 0;
    for (int k = 0; k < dim; ++k)
      coordinates_[k][c] = particles.position(j)[k];
  }
}

template <int dim>
void NeighbourCollector<dim>::append(std::span<const Point<dim>> points) {
  if (points.empty())
    return;
  find_candidates(points);
  const std::size_t n_candidates = candidates_.size();
  if (const std::size_t most = offsets_.back() + points.size() * n_candidates; indices_.size() < most)
    indices_.resize(most);
  std::array<const double *, dim> coordinates;
  for (int k = 0; k < dim; ++k)
    coordinates[k] = coordinates_[k].data();
  const double *reach_squared = reach_squared_.data();
  const Index *candidates = candidates_.data();
  Index *found = indices_.data() + offsets_.back();
  for (const auto &x : points) {
    for (std::size_t c = 0; c < n_candidates; c += n_lanes) {
      Pack squared = 0;
      for (int k = 0; k < dim; ++k) {
        const Pack d = load(coordinates[k] + c) - x[k];
        squared += d * d;
      }
      found = linear_algebra::append_where(squared < load(reach_squared + c), candidates + c, found);
    }
    offsets_.push_back(static_cast<std::size_t>(found - indices_.data()));
  }
}

template class NeighbourCollector<1>;
template class NeighbourCollector<2>;
template class NeighbourCollector<3>;

} // namespace meshless::cloud
