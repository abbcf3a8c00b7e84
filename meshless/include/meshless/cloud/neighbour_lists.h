#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meshless::cloud {

/// Local particle index: 32 bits are enough for one process.
using Index = std::int32_t;

/// Neighbours of many points as compressed rows: row i is indices[offsets[i] ... offsets[i + 1]).
class NeighbourLists {
public:
  NeighbourLists() : offsets_(1, 0) {}
  /// @throws std::invalid_argument if offsets do not start at 0, decrease, or do not end at the
  ///   number of indices
  NeighbourLists(std::vector<std::size_t> offsets, std::vector<Index> indices);

  std::size_t n_rows() const { return offsets_.size() - 1; }
  std::size_t n_entries() const { return indices_.size(); }
  std::span<const Index> operator[](std::size_t row) const {
    return {indices_.data() + offsets_[row], offsets_[row + 1] - offsets_[row]};
  }
  std::span<const std::size_t> offsets() const { return offsets_; }
  std::span<const Index> indices() const { return indices_; }

private:
  std::vector<std::size_t> offsets_;
  std::vector<Index> indices_;
};

} // namespace meshless::cloud
