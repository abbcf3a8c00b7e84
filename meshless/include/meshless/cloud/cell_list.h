#pragma once

#include "meshless/cloud/neighbour_lists.h"
#include "meshless/cloud/particles.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meshless::cloud {

/// Neighbour search for one radius: particles sorted into square cells, stored as compressed rows.
///
/// A query visits the cells that its ball touches. Building is O(n); the number of cells is
/// bounded by a small multiple of the number of particles, whatever the spread of the cloud.
template <int dim>
class CellList {
public:
  /// @param positions kept by reference; must outlive the list
  /// @param cell_size edge of a cell, in metres, > 0; about the search radius is best
  CellList(std::span<const Point<dim>> positions, double cell_size);

  /// Appends the particles with |x_j - centre| < radius to `result`, in no particular order.
  void append_within(const Point<dim> &centre, double radius, std::vector<Index> &result) const;

  /// Neighbours of every particle within `radius` (itself included), each row sorted.
  NeighbourLists all_within(double radius) const;

private:
  std::array<std::ptrdiff_t, dim> cell_of(const Point<dim> &point) const;

  std::span<const Point<dim>> positions_;
  Point<dim> origin_{};
  double cell_size_ = 1;
  std::array<std::ptrdiff_t, dim> n_cells_{};
  std::vector<std::size_t> offsets_;
  std::vector<Index> members_;
  /// Positions in the order of members_, so that a cell is read contiguously.
  std::vector<Point<dim>> sorted_positions_;
};

} // namespace meshless::cloud
