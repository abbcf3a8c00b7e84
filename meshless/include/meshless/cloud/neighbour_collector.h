#pragma once

#include "meshless/cloud/candidate_search.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meshless::cloud {

/// Finds the neighbours of each of some points that are near each other: the particles whose support holds the point.
/// One search finds the candidates of all points, from which each takes its own. Of one thread; its memory stays.
template <int dim>
class NeighbourCollector {
public:
  /// @param search kept by reference
  explicit NeighbourCollector(const CandidateSearch<dim> &search) : search_(&search) {}

  /// Replaces the lists by those of the points.
  void collect(std::span<const Point<dim>> points);

  /// Neighbours of point i: |x_j - x_i| < support h_j, in increasing order.
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
  std::vector<std::size_t> offsets_;
  std::vector<Index> indices_;
};

} // namespace meshless::cloud
