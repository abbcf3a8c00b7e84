#include "coarse_correction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshless::linear_algebra {

namespace {

/// Few enough particles that what is constant on them describes what the factors leave; with 8 the coarse system costs
/// as much as it saves, with 100 iterations double.
constexpr std::size_t aggregate_size = 25;
/// Neighbours of an aggregate's particle join it if their entries, of rows whose largest is 1, are not small.
constexpr double near_entry = 0.05;

} // namespace

CoarseCorrection::CoarseCorrection(const BlockRows &matrix, const IncompleteLu &factors)
    : factors_(factors), deflated_(2 * matrix.n_rows()) {
  aggregate(matrix);
  set_products(matrix);
  coarse_residual_.resize(2 * n_aggregates_);
  coarse_solution_.resize(2 * n_aggregates_);
  try {
    coarse_lu_.emplace(*coarse_);
  } catch (const SolveError &) {
    coarse_lu_.reset();
  }
}

/// Breadth first from each particle without aggregate; what stays too small joins a neighbour.
void CoarseCorrection::aggregate(const BlockRows &matrix) {
  constexpr Index none = std::numeric_limits<Index>::max();
  const std::size_t n = matrix.n_rows();
  aggregate_of_.assign(n, none);
  std::vector<Index> members;
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (aggregate_of_[seed] != none)
      continue;
    const auto own = static_cast<Index>(n_aggregates_);
    members.assign(1, static_cast<Index>(seed));
    aggregate_of_[seed] = own;
    for (std::size_t head = 0; head < members.size() && members.size() < aggregate_size; ++head)
      for (std::size_t k = matrix.start[members[head]];
           k < matrix.start[members[head] + 1] && members.size() < aggregate_size; ++k)
        if (const Index j = matrix.columns[k]; aggregate_of_[j] == none && size_of(matrix.blocks[k]) > near_entry) {
          aggregate_of_[j] = own;
          members.push_back(j);
        }
    Index host = none;
    if (members.size() < aggregate_size / 4)
      for (const Index i : members)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1] && host == none; ++k)
          if (const Index other = aggregate_of_[matrix.columns[k]]; other != none && other != own)
            host = other;
    if (host == none)
      ++n_aggregates_;
    else
      for (const Index i : members)
        aggregate_of_[i] = host;
  }
}

void CoarseCorrection::set_products(const BlockRows &matrix) {
  const std::size_t n = matrix.n_rows();
  std::vector<BlockRows::Block> sums(n_aggregates_);
  std::vector<char> used(n_aggregates_, 0);
  std::vector<Index> found;
  start_.assign(1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    found.clear();
    for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
      const Index a = aggregate_of_[matrix.columns[k]];
      if (used[a] == 0) {
        used[a] = 1;
        sums[a] = {};
        found.push_back(a);
      }
      for (std::size_t e = 0; e < 4; ++e)
        sums[a][e] += matrix.blocks[k][e];
    }
    for (const Index a : found) {
      columns_.push_back(a);
      blocks_.push_back(sums[a]);
      used[a] = 0;
    }
    start_.push_back(columns_.size());
  }

  // E, row by row: the rows of A Z of an aggregate's particles, summed.
  std::vector<std::size_t> begin(n_aggregates_ + 1, 0);
  for (const Index a : aggregate_of_)
    ++begin[a + 1];
  for (std::size_t a = 0; a < n_aggregates_; ++a)
    begin[a + 1] += begin[a];
  std::vector<Index> members(n);
  auto next = begin;
  for (std::size_t i = 0; i < n; ++i)
    members[next[aggregate_of_[i]]++] = static_cast<Index>(i);
  coarse_.emplace(2 * static_cast<std::int64_t>(n_aggregates_));
  std::vector<std::int64_t> columns;
  std::vector<double> values;
  for (std::size_t a = 0; a < n_aggregates_; ++a) {
    found.clear();
    for (std::size_t m = begin[a]; m < begin[a + 1]; ++m)
      for (std::size_t k = start_[members[m]]; k < start_[members[m] + 1]; ++k) {
        const Index column = columns_[k];
        if (used[column] == 0) {
          used[column] = 1;
          sums[column] = {};
          found.push_back(column);
        }
        for (std::size_t e = 0; e < 4; ++e)
          sums[column][e] += blocks_[k][e];
      }
    std::sort(found.begin(), found.end());
    for (std::size_t d = 0; d < 2; ++d) {
      columns.clear();
      values.clear();
      for (const Index column : found)
        for (std::size_t e = 0; e < 2; ++e) {
          columns.push_back(2 * std::int64_t{column} + static_cast<std::int64_t>(e));
          values.push_back(sums[column][2 * d + e]);
        }
      coarse_->append_row(columns, values);
    }
    for (const Index column : found)
      used[column] = 0;
  }
}

std::size_t CoarseCorrection::bytes() const {
  return columns_.size() * (sizeof(Index) + sizeof(BlockRows::Block)) + start_.size() * sizeof(std::size_t) +
         (coarse_lu_ ? coarse_lu_->bytes() : 0);
}

void CoarseCorrection::apply(std::span<const double> r, std::span<double> x) {
  if (!coarse_lu_) {
    factors_.solve(r, x);
    return;
  }
  std::fill(coarse_residual_.begin(), coarse_residual_.end(), 0.0);
  for (std::size_t i = 0; i < aggregate_of_.size(); ++i)
    for (std::size_t d = 0; d < 2; ++d)
      coarse_residual_[2 * std::size_t{aggregate_of_[i]} + d] += r[2 * i + d];
  coarse_lu_->solve(coarse_residual_, coarse_solution_, SparseLu::Refinement::none);
  for (std::size_t i = 0; i < aggregate_of_.size(); ++i) {
    double sum_1 = r[2 * i];
    double sum_2 = r[2 * i + 1];
    for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
      const auto &a = blocks_[k];
      const double y1 = coarse_solution_[2 * std::size_t{columns_[k]}];
      const double y2 = coarse_solution_[2 * std::size_t{columns_[k]} + 1];
      sum_1 -= a[0] * y1 + a[1] * y2;
      sum_2 -= a[2] * y1 + a[3] * y2;
    }
    deflated_[2 * i] = sum_1;
    deflated_[2 * i + 1] = sum_2;
  }
  factors_.solve(deflated_, x);
  for (std::size_t i = 0; i < aggregate_of_.size(); ++i)
    for (std::size_t d = 0; d < 2; ++d)
      x[2 * i + d] += coarse_solution_[2 * std::size_t{aggregate_of_[i]} + d];
}

} // namespace meshless::linear_algebra
