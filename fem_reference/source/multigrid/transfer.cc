#include "transfer.h"

#include "../parallel/bands.h"

#include <algorithm>
#include <cmath>

namespace fem_reference::multigrid {
void Transfer::reserve(std::size_t n_fine, std::size_t n_entries) {
  start_.reserve(n_fine + 1);
  nodes_.reserve(n_entries);
  weights_.reserve(n_entries);
}

void Transfer::add(unsigned coarse_node, double weight) {
  if (std::abs(weight) < 1e-12)
    return;
  nodes_.push_back(coarse_node);
  weights_.push_back(static_cast<float>(weight));
}

void Transfer::end_of_node() { start_.push_back(static_cast<unsigned>(nodes_.size())); }

std::span<const unsigned> Transfer::nodes_of(std::size_t fine) const {
  return {nodes_.data() + start_[fine], start_[fine + 1] - start_[fine]};
}

std::span<const float> Transfer::weights_of(std::size_t fine) const {
  return {weights_.data() + start_[fine], start_[fine + 1] - start_[fine]};
}

void Transfer::prolongate(std::span<const float> coarse, std::span<float> fine) const {
  parallel::for_each_band(n_fine(), parallel::n_short_bands(n_fine()), [&](const parallel::Band &band, int) {
    for (std::size_t i = band.begin; i < band.end; ++i) {
      float sum_1 = 0;
      float sum_2 = 0;
      for (unsigned k = start_[i]; k < start_[i + 1]; ++k) {
        sum_1 += weights_[k] * coarse[2 * std::size_t{nodes_[k]}];
        sum_2 += weights_[k] * coarse[2 * std::size_t{nodes_[k]} + 1];
      }
      fine[2 * i] += sum_1;
      fine[2 * i + 1] += sum_2;
    }
  });
}

void Transfer::restrict_to(std::span<const float> fine, std::span<float> coarse) const {
  std::fill(coarse.begin(), coarse.end(), 0.F);
  for (std::size_t i = 0; i < n_fine(); ++i)
    for (unsigned k = start_[i]; k < start_[i + 1]; ++k) {
      coarse[2 * std::size_t{nodes_[k]}] += weights_[k] * fine[2 * i];
      coarse[2 * std::size_t{nodes_[k]} + 1] += weights_[k] * fine[2 * i + 1];
    }
}
} // namespace fem_reference::multigrid
