#pragma once

#include "fem_reference/threads.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace fem_reference::parallel {
/// The nodes begin ... end - 1: what one thread writes to.
struct NodeBand {
  unsigned begin = 0;
  unsigned end = 0;

  bool holds(unsigned node) const { return node - begin < end - begin; }
  bool touches(std::span<const unsigned> nodes) const {
    return std::any_of(nodes.begin(), nodes.end(), [this](unsigned node) { return holds(node); });
  }
};

inline NodeBand all_nodes(std::size_t n_nodes) { return {0, static_cast<unsigned>(n_nodes)}; }

/// Band k of n_bands of about one length.
inline NodeBand node_band(std::size_t n_nodes, int n_bands, int k) {
  const auto at = [&](int i) {
    return static_cast<unsigned>(n_nodes * static_cast<std::size_t>(i) / static_cast<std::size_t>(n_bands));
  };
  return {at(k), at(k + 1)};
}

/// Calls function(band, k) for bands k = 0 ... threads() - 1 that share out the nodes, several at once. If a function
/// goes through the cells in their order and adds to what belongs to the nodes of its band, every sum is that of one
/// thread to the last bit. Cells that touch several bands are worked on in each: nodes are numbered as the cells meet
/// them, so that these are few, a layer between two bands.
///
/// The function must not throw: which exception came first would depend on chance.
template <typename Function>
void for_each_node_band(std::size_t n_nodes, const Function &function) {
  const int n_bands = threads();
  const auto run = [&](int k) { function(node_band(n_nodes, n_bands, k), k); };
  if (n_bands == 1)
    run(0);
  else
    tbb::parallel_for(0, n_bands, run, tbb::simple_partitioner());
}
} // namespace fem_reference::parallel
