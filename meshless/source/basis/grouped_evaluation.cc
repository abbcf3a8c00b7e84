#include "meshless/basis/grouped_evaluation.h"

#include "meshless/linear_algebra/floating_point_traps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace meshless::basis {

namespace {

constexpr std::size_t largest_batch = 64;

template <int dim>
struct SortedCells {
  std::vector<std::array<std::int64_t, dim>> cell; ///< of every point
  std::vector<std::size_t> order;                  ///< points, those of a cell together
};

template <int dim>
SortedCells<dim> sort_into_cells(std::span<const cloud::Point<dim>> points, const cloud::Point<dim> &origin,
                                 double cell_size) {
  SortedCells<dim> sorted;
  sorted.cell.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int k = 0; k < dim; ++k) {
      const double c = std::floor((points[i][k] - origin[k]) / cell_size);
      sorted.cell[i][k] = static_cast<std::int64_t>(std::clamp(c, -9e15, 9e15));
    }
  sorted.order.resize(points.size());
  std::iota(sorted.order.begin(), sorted.order.end(), std::size_t{0});
  std::sort(sorted.order.begin(), sorted.order.end(), [&](std::size_t a, std::size_t b) {
    return sorted.cell[a] != sorted.cell[b] ? sorted.cell[a] < sorted.cell[b] : a < b;
  });
  return sorted;
}

} // namespace

template <int dim>
void GroupedEvaluation<dim>::visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted,
                                   const Visitor &visitor, const char *noun) const {
  const auto &particles = search_->particles();
  const auto h = particles.smoothing_lengths();
  const double mean = std::accumulate(h.begin(), h.end(), 0.0) / static_cast<double>(h.size());
  auto sorted = sort_into_cells<dim>(points, particles.position(0), 1.5 * mean);

  PointBatch<dim> batch;
  CandidateBatch<dim> candidate_batch;
  ShapeFunctionValues<dim> values;
  typename ShapeFunctions<dim>::Workspace workspace;
  std::vector<cloud::Index> candidates;
  std::vector<cloud::Point<dim>> members;
  cloud::Point<dim> centre{};
  const auto evaluate = [&](std::span<const std::size_t> group, std::span<const cloud::Index> taking_part) {
    members.clear();
    for (const std::size_t i : group)
      members.push_back(points[i]);
    batch.assign(std::span<const cloud::Point<dim>>(members));
    candidate_batch.assign(particles, taking_part, centre);
    const auto regularity = [&] {
      const linear_algebra::FloatingPointTraps traps;
      return basis_->evaluate(batch, candidate_batch, wanted, values, workspace);
    }();
    try {
      require_regular(regularity, batch, *basis_);
    } catch (const SingularMomentMatrix &error) {
      throw SingularMomentMatrix(fmt::format("{} {}: {}", noun, group[regularity.worst_point], error.what()));
    }
    visitor(Group{group, taking_part, values, regularity});
  };
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    while (end < points.size() && end - begin < largest_batch &&
           sorted.cell[sorted.order[end]] == sorted.cell[sorted.order[begin]])
      ++end;
    cloud::Point<dim> low = points[sorted.order[begin]];
    cloud::Point<dim> high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < dim; ++k) {
        low[k] = std::min(low[k], points[sorted.order[i]][k]);
        high[k] = std::max(high[k], points[sorted.order[i]][k]);
      }
    for (int k = 0; k < dim; ++k)
      centre[k] = 0.5 * (low[k] + high[k]);
    // Slack of rounding, so that the farthest point of the group is covered.
    const double radius = std::sqrt(cloud::distance_squared<dim>(centre, high)) + 1e-12 * mean;
    search_->collect(centre, radius, candidates);
    const auto group = std::span(sorted.order).subspan(begin, end - begin);
    if (filter_ && filter_->active(centre, radius, reach_of(candidates, centre)))
      evaluate_filtered(points, group, candidates, evaluate);
    else
      evaluate(group, candidates);
    begin = end;
  }
}

template <int dim>
double GroupedEvaluation<dim>::reach_of(std::span<const cloud::Index> candidates,
                                        const cloud::Point<dim> &centre) const {
  double squared = 0;
  for (const cloud::Index j : candidates)
    squared = std::max(
        squared, cloud::distance_squared<dim>(search_->particles().position(static_cast<std::size_t>(j)), centre));
  return std::sqrt(squared);
}

/// Points of the group that have the same candidates are evaluated together; `group` is put into that order.
template <int dim>
void GroupedEvaluation<dim>::evaluate_filtered(
    std::span<const cloud::Point<dim>> points, std::span<std::size_t> group, std::span<const cloud::Index> candidates,
    const std::function<void(std::span<const std::size_t>, std::span<const cloud::Index>)> &evaluate) const {
  std::vector<std::vector<cloud::Index>> lists;
  std::vector<std::pair<std::size_t, std::size_t>> list_of; // list and point
  for (const std::size_t i : group) {
    std::vector<cloud::Index> own(candidates.begin(), candidates.end());
    filter_->apply(points[i], own);
    const auto found = std::find(lists.begin(), lists.end(), own);
    list_of.emplace_back(found - lists.begin(), i);
    if (found == lists.end())
      lists.push_back(std::move(own));
  }
  std::sort(list_of.begin(), list_of.end());
  for (std::size_t k = 0; k < group.size(); ++k)
    group[k] = list_of[k].second;
  for (std::size_t begin = 0; begin < group.size();) {
    std::size_t end = begin + 1;
    while (end < group.size() && list_of[end].first == list_of[begin].first)
      ++end;
    evaluate(group.subspan(begin, end - begin), lists[list_of[begin].first]);
    begin = end;
  }
}

template class GroupedEvaluation<1>;
template class GroupedEvaluation<2>;
template class GroupedEvaluation<3>;

} // namespace meshless::basis
