#include "quadrilateral_coarsening.h"

#include <algorithm>
#include <array>
#include <limits>

namespace fem_reference::multigrid {
namespace {
using elasticity::Discretisation;
using elasticity::ReferenceElement;

constexpr unsigned none = std::numeric_limits<unsigned>::max();
/// The corners of a cell of degree 1, which are numbered lexicographically, counter-clockwise.
constexpr std::array<unsigned, 4> counter_clockwise{0, 1, 3, 2};

Discretisation empty_copy(const Discretisation &fine, int degree) {
  Discretisation coarse(degree);
  coarse.origin = fine.origin;
  coarse.extent = fine.extent;
  return coarse;
}

void add_cell(Discretisation &space, std::span<const unsigned> nodes, int region) {
  if (space.cell_start.empty())
    space.cell_start.push_back(0);
  space.cell_nodes.insert(space.cell_nodes.end(), nodes.begin(), nodes.end());
  space.cell_start.push_back(static_cast<unsigned>(space.cell_nodes.size()));
  space.n_vertices.push_back(4);
  space.curved.push_back(0);
  space.regions.push_back(region);
  ++space.n_cells;
}

/// Weights of the nodes of `coarse` at the nodes of `fine`, row by row.
std::vector<double> interpolation(const ReferenceElement &coarse, const ReferenceElement &fine) {
  std::vector<double> result;
  ReferenceElement::Values values, slope_1, slope_2;
  for (const auto &xi : fine.nodes()) {
    coarse.evaluate(xi, values, slope_1, slope_2);
    result.insert(result.end(), values.begin(), values.begin() + coarse.n_nodes());
  }
  return result;
}

/// Vertices in two classes such that an edge, or a diagonal between vertices of `within`, joins both.
class TwoColouring {
public:
  explicit TwoColouring(std::size_t n_vertices) : colours_(n_vertices, unset) {}

  /// Colours what is connected by `pairs`; false if there is an odd cycle, or more than one part.
  bool run(std::span<const std::array<unsigned, 2>> pairs);
  bool is(unsigned vertex, char colour) const { return colours_[vertex] == colour; }

private:
  static constexpr char unset = -1;
  std::vector<char> colours_;
};

bool TwoColouring::run(std::span<const std::array<unsigned, 2>> pairs) {
  std::vector<unsigned> start(colours_.size() + 1, 0);
  for (const auto &pair : pairs)
    for (const unsigned v : pair)
      ++start[v + 1];
  for (std::size_t v = 0; v < colours_.size(); ++v)
    start[v + 1] += start[v];
  std::vector<unsigned> neighbours(2 * pairs.size());
  auto next = start;
  for (const auto &[a, b] : pairs) {
    neighbours[next[a]++] = b;
    neighbours[next[b]++] = a;
  }
  std::vector<unsigned> queue{pairs.front()[0]};
  colours_[queue.front()] = 0;
  std::size_t n_ends = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const unsigned v = queue[head];
    n_ends += start[v + 1] - start[v];
    for (unsigned k = start[v]; k < start[v + 1]; ++k) {
      const unsigned w = neighbours[k];
      if (colours_[w] == unset) {
        colours_[w] = static_cast<char>(1 - colours_[v]);
        queue.push_back(w);
      } else if (colours_[w] == colours_[v])
        return false;
    }
  }
  return n_ends == 2 * pairs.size();
}

/// The cells around each vertex.
class CellsAround {
public:
  explicit CellsAround(const Discretisation &mesh) : start_(mesh.n_nodes() + 1, 0), cells_(mesh.cell_nodes.size()) {
    for (const unsigned v : mesh.cell_nodes)
      ++start_[v + 1];
    for (std::size_t v = 0; v < mesh.n_nodes(); ++v)
      start_[v + 1] += start_[v];
    auto next = start_;
    for (unsigned c = 0; c < mesh.n_cells; ++c)
      for (const unsigned v : mesh.nodes_of(c))
        cells_[next[v]++] = c;
  }

  std::span<const unsigned> of(unsigned vertex) const {
    return {cells_.data() + start_[vertex], start_[vertex + 1] - start_[vertex]};
  }

private:
  std::vector<unsigned> start_;
  std::vector<unsigned> cells_;
};

/// One way to read both colourings: tries to put the cells together again.
class Reading {
public:
  Reading(const Discretisation &fine, const CellsAround &cells, const TwoColouring &vertices,
          const TwoColouring &diagonals, char middles_of_edges, char middles_of_cells)
      : fine_(fine), cells_(cells), vertices_(vertices), diagonals_(diagonals), edge_(middles_of_edges),
        cell_(middles_of_cells), ends_(fine.n_nodes(), {none, none}),
        corners_(fine.n_nodes(), {none, none, none, none}), coarse_index_(fine.n_nodes(), none) {}

  /// False if this reading fits no coarser mesh.
  bool run();
  Coarsening result();

private:
  bool is_middle_of_edge(unsigned v) const { return vertices_.is(v, edge_); }
  bool is_middle_of_cell(unsigned v) const { return !is_middle_of_edge(v) && diagonals_.is(v, cell_); }
  bool join_around(unsigned middle);
  bool set_ends(unsigned middle, unsigned first, unsigned second);

  const Discretisation &fine_;
  const CellsAround &cells_;
  const TwoColouring &vertices_;
  const TwoColouring &diagonals_;
  char edge_;
  char cell_;
  std::vector<std::array<unsigned, 2>> ends_;    ///< of a middle of an edge
  std::vector<std::array<unsigned, 4>> corners_; ///< of a middle of a cell, counter-clockwise
  std::vector<unsigned> coarse_index_;           ///< of an old vertex
  std::vector<std::array<unsigned, 4>> coarse_cells_;
  std::vector<int> regions_;
};

bool Reading::set_ends(unsigned middle, unsigned first, unsigned second) {
  auto &ends = ends_[middle];
  if (ends[0] == none) {
    ends = {first, second};
    return true;
  }
  return (ends[0] == first && ends[1] == second) || (ends[0] == second && ends[1] == first);
}

/// The four cells around the middle of a cell, put in a row counter-clockwise: the corner of each that lies opposite is
/// a corner of the coarse cell, and the vertex after it the middle of the edge to the next.
bool Reading::join_around(unsigned middle) {
  const auto cells = cells_.of(middle);
  if (cells.size() != 4)
    return false;
  std::array<unsigned, 4> corner{};
  std::array<unsigned, 4> after{};  // middle of the edge that begins at the corner
  std::array<unsigned, 4> before{}; // of the one that ends there
  for (unsigned k = 0; k < 4; ++k) {
    const auto nodes = fine_.nodes_of(cells[k]);
    unsigned position = 0;
    while (nodes[counter_clockwise[position]] != middle)
      ++position;
    const auto at = [&](unsigned turn) { return nodes[counter_clockwise[(position + turn) % 4]]; };
    before[k] = at(1);
    corner[k] = at(2);
    after[k] = at(3);
    if (fine_.regions[cells[k]] != fine_.regions[cells[0]])
      return false;
  }
  std::array<unsigned, 4> row{};
  for (unsigned k = 0, child = 0; k < 4; ++k) {
    row[k] = corner[child];
    const auto next = static_cast<unsigned>(std::find(before.begin(), before.end(), after[child]) - before.begin());
    if (next == 4)
      return false;
    if (!set_ends(after[child], corner[child], corner[next]))
      return false;
    child = next;
    if (k < 3 ? child == 0 : child != 0)
      return false;
  }
  corners_[middle] = row;
  coarse_cells_.push_back(row);
  regions_.push_back(fine_.regions[cells[0]]);
  return true;
}

bool Reading::run() {
  for (std::size_t c = 0; c < fine_.n_cells; ++c)
    for (const unsigned v : fine_.nodes_of(c))
      if (is_middle_of_cell(v) && corners_[v][0] == none && !join_around(v))
        return false;
  // A vertex between four coarse cells need not be the middle of an edge: it is one only if its ends agreed.
  for (unsigned v = 0; v < fine_.n_nodes(); ++v)
    if (is_middle_of_edge(v) && (ends_[v][0] == none || cells_.of(v).size() > 4))
      return false;
  return 4 * coarse_cells_.size() == fine_.n_cells;
}

bool positive_at_corners(const Discretisation &space, const std::array<unsigned, 4> &corners) {
  for (unsigned k = 0; k < 4; ++k) {
    const auto &a = space.positions[corners[k]];
    const auto &b = space.positions[corners[(k + 1) % 4]];
    const auto &c = space.positions[corners[(k + 3) % 4]];
    if (!((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0))
      return false;
  }
  return true;
}

Coarsening Reading::result() {
  Coarsening result{empty_copy(fine_, 1), {}};
  auto &coarse = result.space;
  for (unsigned v = 0; v < fine_.n_nodes(); ++v)
    if (!is_middle_of_edge(v) && !is_middle_of_cell(v)) {
      coarse_index_[v] = static_cast<unsigned>(coarse.positions.size());
      coarse.positions.push_back(fine_.positions[v]);
    }
  for (std::size_t c = 0; c < coarse_cells_.size(); ++c) {
    std::array<unsigned, 4> nodes{};
    for (unsigned k = 0; k < 4; ++k)
      nodes[counter_clockwise[k]] = coarse_index_[coarse_cells_[c][k]];
    add_cell(coarse, nodes, regions_[c]);
  }
  result.transfer.reserve(fine_.n_nodes(), 9 * coarse.n_nodes());
  for (unsigned v = 0; v < fine_.n_nodes(); ++v) {
    if (is_middle_of_edge(v))
      for (const unsigned end : ends_[v])
        result.transfer.add(coarse_index_[end], .5);
    else if (is_middle_of_cell(v))
      for (const unsigned corner : corners_[v])
        result.transfer.add(coarse_index_[corner], .25);
    else
      result.transfer.add(coarse_index_[v], 1);
    result.transfer.end_of_node();
  }
  return result;
}
} // namespace

Coarsening coarsen_degree(const Discretisation &fine) {
  const int p = fine.degree();
  const int q = p % 2 == 0 ? p / 2 : 1;
  const auto stride = static_cast<unsigned>(p / q);
  const auto n_fine = static_cast<unsigned>(p + 1);
  const auto n_coarse = static_cast<unsigned>(q + 1);
  Coarsening result{empty_copy(fine, q), {}};
  auto &coarse = result.space;

  std::vector<unsigned> coarse_index(fine.n_nodes(), none);
  std::vector<unsigned> nodes(std::size_t{n_coarse} * n_coarse);
  for (std::size_t c = 0; c < fine.n_cells; ++c) {
    const auto fine_nodes = fine.nodes_of(c);
    for (unsigned j = 0; j < n_coarse; ++j)
      for (unsigned i = 0; i < n_coarse; ++i) {
        const unsigned node = fine_nodes[stride * (j * n_fine + i)];
        if (coarse_index[node] == none) {
          coarse_index[node] = static_cast<unsigned>(coarse.positions.size());
          coarse.positions.push_back(fine.positions[node]);
        }
        nodes[j * n_coarse + i] = coarse_index[node];
      }
    add_cell(coarse, nodes, fine.regions[c]);
  }

  // The first cell of a node gives its row; on a side all cells agree.
  const auto weights = interpolation(coarse.elements[1], fine.elements[1]);
  std::vector<std::array<unsigned, 2>> place(fine.n_nodes(), {none, none}); // cell, node in the cell
  for (unsigned c = 0; c < fine.n_cells; ++c)
    for (unsigned a = 0; a < n_fine * n_fine; ++a)
      if (auto &[cell, local] = place[fine.nodes_of(c)[a]]; cell == none) {
        cell = c;
        local = a;
      }
  result.transfer.reserve(fine.n_nodes(), 4 * fine.n_nodes());
  for (std::size_t node = 0; node < fine.n_nodes(); ++node) {
    const auto &[cell, local] = place[node];
    const auto coarse_nodes = coarse.nodes_of(cell);
    for (std::size_t b = 0; b < coarse_nodes.size(); ++b)
      result.transfer.add(coarse_nodes[b], weights[local * coarse_nodes.size() + b]);
    result.transfer.end_of_node();
  }
  return result;
}

std::optional<Coarsening> coarsen_mesh(const Discretisation &fine) {
  if (fine.n_cells < 4 || fine.n_cells % 4 != 0)
    return {};
  std::vector<std::array<unsigned, 2>> pairs;
  pairs.reserve(4 * fine.n_cells);
  for (std::size_t c = 0; c < fine.n_cells; ++c) {
    const auto nodes = fine.nodes_of(c);
    for (unsigned k = 0; k < 4; ++k)
      pairs.push_back({nodes[counter_clockwise[k]], nodes[counter_clockwise[(k + 1) % 4]]});
  }
  TwoColouring vertices(fine.n_nodes());
  if (!vertices.run(pairs))
    return {};
  const CellsAround cells(fine);
  for (const char edges : {char{0}, char{1}}) {
    pairs.clear();
    for (std::size_t c = 0; c < fine.n_cells; ++c) {
      const auto nodes = fine.nodes_of(c);
      const unsigned first = vertices.is(nodes[0], edges) ? 1 : 0; // the diagonal 1 - 2 or 0 - 3
      pairs.push_back({nodes[first], nodes[3 - first]});
    }
    TwoColouring diagonals(fine.n_nodes());
    if (!diagonals.run(pairs))
      continue;
    for (const char middles : {char{0}, char{1}}) {
      Reading reading(fine, cells, vertices, diagonals, edges, middles);
      if (!reading.run())
        continue;
      auto result = reading.result();
      for (std::size_t c = 0; c < result.space.n_cells; ++c) {
        const auto nodes = result.space.nodes_of(c);
        if (!positive_at_corners(result.space, {nodes[0], nodes[1], nodes[3], nodes[2]}))
          return {};
      }
      return result;
    }
  }
  return {};
}
} // namespace fem_reference::multigrid
