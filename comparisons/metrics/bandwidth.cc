#include "comparisons/metrics/bandwidth.h"

#include <algorithm>
#include <vector>

namespace comparisons::metrics {

namespace {

using Index = std::size_t;
using Graph = std::vector<std::vector<Index>>;

Graph symmetric_graph(std::span<const std::int64_t> row_start, std::span<const std::int64_t> columns) {
  Graph graph(row_start.empty() ? 0 : row_start.size() - 1);
  for (Index i = 0; i < graph.size(); ++i)
    for (auto k = static_cast<Index>(row_start[i]); k < static_cast<Index>(row_start[i + 1]); ++k) {
      const auto j = static_cast<Index>(columns[k]);
      if (i == j)
        continue;
      graph[i].push_back(j);
      graph[j].push_back(i);
    }
  for (auto &neighbours : graph) {
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  }
  return graph;
}

/// Nodes in the order in which a breadth-first search meets them, neighbours by degree, and how many levels it has.
std::vector<Index> search_from(const Graph &graph, Index start, Index &n_levels) {
  std::vector<Index> order{start};
  std::vector<char> seen(graph.size(), 0);
  seen[start] = 1;
  n_levels = 0;
  for (Index begin = 0; begin < order.size(); ++n_levels) {
    const Index end = order.size();
    for (; begin < end; ++begin) {
      const Index first = order.size();
      for (const Index j : graph[order[begin]])
        if (seen[j] == 0) {
          seen[j] = 1;
          order.push_back(j);
        }
      std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.end(),
                       [&](Index a, Index b) { return graph[a].size() < graph[b].size(); });
    }
  }
  return order;
}

/// Of the part of the graph that `start` belongs to.
std::vector<Index> cuthill_mckee(const Graph &graph, Index start) {
  Index n_levels = 0;
  auto order = search_from(graph, start, n_levels);
  for (;;) { // towards a node from which the search has most levels
    Index more_levels = 0;
    auto next = search_from(graph, order.back(), more_levels);
    if (more_levels <= n_levels)
      return order;
    order = std::move(next);
    n_levels = more_levels;
  }
}

} // namespace

std::int64_t half_bandwidth(std::span<const std::int64_t> row_start, std::span<const std::int64_t> columns) {
  const Graph graph = symmetric_graph(row_start, columns);
  constexpr auto unnumbered = static_cast<Index>(-1);
  std::vector<Index> number(graph.size(), unnumbered);
  Index n = 0;
  for (Index i = 0; i < graph.size(); ++i)
    if (number[i] == unnumbered)
      for (const Index j : cuthill_mckee(graph, i))
        number[j] = n++;
  std::int64_t widest = 0;
  for (Index i = 0; i < graph.size(); ++i)
    for (const Index j : graph[i])
      widest = std::max(widest, static_cast<std::int64_t>(number[i]) - static_cast<std::int64_t>(number[j]));
  return widest;
}

} // namespace comparisons::metrics
