#pragma once

#include "discretisation.h"
#include "reference_element.h"

#include <cstddef>
#include <vector>

namespace fem_reference::elasticity {
/// A cell and the reference coordinates of a point in it.
struct Location {
  std::size_t cell = 0;
  mesh::Point xi{};
  bool outside = false;
};

/// Finds the cell of a point by a uniform grid of bins over the mesh, about one cell a bin.
/// Positions are relative to the discretisation's origin; it must outlive this object.
class PointLocation {
public:
  explicit PointLocation(const Discretisation &discretisation);

  /// The cell of lowest index that holds the point within 1e-10 of a cell, else the nearest cell, whose
  /// reference coordinates may leave the element by up to 1/4, and `outside` set.
  /// Throws InvalidInput if the point is not finite.
  Location locate(mesh::Point point) const;

private:
  struct Box {
    mesh::Point lower;
    mesh::Point upper;
  };

  Box box_of(std::size_t cell) const;
  int bin_of(double coordinate, std::size_t direction) const;
  bool invert(std::size_t cell, mesh::Point point, mesh::Point &xi) const;
  bool invert_curved(std::size_t cell, mesh::Point point, mesh::Point &xi) const;
  bool invert_from_node(std::size_t cell, mesh::Point point, mesh::Point &xi) const;
  Location nearest(mesh::Point point) const;

  const Discretisation &discretisation_;
  std::vector<Box> boxes_;
  mesh::Point lower_{};
  mesh::Point bin_size_{};
  std::array<int, 2> n_bins_{};
  std::vector<unsigned> bin_start_;
  std::vector<unsigned> bin_cells_;
};
} // namespace fem_reference::elasticity
