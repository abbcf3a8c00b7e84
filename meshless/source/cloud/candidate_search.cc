#include "meshless/cloud/candidate_search.h"

#include "meshless/cloud/radix_sort.h"

#include <algorithm>

namespace meshless::cloud {

template <int dim>
CandidateSearch<dim>::CandidateSearch(const Particles<dim> &particles, double support)
    : particles_(&particles), support_(support),
      cells_(particles.positions(), particles.smoothing_lengths(), support / 2) {}

template <int dim>
void CandidateSearch<dim>::collect(const Point<dim> &centre, double radius, std::vector<Index> &result) const {
  result.clear();
  cells_.append_within(centre, radius, support_, result);
  if (!particles_->uniform())
    std::erase_if(result, [&](Index j) {
      const auto particle = static_cast<std::size_t>(j);
      const double own = support_ * particles_->smoothing_length(particle) + radius;
      return distance_squared<dim>(particles_->position(particle), centre) >= own * own;
    });
  sort_indices(result, result.size());
}

template class CandidateSearch<1>;
template class CandidateSearch<2>;
template class CandidateSearch<3>;

} // namespace meshless::cloud
