#pragma once

#include "meshless/cloud/neighbour_lists.h"
#include "meshless/cloud/particles.h"

#include <memory>
#include <span>
#include <vector>

namespace meshless::cloud {

/// Neighbour search for varying radii and for the k nearest, by a k-d tree (nanoflann).
template <int dim>
class PointTree {
public:
  /// @param positions kept by reference; must outlive the tree
  explicit PointTree(std::span<const Point<dim>> positions);
  ~PointTree();
  PointTree(PointTree &&) noexcept;
  PointTree &operator=(PointTree &&) noexcept;

  /// Appends the particles with |x_j - centre| < radius to `result`, in no particular order.
  void append_within(const Point<dim> &centre, double radius, std::vector<Index> &result) const;

  /// The k nearest particles (fewer if the cloud is smaller), nearest first, and their distances.
  void nearest(const Point<dim> &centre, int k, std::vector<Index> &indices, std::vector<double> &distances) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

} // namespace meshless::cloud
