#pragma once

#include "meshless/cloud/candidate_search.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meshless::cloud {

/// Neighbours of points, each its own: the particles whose support holds the point. One search finds the candidates of
/// points near each other, from which each takes its own. Of one thread; its memory stays.
template <int dim>
class NeighbourCollector {
public:
  /// @param search kept by reference
  explicit NeighbourCollector(const CandidateSearch<dim> &search) : search_(&search) {}

  void clear() { offsets_.assign(1, 0); }
  /// Appends the lists of some points near each other.
  void append(std::span<const Point<dim>> points);

  /// Neighbours of point i since the last `clear`: |x_j - x_i| < support h_j, in increasing order.
  std::span<const Index> operator[](std::size_t i) const {
    return {indices_.data() + offsets_[i], offsets_[i + 1] - offsets_[i]};
  }

private:
  void find_candidates(std::span<const Point<dim>> points);

  const CandidateSearch<dim> *search_;
  std::vector<Index> candidates_;
  /// Of the candidates, padded to whole packs with such as have no neighbour.
  std::array<std::vector<double>, dim> coordinates_;
  std::vector<double> reach_squared_;
  std::vector<std::size_t> offsets_{0};
  std::vector<Index> indices_; ///< and room behind those in use
};

} // namespace meshless::cloud
