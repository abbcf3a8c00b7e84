#include "meshless/cloud/cell_list.h"

#include "meshless/cloud/radix_sort.h"
#include "meshless/linear_algebra/pack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace meshless::cloud {

namespace {

using linear_algebra::Pack;
constexpr std::size_t n_lanes = linear_algebra::n_lanes;
constexpr std::size_t slack = 128; // room in a row for further runs, in particles

/// Calls f(row begin, row end) for the cells in the box [low, high], a contiguous run along the
/// last axis at a time.
template <int dim, typename F>
void for_each_run(const std::array<std::ptrdiff_t, dim> &low, const std::array<std::ptrdiff_t, dim> &high,
                  const std::array<std::ptrdiff_t, dim> &n_cells, const F &f) {
  std::array<std::ptrdiff_t, dim> cell = low;
  while (true) {
    std::ptrdiff_t begin = 0;
    for (int k = 0; k < dim; ++k)
      begin = begin * n_cells[k] + cell[k];
    f(begin, begin + high[dim - 1] - low[dim - 1] + 1);
    int k = dim - 2;
    for (; k >= 0; --k) {
      if (++cell[k] <= high[k])
        break;
      cell[k] = low[k];
    }
    if (k < 0)
      return;
  }
}

} // namespace

template <int dim>
CellList<dim>::CellList(std::span<const Point<dim>> positions, double cell_size)
    : positions_(positions), cell_size_(cell_size) {
  if (!(cell_size > 0) || positions.empty())
    throw std::invalid_argument("a cell list needs particles and a positive cell size");
  Point<dim> upper = positions[0];
  origin_ = positions[0];
  for (const auto &x : positions)
    for (int k = 0; k < dim; ++k) {
      origin_[k] = std::min(origin_[k], x[k]);
      upper[k] = std::max(upper[k], x[k]);
    }
  // A cloud that is sparse in its bounding box would need too many cells: coarsen them.
  const double limit = 4.0 * static_cast<double>(positions.size()) + 64;
  for (;; cell_size_ *= 2) {
    double n = 1;
    for (int k = 0; k < dim; ++k)
      n *= std::floor((upper[k] - origin_[k]) / cell_size_) + 1;
    if (n <= limit)
      break;
  }
  std::size_t n_total = 1;
  for (int k = 0; k < dim; ++k) {
    n_cells_[k] = static_cast<std::ptrdiff_t>(std::floor((upper[k] - origin_[k]) / cell_size_)) + 1;
    n_total *= static_cast<std::size_t>(n_cells_[k]);
  }

  std::vector<std::size_t> cell_index(positions.size());
  offsets_.assign(n_total + 1, 0);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto cell = cell_of(positions[i]);
    std::size_t index = 0;
    for (int k = 0; k < dim; ++k)
      index = index * static_cast<std::size_t>(n_cells_[k]) + static_cast<std::size_t>(cell[k]);
    cell_index[i] = index;
    ++offsets_[index + 1];
  }
  for (std::size_t c = 1; c < offsets_.size(); ++c)
    offsets_[c] += offsets_[c - 1];
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  const auto make_room = [&](auto &array, auto behind) {
    array.resize(positions.size() + n_lanes);
    std::fill(array.begin() + positions.size(), array.end(), behind);
  };
  make_room(members_, Index{0});
  for (auto &coordinate : sorted_)
    make_room(coordinate, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::size_t slot = next[cell_index[i]]++;
    in_order_ = in_order_ && slot == i;
    members_[slot] = static_cast<Index>(i);
    for (int k = 0; k < dim; ++k)
      sorted_[k][slot] = positions[i][k];
  }
}

template <int dim>
std::array<std::ptrdiff_t, dim> CellList<dim>::cell_of(const Point<dim> &point) const {
  std::array<std::ptrdiff_t, dim> cell{};
  for (int k = 0; k < dim; ++k) {
    const double c = std::floor((point[k] - origin_[k]) / cell_size_);
    cell[k] = static_cast<std::ptrdiff_t>(std::clamp(c, 0.0, static_cast<double>(n_cells_[k] - 1)));
  }
  return cell;
}

template <int dim>
template <typename Visitor>
void CellList<dim>::visit_runs(const Point<dim> &centre, double radius, const Visitor &visit) const {
  Point<dim> low = centre;
  Point<dim> high = centre;
  for (int k = 0; k < dim; ++k) {
    low[k] -= radius;
    high[k] += radius;
  }
  for_each_run<dim>(cell_of(low), cell_of(high), n_cells_, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    visit(offsets_[static_cast<std::size_t>(begin)], offsets_[static_cast<std::size_t>(end)]);
  });
}

/// @param found room for every slot of the run and a pack beyond
template <int dim>
Index *CellList<dim>::write_within(std::size_t begin, std::size_t end, const Point<dim> &centre, double radius_squared,
                                   Index *found) const {
  const Pack lanes([](auto lane) { return static_cast<double>(lane); });
  for (; begin < end; begin += n_lanes) {
    Pack squared = 0;
    for (int k = 0; k < dim; ++k) {
      const Pack d = linear_algebra::load(sorted_[k].data() + begin) - centre[k];
      squared += d * d;
    }
    const auto near = squared < radius_squared && lanes < static_cast<double>(end - begin);
    found = linear_algebra::append_where(near, members_.data() + begin, found);
  }
  return found;
}

/// Writes the particles within the radius from place n of the row on, without an order.
/// @returns the place behind the last one; the row may be longer
template <int dim>
std::size_t CellList<dim>::find_within(const Point<dim> &centre, double radius, std::size_t n,
                                       std::vector<Index> &row) const {
  visit_runs(centre, radius, [&](std::size_t begin, std::size_t end) {
    const std::size_t needed = n + (end - begin) + n_lanes;
    if (row.size() < needed)
      row.resize(needed + slack); // not twice as much: rows may be appended to many others
    n = static_cast<std::size_t>(write_within(begin, end, centre, radius * radius, row.data() + n) - row.data());
  });
  return n;
}

template <int dim>
void CellList<dim>::append_within(const Point<dim> &centre, double radius, std::vector<Index> &result) const {
  result.resize(find_within(centre, radius, result.size(), result));
}

template <int dim>
NeighbourLists CellList<dim>::all_within(double radius) const {
  constexpr std::size_t n_sampled = 1000; // rows from which the length of all is guessed
  std::vector<std::size_t> offsets(1, 0);
  offsets.reserve(positions_.size() + 1);
  std::vector<Index> indices;
  std::vector<Index> row;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const std::size_t n = find_within(positions_[i], radius, 0, row);
    if (!in_order_) // else runs and what they hold come in order
      sort_indices(row, n);
    indices.insert(indices.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(n));
    offsets.push_back(indices.size());
    if (i + 1 == n_sampled)
      indices.reserve(indices.size() * (positions_.size() + positions_.size() / 10) / n_sampled);
  }
  return {std::move(offsets), std::move(indices)};
}

template class CellList<1>;
template class CellList<2>;
template class CellList<3>;

} // namespace meshless::cloud
