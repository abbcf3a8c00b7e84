#pragma once

#include <span>
#include <vector>

namespace fem_reference::multigrid {
/// Interpolation from the nodes of a coarse space to those of a fine one, the same for both components of the
/// displacement: fine node i has weights[k] of coarse node nodes[k], k = start[i] ... start[i + 1] - 1.
class Transfer {
public:
  void reserve(std::size_t n_fine, std::size_t n_entries);
  /// One more entry of the fine node that is being written; weights below rounding are dropped.
  void add(unsigned coarse_node, double weight);
  /// The next fine node follows.
  void end_of_node();

  std::size_t n_fine() const { return start_.size() - 1; }
  std::span<const unsigned> nodes_of(std::size_t fine) const;
  std::span<const float> weights_of(std::size_t fine) const;

  /// fine += P coarse
  void prolongate(std::span<const float> coarse, std::span<float> fine) const;
  /// coarse = P^T fine
  void restrict_to(std::span<const float> fine, std::span<float> coarse) const;

private:
  std::vector<unsigned> start_{0};
  std::vector<unsigned> nodes_;
  std::vector<float> weights_;
};
} // namespace fem_reference::multigrid
