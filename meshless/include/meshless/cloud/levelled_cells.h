#pragma once

#include "meshless/cloud/cell_list.h"

#include <span>
#include <vector>

namespace meshless::cloud {

/// Neighbour search for particles of very different sizes: those within a factor of two of each other share a cell
/// list of their own size, so that neither the smallest are sought in vain in large cells nor the largest in small
/// ones.
template <int dim>
class LevelledCells {
public:
  /// @param positions kept by reference; must outlive the search
  /// @param sizes one per particle, in metres, > 0 and finite
  /// @param cell_size edge of a cell in units of the largest size in it
  LevelledCells(std::span<const Point<dim>> positions, std::span<const double> sizes, double cell_size);

  /// Appends the particles with |x_j - centre| < radius + factor l_j to `result`, in no particular order; l_j is the
  /// largest size on the level of j, at most twice its own.
  void append_within(const Point<dim> &centre, double radius, double factor, std::vector<Index> &result) const;

  std::size_t n_levels() const { return levels_.size(); }

private:
  struct Level {
    double largest;
    std::vector<Index> members; ///< empty for all particles
    std::vector<Point<dim>> positions;
    CellList<dim> cells;
  };

  std::vector<Level> levels_;
};

} // namespace meshless::cloud
