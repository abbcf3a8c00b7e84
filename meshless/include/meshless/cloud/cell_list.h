#pragma once

#include "meshless/cloud/neighbour_lists.h"
#include "meshless/cloud/particles.h"
#include "meshless/linear_algebra/large_array.h"

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

  /// Neighbours of every particle within `radius` (itself included), each row sorted. Two to five times as fast for
  /// particles that are numbered in the order of the cells: see `order`.
  NeighbourLists all_within(double radius) const;

  /// The particles cell by cell. Renumbered so, neighbours lie close to each other in memory, and a list with cells of
  /// the same size leaves them in place.
  std::span<const Index> order() const { return std::span<const Index>(members_).first(positions_.size()); }

private:
  template <typename Visitor>
  void visit_runs(const Point<dim> &centre, double radius, const Visitor &visit) const;
  Index *write_within(std::size_t begin, std::size_t end, const Point<dim> &centre, double radius_squared,
                      Index *found) const;
  std::size_t find_within(const Point<dim> &centre, double radius, std::size_t n, std::vector<Index> &row) const;
  std::array<std::ptrdiff_t, dim> cell_of(const Point<dim> &point) const;

  std::span<const Point<dim>> positions_;
  Point<dim> origin_{};
  double cell_size_ = 1;
  std::array<std::ptrdiff_t, dim> n_cells_{};
  std::vector<std::size_t> offsets_;
  /// The particles cell by cell, and their coordinates in this order, so that a cell is read contiguously; a pack of
  /// others behind the last one. In large pages: cells that a query visits lie far apart.
  linear_algebra::LargeArray<Index> members_;
  std::array<linear_algebra::LargeArray<double>, dim> sorted_;
  bool in_order_ = true; ///< members_ are 0, 1, 2 ...
};

} // namespace meshless::cloud
