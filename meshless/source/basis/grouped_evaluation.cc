#include "meshless/basis/grouped_evaluation.h"

#include "meshless/linear_algebra/floating_point_traps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace meshless::basis {

namespace {

constexpr std::size_t largest_batch = 32;
/// Points that a cell should hold: two packs fill the lanes and share one search.
constexpr double aimed_points = 16;
/// Largest half diagonal of a cell, in units of the mean h: farther points share too few neighbours, and a basis may
/// take monomials about one place for all of them (weighted_basis.cc).
constexpr double largest_reach = .99;

/// Bits of a cell's number along an axis, and of the place within the cell.
template <int dim>
constexpr int cell_bits = dim == 3 ? 15 : 21;
template <int dim>
constexpr int place_bits = dim == 3 ? 6 : 10;

/// The bits of x, dim - 1 zeros after each: a bit moves by its own number, in halves of halves.
template <int dim>
std::uint64_t spread_bits(std::uint64_t x) {
  if constexpr (dim == 2) {
    x = (x | x << 16) & 0x0000ffff0000ffff;
    x = (x | x << 8) & 0x00ff00ff00ff00ff;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
    x = (x | x << 2) & 0x3333333333333333;
    x = (x | x << 1) & 0x5555555555555555;
  } else if constexpr (dim == 3) {
    x = (x | x << 32) & 0x001f00000000ffff;
    x = (x | x << 16) & 0x001f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    x = (x | x << 2) & 0x1249249249249249;
  }
  return x;
}

/// Points along a Morton curve through square cells: those of a cell follow each other, and any few of them lie close
/// together.
template <int dim>
struct SortedPoints {
  std::vector<std::pair<std::uint64_t, std::size_t>> curve; ///< number on the curve, and the point
  double edge = 0;                                          ///< of a cell, m

  std::uint64_t cell(std::size_t place) const { return curve[place].first >> (dim * place_bits<dim>); }
};

/// Cells are numbered from the corner of the bounding box; beyond the last number they share it, and their points may
/// then be far from each other.
template <int dim>
SortedPoints<dim> sort_points(std::span<const cloud::Point<dim>> points, double mean_h) {
  cloud::Point<dim> low = points[0];
  cloud::Point<dim> high = points[0];
  for (const auto &x : points)
    for (int k = 0; k < dim; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  double volume = aimed_points / static_cast<double>(points.size()); // if they fill the box evenly
  for (int k = 0; k < dim; ++k)
    volume *= std::max(high[k] - low[k], 1e-3 * mean_h);
  SortedPoints<dim> sorted;
  sorted.edge =
      std::clamp(std::pow(volume, 1.0 / dim), .1 * mean_h, 2 * largest_reach / std::sqrt(double(dim)) * mean_h);
  const double per_edge = std::ldexp(1 / sorted.edge, place_bits<dim>);
  const double last = std::ldexp(1.0, cell_bits<dim> + place_bits<dim>) - 1;
  sorted.curve.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint64_t key = 0;
    for (int k = 0; k < dim; ++k)
      key |= spread_bits<dim>(static_cast<std::uint64_t>(std::min((points[i][k] - low[k]) * per_edge, last))) << k;
    sorted.curve[i] = {key, i};
  }
  std::sort(sorted.curve.begin(), sorted.curve.end());
  return sorted;
}

} // namespace

template <int dim>
void GroupedEvaluation<dim>::visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted,
                                   const Visitor &visitor, const char *noun) const {
  const auto &particles = search_->particles();
  if (points.empty())
    return;
  const auto h = particles.smoothing_lengths();
  const double mean = std::accumulate(h.begin(), h.end(), 0.0) / static_cast<double>(h.size());
  const auto sorted = sort_points<dim>(points, mean);
  const double diagonal_squared = dim * sorted.edge * sorted.edge * (1 + 1e-9);

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
  std::vector<std::size_t> group;
  for (std::size_t begin = 0; begin < points.size();) {
    cloud::Point<dim> low = points[sorted.curve[begin].second];
    cloud::Point<dim> high = low;
    group.clear();
    for (std::size_t place = begin; place < points.size() && group.size() < largest_batch; ++place) {
      const auto &x = points[sorted.curve[place].second];
      if (sorted.cell(place) != sorted.cell(begin) ||
          cloud::distance_squared<dim>(x, points[sorted.curve[begin].second]) > diagonal_squared)
        break;
      group.push_back(sorted.curve[place].second);
      for (int k = 0; k < dim; ++k) {
        low[k] = std::min(low[k], x[k]);
        high[k] = std::max(high[k], x[k]);
      }
    }
    for (int k = 0; k < dim; ++k)
      centre[k] = 0.5 * (low[k] + high[k]);
    // Slack of rounding, so that the farthest point of the group is covered.
    const double radius = std::sqrt(cloud::distance_squared<dim>(centre, high)) + 1e-12 * mean;
    search_->collect(centre, radius, candidates);
    begin += group.size();
    if (filter_ && filter_->active(centre, radius, reach_of(candidates, centre)))
      evaluate_filtered(points, group, candidates, evaluate);
    else
      evaluate(group, candidates);
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
