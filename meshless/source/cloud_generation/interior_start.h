#pragma once

#include "boundary_curves.h"

namespace meshless::cloud_generation {

/// The area of a region in cells of about half the local spacing, along Hilbert's curve.
class InteriorCells {
public:
  /// @param scale of the spacing
  /// @param deepest number of halvings of the region that a cell may have; few give an estimate
  /// @throws std::invalid_argument if the region would hold more than 1e7 particles
  InteriorCells(const domain::Boundary &region, const Spacing &spacing, double scale, int deepest = 30);

  /// integral 2 / (sqrt(3) s^2) dA with the unscaled spacing: the number of particles of a hexagonal pattern, those on
  /// the boundary for half.
  double n_expected() const { return total_; }

  /// n places strictly inside, one in every n-th part of the expected number.
  std::vector<Point2> places(std::size_t n, std::uint64_t seed) const;

private:
  struct Cell {
    Point2 lower;
    double size;
    std::uint64_t order; ///< along Hilbert's curve
    double n;            ///< expected particles
    bool whole;          ///< no boundary near
  };

  const domain::Boundary &region_;
  std::vector<Cell> cells_;
  double total_ = 0;
};

} // namespace meshless::cloud_generation
