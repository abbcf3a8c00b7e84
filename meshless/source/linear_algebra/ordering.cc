#include "meshless/linear_algebra/ordering.h"

#include "names.h"

#include <suitesparse/cholmod.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace meshless::linear_algebra {

namespace {

using Index = std::uint32_t;

constexpr OrderingDescription table[] = {
    {Ordering::natural, "natural", "as the particles are numbered"},
    {Ordering::rcm, "rcm", "reverse Cuthill-McKee: a narrow band"},
    {Ordering::amd, "amd", "approximate minimum degree"},
    {Ordering::metis, "metis", "nested dissection by METIS"},
};

/// The groups that the rows of each group name, itself included, each once.
struct GroupPattern {
  std::vector<std::size_t> start;
  std::vector<Index> columns;

  /// @param group_of (column) -> group
  template <typename GroupOf>
  GroupPattern(const SparseRows &matrix, std::size_t group, const GroupOf &group_of) {
    const auto n = static_cast<std::size_t>(matrix.n_rows()) / group;
    constexpr auto none = std::numeric_limits<Index>::max();
    std::vector<Index> seen_by(n, none);
    start.reserve(n + 1);
    start.push_back(0);
    columns.reserve(static_cast<std::size_t>(matrix.nonzeros()) / (group * group));
    for (std::size_t i = 0; i < n; ++i) {
      for (auto k = static_cast<std::size_t>(matrix.offsets()[group * i]);
           k < static_cast<std::size_t>(matrix.offsets()[group * (i + 1)]); ++k)
        if (const Index j = group_of(matrix.columns()[k]); seen_by[j] != i) {
          seen_by[j] = static_cast<Index>(i);
          columns.push_back(j);
        }
      start.push_back(columns.size());
    }
  }
};

GroupPattern pattern_of(const SparseRows &matrix, std::size_t group) {
  if (group == 2) // of particles: a shift, where a division takes longer than all else
    return {matrix, group, [](std::int64_t column) { return static_cast<Index>(column >> 1); }};
  const auto divisor = static_cast<std::int64_t>(group);
  return {matrix, group, [divisor](std::int64_t column) { return static_cast<Index>(column / divisor); }};
}

/// Breadth first, from what the last search ended with: after two such searches that is a far end of the domain.
std::vector<Index> reverse_cuthill_mckee(const GroupPattern &pattern) {
  const std::size_t n = pattern.start.size() - 1;
  std::vector<Index> order;
  std::vector<char> seen;
  const auto search = [&](Index first) {
    order.clear();
    seen.assign(n, 0);
    std::size_t head = 0;
    for (std::size_t part = 0; order.size() < n; ++part) {
      Index root = first;
      if (part > 0)
        root = static_cast<Index>(std::find(seen.begin(), seen.end(), char{0}) - seen.begin());
      order.push_back(root);
      seen[root] = 1;
      for (; head < order.size(); ++head)
        for (std::size_t k = pattern.start[order[head]]; k < pattern.start[order[head] + std::size_t{1}]; ++k)
          if (const Index j = pattern.columns[k]; seen[j] == 0) {
            seen[j] = 1;
            order.push_back(j);
          }
    }
    return order.back();
  };
  Index end = 0;
  for (int k = 0; k < 3 && n > 0; ++k)
    end = search(end);
  std::reverse(order.begin(), order.end());
  return order;
}

/// The pattern of A + A^T between groups, its upper triangle by columns, rows increasing.
struct UpperPattern {
  std::vector<SuiteSparse_long> start;
  std::vector<SuiteSparse_long> rows;

  explicit UpperPattern(const GroupPattern &pattern) {
    const std::size_t n = pattern.start.size() - 1;
    std::vector<std::vector<Index>> of_column(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = pattern.start[i]; k < pattern.start[i + 1]; ++k)
        if (const std::size_t j = pattern.columns[k]; j != i)
          of_column[std::max(i, j)].push_back(static_cast<Index>(std::min(i, j)));
    start.push_back(0);
    for (auto &column : of_column) {
      std::sort(column.begin(), column.end());
      column.erase(std::unique(column.begin(), column.end()), column.end());
      rows.insert(rows.end(), column.begin(), column.end());
      start.push_back(static_cast<SuiteSparse_long>(rows.size()));
      std::vector<Index>().swap(column);
    }
  }
};

std::vector<Index> order_by_cholmod(const GroupPattern &groups, Ordering ordering) {
  UpperPattern pattern(groups);
  cholmod_sparse graph{};
  graph.nrow = graph.ncol = pattern.start.size() - 1;
  graph.nzmax = pattern.rows.size();
  graph.p = pattern.start.data();
  graph.i = pattern.rows.data();
  graph.stype = 1; // upper triangle of a symmetric matrix
  graph.itype = CHOLMOD_LONG;
  graph.xtype = CHOLMOD_PATTERN;
  graph.dtype = CHOLMOD_DOUBLE;
  graph.sorted = 1;
  graph.packed = 1;
  cholmod_common common;
  cholmod_l_start(&common);
  common.print = 0;
  std::vector<SuiteSparse_long> permutation(graph.nrow);
  constexpr int postorder = 1;
  const bool done = ordering == Ordering::amd
                        ? cholmod_l_amd(&graph, nullptr, 0, permutation.data(), &common) != 0
                        : cholmod_l_metis(&graph, nullptr, 0, postorder, permutation.data(), &common) != 0;
  const int status = common.status;
  cholmod_l_finish(&common);
  if (!done)
    throw std::runtime_error(
        fmt::format("the ordering {} of {} groups failed (CHOLMOD status {})", to_text(ordering), graph.nrow, status));
  return {permutation.begin(), permutation.end()};
}

} // namespace

std::span<const OrderingDescription> ordering_table() { return table; }

const char *to_text(Ordering ordering) {
  return entry_of(ordering_table(), &OrderingDescription::ordering, ordering).name;
}

Ordering ordering_of(std::string_view name) { return entry_named(ordering_table(), name, "ordering").ordering; }

std::vector<std::uint32_t> order_of(const SparseRows &matrix, Ordering ordering, std::size_t group) {
  if (matrix.n_rows() != matrix.n_columns() || group == 0 || static_cast<std::size_t>(matrix.n_rows()) % group != 0)
    throw std::invalid_argument(fmt::format("a matrix of {} rows and {} columns has no groups of {} unknowns to order",
                                            matrix.n_rows(), matrix.n_columns(), group));
  if (ordering == Ordering::rcm)
    return reverse_cuthill_mckee(pattern_of(matrix, group));
  if (ordering != Ordering::natural)
    return order_by_cholmod(pattern_of(matrix, group), ordering);
  std::vector<Index> order(static_cast<std::size_t>(matrix.n_rows()) / group);
  std::iota(order.begin(), order.end(), Index{0});
  return order;
}

} // namespace meshless::linear_algebra
