#include "meshless/elasticity/surroundings.h"

#include <algorithm>
#include <cmath>

namespace meshless::elasticity {

Surroundings::Surroundings(std::vector<Region> regions) : regions_(std::move(regions)) {
  for (const auto &region : regions_)
    visibility_.emplace_back(region.boundary);
}

std::size_t Surroundings::region_of(const Point2 &point) const {
  if (regions_.size() == 1)
    return 0;
  for (std::size_t r = 0; r < regions_.size(); ++r)
    if (regions_[r].boundary.contains(point) || !regions_[r].boundary.pieces_at(point).empty())
      return r;
  std::size_t nearest = 0;
  for (std::size_t r = 1; r < regions_.size(); ++r)
    if (regions_[r].boundary.distance(point) < regions_[nearest].boundary.distance(point))
      nearest = r;
  return nearest;
}

RegionFilter::RegionFilter(const Surroundings &surroundings, const cloud::Particles<2> &particles, std::size_t region)
    : surroundings_(&surroundings), particles_(&particles), region_(region), view_(surroundings.visibility(region)) {}

bool RegionFilter::active(const Point2 &centre, double radius, double reach) const {
  if (particles_->has_regions())
    return true;
  const auto &visibility = surroundings_->visibility(region_);
  if (visibility.convex())
    return false;
  visibility.boundary().pieces_within(centre, radius + reach, near_);
  return !visibility.convex_chain(near_);
}

void RegionFilter::apply(const Point2 &point, std::vector<cloud::Index> &candidates) {
  if (particles_->has_regions())
    std::erase_if(candidates, [&](cloud::Index j) {
      return particles_->region(static_cast<std::size_t>(j)) != static_cast<int>(region_);
    });
  if (surroundings_->visibility(region_).convex())
    return;
  double reach = 0;
  for (const cloud::Index j : candidates)
    reach = std::max(reach, cloud::distance_squared<2>(particles_->position(static_cast<std::size_t>(j)), point));
  view_.move_to(point, std::sqrt(reach) * (1 + 1e-12));
  if (!view_.clear())
    std::erase_if(candidates,
                  [&](cloud::Index j) { return !view_.sees(particles_->position(static_cast<std::size_t>(j))); });
}

} // namespace meshless::elasticity
