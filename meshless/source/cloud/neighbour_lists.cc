#include "meshless/cloud/neighbour_lists.h"

#include <stdexcept>

namespace meshless::cloud {

NeighbourLists::NeighbourLists(std::vector<std::size_t> offsets, std::vector<Index> indices)
    : offsets_(std::move(offsets)), indices_(std::move(indices)) {
  if (offsets_.empty() || offsets_.front() != 0 || offsets_.back() != indices_.size())
    throw std::invalid_argument("neighbour lists: offsets must start at 0 and end at the number of indices");
  for (std::size_t i = 1; i < offsets_.size(); ++i)
    if (offsets_[i] < offsets_[i - 1])
      throw std::invalid_argument("neighbour lists: offsets must not decrease");
}

} // namespace meshless::cloud
