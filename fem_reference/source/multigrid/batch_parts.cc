#include "batch_parts.h"

#include <algorithm>

namespace fem_reference::multigrid {
std::vector<BatchPart> share_out(std::span<const unsigned> nodes, std::size_t nodes_per_batch,
                                 std::size_t n_space_nodes) {
  const int n_parts = parallel::n_short_bands(n_space_nodes);
  std::vector<BatchPart> parts(static_cast<std::size_t>(n_parts));
  parallel::for_each_band(n_space_nodes, n_parts, [&](const parallel::Band &band, int k) {
    auto &part = parts[static_cast<std::size_t>(k)];
    part.band = band;
    for (unsigned b = 0; b < nodes.size() / nodes_per_batch; ++b) {
      const auto of_batch = nodes.subspan(b * nodes_per_batch, nodes_per_batch);
      if (!band.touches(of_batch))
        continue;
      const bool inside =
          std::all_of(of_batch.begin(), of_batch.end(), [&](unsigned node) { return band.holds(node); });
      part.batches.push_back({b, inside});
    }
  });
  return parts;
}
} // namespace fem_reference::multigrid
