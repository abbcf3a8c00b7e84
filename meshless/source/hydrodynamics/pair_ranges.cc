#include "pair_ranges.h"

#include "meshless/linear_algebra/pack.h"

#include <algorithm>
#include <limits>

namespace meshless::hydrodynamics {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;

PairRanges::PairRanges(std::size_t n_allocated) : least_left_(n_allocated, std::numeric_limits<double>::max()) {
  widths_.reserve(n_allocated / block_size + 1);
  offsets_.reserve(n_allocated / block_size + 1);
}

bool PairRanges::find(const double *position, const double *smoothing_length, std::size_t first, std::size_t last,
                      double reach) {
  first_ = first;
  const double half = 0.5 * reach;
  double least = std::numeric_limits<double>::max();
  std::fill_n(least_left_.begin() + static_cast<std::ptrdiff_t>(last), padding, least);
  for (std::size_t j = last; j-- > first;)
    least_left_[j] = least = std::min(least, position[j] - half * smoothing_length[j]);
  widths_.clear();
  offsets_.clear();
  n_pairs_ = 0;
  std::size_t k = 1; // the width of the block before is a good guess
  for (std::size_t begin = first; begin < last; begin += block_size) {
    const std::size_t end = std::min(begin + block_size, last);
    const auto any = [&](std::size_t offset) {
      for (std::size_t i = begin; i < end; i += n_lanes) // what lies behind the last particle is far away
        if (any_of(load(&least_left_[i + offset]) < load(position + i) + half * load(smoothing_length + i)))
          return true;
      return false;
    };
    while (k > 1 && !any(k))
      --k;
    while (k < padding - block_size && any(k))
      ++k;
    if (k >= padding - block_size)
      return false;
    widths_.push_back(k - 1);
    offsets_.push_back(n_pairs_);
    n_pairs_ += (k - 1) * block_size;
  }
  return true;
}

std::size_t PairRanges::bytes() const {
  return least_left_.size() * sizeof(double) + (widths_.capacity() + offsets_.capacity()) * sizeof(std::size_t);
}

} // namespace meshless::hydrodynamics
