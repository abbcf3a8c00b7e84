#pragma once

#include "../parallel/bands.h"

#include <span>
#include <vector>

namespace fem_reference::multigrid {
/// What one thread computes: the nodes of a band, from the batches of cells that touch it, ascending.
struct BatchPart {
  struct Batch {
    unsigned number;
    bool inside; ///< has no nodes but those of the band
  };
  parallel::Band band;
  std::vector<Batch> batches;
};

/// As many parts as threads, one of a small space.
/// @param nodes `nodes_per_batch` of every batch, one batch after the other
std::vector<BatchPart> share_out(std::span<const unsigned> nodes, std::size_t nodes_per_batch,
                                 std::size_t n_space_nodes);
} // namespace fem_reference::multigrid
