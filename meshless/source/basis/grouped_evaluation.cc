#include "meshless/basis/grouped_evaluation.h"

#include "meshless/cloud/neighbour_collector.h"
#include "meshless/cloud/radix_sort.h"
#include "meshless/linear_algebra/floating_point_traps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace meshless::basis {

namespace {

constexpr std::size_t n_lanes = linear_algebra::n_lanes;
/// Points whose neighbours are found together, and the largest diagonal of their box in units of the support's radius:
/// searches become fewer, and candidates that are looked at in vain more.
constexpr std::size_t batch_size = 32;
constexpr double largest_box = 2.5;
/// Bits of a place along an axis.
template <int dim>
constexpr int most_bits = dim == 3 ? 20 : 31;

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

/// The points along a Morton curve: any few of them that follow each other lie close together.
template <int dim>
std::vector<std::size_t> sort_points(std::span<const cloud::Point<dim>> points, double mean_h) {
  cloud::Point<dim> low = points[0];
  cloud::Point<dim> high = points[0];
  for (const auto &x : points)
    for (int k = 0; k < dim; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  double extent = 0;
  for (int k = 0; k < dim; ++k)
    extent = std::max(extent, high[k] - low[k]);
  // Finer than the distance of the points if they lie evenly, and than that of particles; more would cost time to sort.
  const double wanted = std::max(4 * std::pow(static_cast<double>(points.size()), 1.0 / dim), 2 * extent / mean_h);
  const double last = std::min(wanted, std::ldexp(1.0, most_bits<dim>) - 1);
  const double per_extent = extent > 0 ? last / extent : 0;
  struct Place {
    std::uint64_t number;
    std::size_t point;
  };
  std::vector<Place> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint64_t number = 0;
    for (int k = 0; k < dim; ++k)
      number |= spread_bits<dim>(static_cast<std::uint64_t>((points[i][k] - low[k]) * per_extent)) << k;
    places[i] = {number, i};
  }
  std::vector<Place> scratch(points.size());
  cloud::radix_sort(std::span(places), std::span(scratch), [](const Place &place) { return place.number; });
  std::vector<std::size_t> order;
  order.reserve(points.size());
  for (const auto &place : places)
    order.push_back(place.point);
  return order;
}

/// Some points that follow each other on the curve, and their neighbours.
template <int dim>
class Batch {
public:
  Batch(const cloud::CandidateSearch<dim> &search, CandidateFilter<dim> *filter, double mean_h)
      : filter_(filter), reach_(search.support() * search.particles().largest_smoothing_length()),
        largest_diagonal_(largest_box * search.support() * mean_h), collector_(search) {}

  void assign(std::span<const cloud::Point<dim>> points, std::span<const std::size_t> members) {
    points_.clear();
    for (const std::size_t i : members)
      points_.push_back(points[i]);
    collector_.clear();
    to_filter_.assign(points_.size(), false);
    for (std::size_t begin = 0; begin < points_.size();)
      begin += append_box(begin);
    lists_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i)
      lists_.push_back(collector_[i]);
    if (filter_)
      apply_filter();
  }

  std::span<const cloud::Point<dim>> points() const { return points_; }
  std::span<const std::span<const cloud::Index>> lists() const { return lists_; }

private:
  /// Neighbours of the points from `begin` on that lie in one box.
  /// @returns how many they are
  std::size_t append_box(std::size_t begin) {
    cloud::Point<dim> low = points_[begin];
    cloud::Point<dim> high = low;
    std::size_t end = begin + 1;
    for (; end < points_.size(); ++end) {
      auto lower = low;
      auto higher = high;
      for (int k = 0; k < dim; ++k) {
        lower[k] = std::min(low[k], points_[end][k]);
        higher[k] = std::max(high[k], points_[end][k]);
      }
      if (cloud::distance_squared<dim>(lower, higher) > largest_diagonal_ * largest_diagonal_)
        break;
      low = lower;
      high = higher;
    }
    collector_.append(std::span(points_).subspan(begin, end - begin));
    if (filter_) {
      cloud::Point<dim> centre;
      for (int k = 0; k < dim; ++k)
        centre[k] = 0.5 * (low[k] + high[k]);
      const double radius = std::sqrt(cloud::distance_squared<dim>(centre, high));
      if (filter_->active(centre, radius, radius + reach_))
        std::fill_n(to_filter_.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, true);
    }
    return end - begin;
  }

  void apply_filter() {
    filtered_.resize(std::max(filtered_.size(), points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (to_filter_[i]) {
        filtered_[i].assign(lists_[i].begin(), lists_[i].end());
        filter_->apply(points_[i], filtered_[i]);
        lists_[i] = filtered_[i];
      }
  }

  CandidateFilter<dim> *filter_;
  double reach_;            ///< of the largest support, m
  double largest_diagonal_; ///< of a box, m
  cloud::NeighbourCollector<dim> collector_;
  std::vector<cloud::Point<dim>> points_;
  std::vector<std::span<const cloud::Index>> lists_;
  std::vector<bool> to_filter_;
  std::vector<std::vector<cloud::Index>> filtered_;
};

} // namespace

template <int dim>
GroupedEvaluation<dim>::GroupedEvaluation(const ShapeFunctions<dim> &basis, const cloud::CandidateSearch<dim> &search,
                                          CandidateFilter<dim> *filter)
    : basis_(&basis), search_(&search), filter_(filter) {
  const auto h = search.particles().smoothing_lengths();
  mean_h_ = std::accumulate(h.begin(), h.end(), 0.0) / static_cast<double>(h.size());
}

template <int dim>
void GroupedEvaluation<dim>::visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted,
                                   const Visitor &visitor, const char *noun,
                                   std::span<const std::size_t> numbers) const {
  if (points.empty())
    return;
  const auto order = sort_points<dim>(points, mean_h_);
  Batch<dim> batch(*search_, filter_, mean_h_);
  NeighbourPack<dim> pack;
  ShapeFunctionValues<dim> values;
  typename ShapeFunctions<dim>::Workspace workspace;
  for (std::size_t first = 0; first < order.size(); first += batch_size) {
    const auto members = std::span(order).subspan(first, std::min(batch_size, order.size() - first));
    batch.assign(points, members);
    for (std::size_t begin = 0; begin < members.size(); begin += n_lanes) {
      const std::size_t n = std::min(n_lanes, members.size() - begin);
      const auto own = members.subspan(begin, n);
      pack.assign(search_->particles(), batch.points().subspan(begin, n), batch.lists().subspan(begin, n));
      const auto regularity = [&] {
        const linear_algebra::FloatingPointTraps traps;
        return basis_->evaluate_own(pack, wanted, values, workspace);
      }();
      try {
        require_regular(regularity, pack, *basis_);
      } catch (const SingularMomentMatrix &error) {
        const std::size_t worst = own[regularity.worst_point];
        throw SingularMomentMatrix(
            fmt::format("{} {}: {}", noun, numbers.empty() ? worst : numbers[worst], error.what()));
      }
      visitor(Group(own, pack, values, regularity));
    }
  }
}

template class GroupedEvaluation<1>;
template class GroupedEvaluation<2>;
template class GroupedEvaluation<3>;

} // namespace meshless::basis
