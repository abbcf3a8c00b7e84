#include "meshless/cloud/particles.h"

#include "meshless/cloud/point_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::cloud {

namespace {

template <typename T>
linear_algebra::LargeArray<T> in_large_pages(std::span<const T> values) {
  linear_algebra::LargeArray<T> result;
  result.append(values);
  return result;
}

template <int dim>
void check_positions(std::span<const Point<dim>> positions, std::span<const int> regions) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (const double x : positions[i])
      if (!std::isfinite(x))
        throw std::invalid_argument(
            fmt::format("particle {}: its position ({}) is not finite", i, fmt::join(positions[i], ", ")));

  // Sorted, equal positions are adjacent.
  std::vector<std::size_t> order(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  const auto region = [&](std::size_t i) { return regions.empty() ? 0 : regions[i]; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (positions[a] != positions[b])
      return positions[a] < positions[b];
    return region(a) != region(b) ? region(a) < region(b) : a < b;
  });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (positions[order[k]] == positions[order[k - 1]] && region(order[k]) == region(order[k - 1]))
      throw std::invalid_argument(fmt::format("particles {} and {} are at the same place ({})", order[k - 1], order[k],
                                              fmt::join(positions[order[k]], ", ")));
}

} // namespace

template <int dim>
Particles<dim>::Particles(std::vector<Point<dim>> positions, std::vector<double> smoothing_lengths,
                          std::vector<double> volumes, std::vector<int> regions, std::vector<Point<dim>> flattenings)
    : positions_(in_large_pages<Point<dim>>(positions)), smoothing_lengths_(in_large_pages<double>(smoothing_lengths)),
      volumes_(std::move(volumes)), regions_(std::move(regions)), flattenings_(std::move(flattenings)) {
  if (positions_.empty())
    throw std::invalid_argument("a cloud needs at least one particle");
  if (positions_.size() != smoothing_lengths_.size())
    throw std::invalid_argument(
        fmt::format("{} positions but {} smoothing lengths", positions_.size(), smoothing_lengths_.size()));
  if (!volumes_.empty() && positions_.size() != volumes_.size())
    throw std::invalid_argument(fmt::format("{} positions but {} volumes", positions_.size(), volumes_.size()));
  if (!regions_.empty() && positions_.size() != regions_.size())
    throw std::invalid_argument(fmt::format("{} positions but {} regions", positions_.size(), regions_.size()));
  if (!flattenings_.empty() && positions_.size() != flattenings_.size())
    throw std::invalid_argument(fmt::format("{} positions but {} flattenings", positions_.size(), flattenings_.size()));
  for (std::size_t i = 0; i < flattenings_.size(); ++i)
    for (const double f : flattenings_[i])
      if (!std::isfinite(f))
        throw std::invalid_argument(
            fmt::format("particle {}: its flattening ({}) is not finite", i, fmt::join(flattenings_[i], ", ")));
  for (std::size_t i = 0; i < regions_.size(); ++i)
    if (regions_[i] < 0)
      throw std::invalid_argument(fmt::format("particle {}: its region {} is not an index", i, regions_[i]));
  check_positions<dim>(this->positions(), regions_);
  for (std::size_t i = 0; i < volumes_.size(); ++i)
    if (!(volumes_[i] > 0) || !std::isfinite(volumes_[i]))
      throw std::invalid_argument(fmt::format("particle {}: its volume {} is not positive", i, volumes_[i]));
  for (std::size_t i = 0; i < size(); ++i) {
    const double h = smoothing_lengths_[i];
    if (!(h > 0) || !std::isfinite(h))
      throw std::invalid_argument(fmt::format("particle {}: its smoothing length {} is not positive", i, h));
    smallest_smoothing_length_ = std::min(smallest_smoothing_length_, h);
    largest_smoothing_length_ = std::max(largest_smoothing_length_, h);
  }
  uniform_ = largest_smoothing_length_ <= smallest_smoothing_length_ * (1 + 1e-9);
}

template <int dim>
double Particles<dim>::squared_distance_in_h(std::size_t i, const Point<dim> &x) const {
  double along = 0;
  if (has_flattenings())
    for (int k = 0; k < dim; ++k)
      along += flattenings_[i][k] * (x[k] - positions_[i][k]);
  return (distance_squared<dim>(positions_[i], x) + along * along) / (smoothing_lengths_[i] * smoothing_lengths_[i]);
}

template <int dim>
std::vector<double> smoothing_lengths_by_nearest(std::span<const Point<dim>> positions, double factor) {
  return smoothing_lengths_by_mean<dim>(positions, 1, factor);
}

template <int dim>
std::vector<double> smoothing_lengths_by_mean(std::span<const Point<dim>> positions, int k, double factor) {
  if (positions.size() < 2)
    throw std::invalid_argument("a smoothing length needs at least two particles");
  if (k < 1)
    throw std::invalid_argument(
        fmt::format("a smoothing length from the {} nearest particles; at least 1 is needed", k));
  const PointTree<dim> tree(positions);
  std::vector<double> lengths(positions.size());
  std::vector<Index> indices;
  std::vector<double> distances;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    tree.nearest(positions[i], k + 1, indices, distances); // the particle itself comes first
    double sum = 0;
    for (std::size_t n = 1; n < distances.size(); ++n)
      sum += distances[n];
    lengths[i] = factor * sum / static_cast<double>(distances.size() - 1);
  }
  return lengths;
}

#define INSTANTIATE(dim)                                                                                               \
  template class Particles<dim>;                                                                                       \
  template std::vector<double> smoothing_lengths_by_nearest<dim>(std::span<const Point<dim>>, double);                 \
  template std::vector<double> smoothing_lengths_by_mean<dim>(std::span<const Point<dim>>, int, double);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::cloud
