#pragma once

#include "meshless/cloud/levelled_cells.h"
#include "meshless/cloud/particles.h"

#include <vector>

namespace meshless::cloud {

/// Finds the particles whose support reaches into a ball: the candidates that all points of the
/// ball share. The support of particle j is the ball of radius `support` h_j around it.
template <int dim>
class CandidateSearch {
public:
  /// @param particles kept by reference; must outlive the search
  /// @param support radius of the kernel's support in units of h
  CandidateSearch(const Particles<dim> &particles, double support);

  /// Replaces `result` by the candidates of the ball, in increasing order.
  void collect(const Point<dim> &centre, double radius, std::vector<Index> &result) const;

  const Particles<dim> &particles() const { return *particles_; }
  double support() const { return support_; }

private:
  const Particles<dim> *particles_;
  double support_;
  LevelledCells<dim> cells_;
};

} // namespace meshless::cloud
