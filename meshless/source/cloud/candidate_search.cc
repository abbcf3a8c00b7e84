#include "meshless/cloud/candidate_search.h"

#include "meshless/cloud/radix_sort.h"

#include <algorithm>

namespace meshless::cloud {

namespace {

/// Up to this ratio of the largest to the smallest h cells for the largest one find few candidates in vain; beyond it
/// the tree is faster.
constexpr double largest_ratio = 2;

} // namespace

template <int dim>
CandidateSearch<dim>::CandidateSearch(const Particles<dim> &particles, double support)
    : particles_(&particles), support_(support) {
  if (particles.largest_smoothing_length() <= largest_ratio * particles.smallest_smoothing_length())
    cells_.emplace(particles.positions(), support * particles.largest_smoothing_length() / 2);
  else
    tree_.emplace(particles.positions());
}

template <int dim>
void CandidateSearch<dim>::collect(const Point<dim> &centre, double radius, std::vector<Index> &result) const {
  result.clear();
  const double reach = support_ * particles_->largest_smoothing_length() + radius;
  if (cells_)
    cells_->append_within(centre, reach, result);
  else
    tree_->append_within(centre, reach, result);
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
