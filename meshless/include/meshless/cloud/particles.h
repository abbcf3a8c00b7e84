#pragma once

#include "meshless/linear_algebra/large_array.h"

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace meshless::cloud {

/// A position or vector, in metres where it is a position.
template <int dim>
using Point = std::array<double, dim>;

template <int dim>
inline double distance_squared(const Point<dim> &a, const Point<dim> &b) {
  double sum = 0;
  for (int k = 0; k < dim; ++k)
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// A cloud of particles: positions, smoothing lengths and, if a basis weighs with them, volumes, and if the domain
/// has several, the region of every particle; checked once.
template <int dim>
class Particles {
public:
  Particles() = default;

  /// @param positions in metres
  /// @param smoothing_lengths h of every particle in metres, as many as positions, all > 0
  /// @param volumes m / rho of every particle in m^dim, as many as positions, all > 0; or none
  /// @param regions index >= 0 of the region of every particle, as many as positions; or none: all are in region 0.
  ///   Particles of different regions may be at the same place: on an interface.
  /// @param flattenings f of every particle, as many as positions, without unit; or none: supports are round. With f a
  ///   support is an ellipse: an offset d is s long in units of h, s^2 = (|d|^2 + (f . d)^2) / h^2, so that h is half
  ///   of its length and it is sqrt(1 + |f|^2) times as short along f.
  /// @throws std::invalid_argument naming the particle for a non-finite position or flattening, a smoothing
  ///   length or volume that is not positive, or two particles of a region at the same place
  Particles(std::vector<Point<dim>> positions, std::vector<double> smoothing_lengths, std::vector<double> volumes = {},
            std::vector<int> regions = {}, std::vector<Point<dim>> flattenings = {});

  std::size_t size() const { return positions_.size(); }
  const Point<dim> &position(std::size_t i) const { return positions_[i]; }
  double smoothing_length(std::size_t i) const { return smoothing_lengths_[i]; }
  std::span<const Point<dim>> positions() const { return positions_; }
  std::span<const double> smoothing_lengths() const { return smoothing_lengths_; }
  bool has_volumes() const { return !volumes_.empty(); }
  /// m / rho in m^dim; empty if the cloud has none.
  std::span<const double> volumes() const { return volumes_; }
  bool has_regions() const { return !regions_.empty(); }
  /// Index of the region that the particle belongs to.
  int region(std::size_t i) const { return regions_.empty() ? 0 : regions_[i]; }
  std::span<const int> regions() const { return regions_; }
  /// True if supports are ellipses.
  bool has_flattenings() const { return !flattenings_.empty(); }
  std::span<const Point<dim>> flattenings() const { return flattenings_; }
  Point<dim> flattening(std::size_t i) const { return flattenings_.empty() ? Point<dim>{} : flattenings_[i]; }
  /// s^2 of the offset from a particle to a point.
  double squared_distance_in_h(std::size_t i, const Point<dim> &x) const;
  double largest_smoothing_length() const { return largest_smoothing_length_; }
  double smallest_smoothing_length() const { return smallest_smoothing_length_; }
  /// True if all smoothing lengths are equal to rounding.
  bool uniform() const { return uniform_; }

private:
  // Read for every pair of neighbours: in large pages they take a few entries of the processor's table of pages.
  linear_algebra::LargeArray<Point<dim>> positions_;
  linear_algebra::LargeArray<double> smoothing_lengths_;
  std::vector<double> volumes_;
  std::vector<int> regions_;
  std::vector<Point<dim>> flattenings_;
  double largest_smoothing_length_ = 0;
  double smallest_smoothing_length_ = std::numeric_limits<double>::infinity();
  bool uniform_ = true;
};

/// Smoothing length from the nearest neighbour (Batra & Zhang 2008, section 3.2: h is the
/// smallest distance of a particle from its neighbours), times `factor`.
template <int dim>
std::vector<double> smoothing_lengths_by_nearest(std::span<const Point<dim>> positions, double factor);

/// Smoothing length from the mean distance of the k nearest neighbours, times `factor`; robust on
/// anisotropic clouds, where the nearest distance alone leaves particles without neighbours.
/// @throws std::invalid_argument for fewer than two particles or k < 1
template <int dim>
std::vector<double> smoothing_lengths_by_mean(std::span<const Point<dim>> positions, int k, double factor);

} // namespace meshless::cloud
