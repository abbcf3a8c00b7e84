#include "meshless/basis/grouped_evaluation.h"

#include "meshless/cloud/neighbour_collector.h"
#include "meshless/linear_algebra/floating_point_traps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

namespace meshless::basis {

namespace {

constexpr std::size_t largest_batch = 32;
/// Points that a cell should hold: two packs fill the lanes and share one search.
constexpr double aimed_points = 16;
/// Points to a cell below which each has neighbours of its own.
constexpr std::size_t densest_own = 12;
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

/// One visit of all points: what it needs, kept from batch to batch.
template <int dim>
class GroupedEvaluation<dim>::Visit {
public:
  Visit(const GroupedEvaluation &evaluation, std::span<const cloud::Point<dim>> points, const Wanted &wanted,
        const Visitor &visitor, const char *noun)
      : basis_(*evaluation.basis_), search_(*evaluation.search_), filter_(evaluation.filter_), points_(points),
        wanted_(wanted), visitor_(visitor), noun_(noun), collector_(search_) {}

  void run() {
    const auto h = search_.particles().smoothing_lengths();
    mean_h_ = std::accumulate(h.begin(), h.end(), 0.0) / static_cast<double>(h.size());
    const auto sorted = sort_points<dim>(points_, mean_h_);
    if (getenv("OWN") ? atoi(getenv("OWN")) : sparse(sorted))
      visit_sparse(sorted);
    else
      visit_dense(sorted);
  }

private:
  using Sorted = SortedPoints<dim>;

  static bool sparse(const Sorted &sorted) {
    std::size_t n_cells = 1;
    for (std::size_t place = 1; place < sorted.curve.size(); ++place)
      n_cells += sorted.cell(place) != sorted.cell(place - 1);
    return sorted.curve.size() < densest_own * n_cells;
  }

  /// The box of the points of the group.
  struct Box {
    cloud::Point<dim> low;
    cloud::Point<dim> high;

    explicit Box(const cloud::Point<dim> &x) : low(x), high(x) {}
    void add(const cloud::Point<dim> &x) {
      for (int k = 0; k < dim; ++k) {
        low[k] = std::min(low[k], x[k]);
        high[k] = std::max(high[k], x[k]);
      }
    }
    double diagonal_squared() const { return cloud::distance_squared<dim>(low, high); }
    cloud::Point<dim> centre() const {
      cloud::Point<dim> x;
      for (int k = 0; k < dim; ++k)
        x[k] = 0.5 * (low[k] + high[k]);
      return x;
    }
  };

  /// Points of a cell share their candidates, unless a filter is to tell them apart.
  void visit_dense(const Sorted &sorted) {
    const double diagonal_squared = dim * sorted.edge * sorted.edge * (1 + 1e-9);
    const auto point = [&](std::size_t place) { return points_[sorted.curve[place].second]; };
    for (std::size_t begin = 0; begin < points_.size(); begin += group_.size()) {
      Box box(point(begin));
      group_.clear();
      for (std::size_t place = begin; place < points_.size() && group_.size() < largest_batch; ++place) {
        if (sorted.cell(place) != sorted.cell(begin) ||
            cloud::distance_squared<dim>(point(place), point(begin)) > diagonal_squared)
          break;
        group_.push_back(sorted.curve[place].second);
        box.add(point(place));
      }
      // Slack of rounding, so that the farthest point of the group is covered.
      const double radius = 0.5 * std::sqrt(box.diagonal_squared()) + 1e-12 * mean_h_;
      search_.collect(box.centre(), radius, candidates_);
      if (filter_ && filter_->active(box.centre(), radius, reach_of(candidates_, box.centre())))
        evaluate_own(true);
      else
        evaluate_shared(box.centre());
    }
  }

  void visit_sparse(const Sorted &sorted) {
    static const double C = getenv("DIAG") ? atof(getenv("DIAG")) : 3;
    static const std::size_t B = getenv("BATCH") ? atoi(getenv("BATCH")) : 32;
    const double reach = search_.support() * mean_h_;
    const double diagonal_squared = C * reach * C * reach;
    const auto point = [&](std::size_t place) { return points_[sorted.curve[place].second]; };
    for (std::size_t begin = 0; begin < points_.size(); begin += group_.size()) {
      Box box(point(begin));
      group_.clear();
      for (std::size_t place = begin; place < points_.size() && group_.size() < B; ++place) {
        Box larger = box;
        larger.add(point(place));
        if (larger.diagonal_squared() > diagonal_squared)
          break;
        group_.push_back(sorted.curve[place].second);
        box = larger;
      }
      if (begin + group_.size() < points_.size() && group_.size() > linear_algebra::n_lanes)
        group_.resize(group_.size() / linear_algebra::n_lanes * linear_algebra::n_lanes);
      const double radius = 0.5 * std::sqrt(box.diagonal_squared()) + 1e-12 * mean_h_;
      evaluate_own(filter_ &&
                   filter_->active(box.centre(), radius,
                                   radius + search_.support() * search_.particles().largest_smoothing_length()));
    }
  }

  double reach_of(std::span<const cloud::Index> candidates, const cloud::Point<dim> &centre) const {
    double squared = 0;
    for (const cloud::Index j : candidates)
      squared = std::max(
          squared, cloud::distance_squared<dim>(search_.particles().position(static_cast<std::size_t>(j)), centre));
    return std::sqrt(squared);
  }

  void evaluate_shared(const cloud::Point<dim> &centre) {
    assign_members();
    batch_.assign(std::span<const cloud::Point<dim>>(members_));
    candidate_batch_.assign(search_.particles(), candidates_, centre);
    const auto regularity = [&] {
      const linear_algebra::FloatingPointTraps traps;
      return basis_.evaluate(batch_, candidate_batch_, wanted_, values_, workspace_);
    }();
    require(regularity, batch_, group_);
    visitor_(Group(group_, candidates_, values_, regularity));
  }

  /// Packs of the group with neighbours of their own.
  void evaluate_own(bool filtered) {
    assign_members();
    collector_.collect(members_);
    lists_.clear();
    for (std::size_t i = 0; i < members_.size(); ++i)
      lists_.push_back(collector_[i]);
    if (filtered)
      filter_lists();
    for (std::size_t begin = 0; begin < group_.size(); begin += linear_algebra::n_lanes) {
      const std::size_t n = std::min<std::size_t>(linear_algebra::n_lanes, group_.size() - begin);
      const auto points = std::span<const std::size_t>(group_).subspan(begin, n);
      pack_.assign(search_.particles(), std::span(members_).subspan(begin, n), std::span(lists_).subspan(begin, n));
      const auto regularity = [&] {
        const linear_algebra::FloatingPointTraps traps;
        return basis_.evaluate_own(pack_, wanted_, values_, workspace_);
      }();
      require(regularity, pack_, points);
      visitor_(Group(points, pack_, values_, regularity));
    }
  }

  void filter_lists() {
    filtered_.resize(std::max(filtered_.size(), lists_.size()));
    for (std::size_t i = 0; i < lists_.size(); ++i) {
      filtered_[i].assign(lists_[i].begin(), lists_[i].end());
      filter_->apply(members_[i], filtered_[i]);
      lists_[i] = filtered_[i];
    }
  }

  void assign_members() {
    members_.clear();
    for (const std::size_t i : group_)
      members_.push_back(points_[i]);
  }

  template <typename Points>
  void require(const Regularity &regularity, const Points &points, std::span<const std::size_t> indices) const {
    try {
      require_regular(regularity, points, basis_);
    } catch (const SingularMomentMatrix &error) {
      throw SingularMomentMatrix(fmt::format("{} {}: {}", noun_, indices[regularity.worst_point], error.what()));
    }
  }

  const ShapeFunctions<dim> &basis_;
  const cloud::CandidateSearch<dim> &search_;
  CandidateFilter<dim> *filter_;
  std::span<const cloud::Point<dim>> points_;
  const Wanted &wanted_;
  const Visitor &visitor_;
  const char *noun_;
  double mean_h_ = 0;

  std::vector<std::size_t> group_;
  std::vector<cloud::Point<dim>> members_;
  std::vector<cloud::Index> candidates_;
  PointBatch<dim> batch_;
  CandidateBatch<dim> candidate_batch_;
  cloud::NeighbourCollector<dim> collector_;
  std::vector<std::span<const cloud::Index>> lists_;
  std::vector<std::vector<cloud::Index>> filtered_;
  NeighbourPack<dim> pack_;
  ShapeFunctionValues<dim> values_;
  typename ShapeFunctions<dim>::Workspace workspace_;
};

template <int dim>
void GroupedEvaluation<dim>::visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted,
                                   const Visitor &visitor, const char *noun) const {
  if (!points.empty())
    Visit(*this, points, wanted, visitor, noun).run();
}

template class GroupedEvaluation<1>;
template class GroupedEvaluation<2>;
template class GroupedEvaluation<3>;

} // namespace meshless::basis
