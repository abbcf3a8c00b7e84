#pragma once

#include "fem_reference/threads.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace fem_reference::parallel {
/// The numbers begin ... end - 1: nodes, for instance, that one thread writes to.
struct Band {
  unsigned begin = 0;
  unsigned end = 0;

  bool holds(unsigned i) const { return i - begin < end - begin; }
  bool touches(std::span<const unsigned> numbers) const {
    return std::any_of(numbers.begin(), numbers.end(), [this](unsigned i) { return holds(i); });
  }
};

/// Calls function(band, k) for bands k = 0 ... n_bands - 1 that share out 0 ... n - 1 evenly, several at once.
///
/// Of nodes: if a function goes through the cells in their order and adds to what belongs to its band, every sum is
/// that of one thread to the last bit. Cells that touch several bands are worked on in each; nodes are numbered as the
/// cells meet them, so that these are few, a layer between two bands.
///
/// The function must not throw: which exception came first would depend on chance.
template <typename Function>
void for_each_band(std::size_t n, int n_bands, const Function &function) {
  const auto at = [&](int k) {
    return static_cast<unsigned>(n * static_cast<std::size_t>(k) / static_cast<std::size_t>(n_bands));
  };
  const auto run = [&](int k) { function(Band{at(k), at(k + 1)}, k); };
  if (n_bands == 1)
    run(0);
  else
    tbb::parallel_for(0, n_bands, run, tbb::simple_partitioner());
}

/// As many bands as threads.
template <typename Function>
void for_each_band(std::size_t n, const Function &function) {
  for_each_band(n, threads(), function);
}

/// Bands for loops over n nodes of some nanoseconds each: one if waking another thread takes as long as the loop.
inline int n_short_bands(std::size_t n) {
  constexpr std::size_t few = 5000;
  return n < few ? 1 : threads();
}
} // namespace fem_reference::parallel
