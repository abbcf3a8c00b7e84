#include "meshless/cloud/levelled_cells.h"

#include <algorithm>
#include <stdexcept>

namespace meshless::cloud {

template <int dim>
LevelledCells<dim>::LevelledCells(std::span<const Point<dim>> positions, std::span<const double> sizes,
                                  double cell_size) {
  if (positions.empty() || positions.size() != sizes.size())
    throw std::invalid_argument("levelled cells need particles and a size for each");
  const auto [smallest, largest] = std::minmax_element(sizes.begin(), sizes.end());
  if (!(*smallest > 0))
    throw std::invalid_argument("levelled cells need sizes greater than 0");
  if (*largest <= 2 * *smallest) {
    levels_.push_back({*largest, {}, {}, CellList<dim>(positions, cell_size * *largest)});
    return;
  }
  // A level's sizes are (largest / 2, largest], those of the next one at most half of it.
  std::vector<Index> by_size(sizes.size());
  for (std::size_t i = 0; i < by_size.size(); ++i)
    by_size[i] = static_cast<Index>(i);
  const auto size_of = [&](Index i) { return sizes[static_cast<std::size_t>(i)]; };
  std::sort(by_size.begin(), by_size.end(), [&](Index i, Index j) { return size_of(i) > size_of(j); });
  for (auto begin = by_size.begin(); begin != by_size.end();) {
    const double most = size_of(*begin);
    const auto end = std::find_if(begin, by_size.end(), [&](Index i) { return size_of(i) <= 0.5 * most; });
    std::vector<Index> members(begin, end);
    std::sort(members.begin(), members.end());
    std::vector<Point<dim>> own;
    own.reserve(members.size());
    for (const Index i : members)
      own.push_back(positions[static_cast<std::size_t>(i)]);
    const std::span<const Point<dim>> view(own); // of the heap, which moves along
    levels_.push_back({most, std::move(members), std::move(own), CellList<dim>(view, cell_size * most)});
    begin = end;
  }
}

template <int dim>
void LevelledCells<dim>::append_within(const Point<dim> &centre, double radius, double factor,
                                       std::vector<Index> &result) const {
  for (const Level &level : levels_) {
    const std::size_t first = result.size();
    level.cells.append_within(centre, radius + factor * level.largest, result);
    if (!level.members.empty())
      for (std::size_t k = first; k < result.size(); ++k)
        result[k] = level.members[static_cast<std::size_t>(result[k])];
  }
}

template class LevelledCells<1>;
template class LevelledCells<2>;
template class LevelledCells<3>;

} // namespace meshless::cloud
