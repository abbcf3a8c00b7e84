#include "stiffness.h"

#include "../parallel/bands.h"
#include "fem_reference/errors.h"

#include <algorithm>
#include <array>
#include <experimental/simd>
#include <type_traits>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
namespace simd = std::experimental;
using parallel::Band;
using Lanes = simd::native_simd<double>;

/// Rows of n values are padded to whole vectors.
constexpr int padded(int n) { return (n + 7) / 8 * 8; }
static_assert(8 % Lanes::size() == 0);

template <int n_nodes>
struct alignas(64) NodeRow : std::array<double, padded(n_nodes)> {};

/// Integrals of N_a,r N_b,s over one cell.
template <int n_nodes>
struct GradientProducts {
  using Matrix = std::array<NodeRow<n_nodes>, n_nodes>;

  Matrix m11;
  Matrix m12; // row: derivative 1, column: derivative 2
  Matrix m22;
};

/// Shape gradients at the quadrature points, rows padded with zeros.
template <int n_nodes>
struct PaddedTable {
  explicit PaddedTable(const ShapeTable &table)
      : n_points(table.n_points), gradient_1(table.weights.size()), gradient_2(table.weights.size()),
        weight(table.weights) {
    for (int q = 0; q < n_points; ++q)
      for (int a = 0; a < n_nodes; ++a) {
        gradient_1[q][a] = table.gradients_1[q * n_nodes + a];
        gradient_2[q][a] = table.gradients_2[q * n_nodes + a];
      }
  }

  int n_points;
  std::vector<NodeRow<n_nodes>> gradient_1;
  std::vector<NodeRow<n_nodes>> gradient_2;
  std::vector<double> weight;
};

/// Gradients of the shape functions in space at one quadrature point. Returns JxW, not positive if the
/// cell is inverted there.
template <int n_nodes>
double map_gradients(const PaddedTable<n_nodes> &table, int q, const NodeRow<n_nodes> &x1, const NodeRow<n_nodes> &x2,
                     NodeRow<n_nodes> &g1, NodeRow<n_nodes> &g2) {
  const auto &d1 = table.gradient_1[q];
  const auto &d2 = table.gradient_2[q];
  double j11 = 0, j12 = 0, j21 = 0, j22 = 0; // j_ik = d x_i / d xi_k
  for (int a = 0; a < n_nodes; ++a) {
    j11 += x1[a] * d1[a];
    j12 += x1[a] * d2[a];
    j21 += x2[a] * d1[a];
    j22 += x2[a] * d2[a];
  }
  const double determinant = j11 * j22 - j12 * j21;
  const double inverse = 1 / determinant;
  for (int a = 0; a < padded(n_nodes); ++a) {
    g1[a] = (j22 * d1[a] - j21 * d2[a]) * inverse;
    g2[a] = (j11 * d2[a] - j12 * d1[a]) * inverse;
  }
  return table.weight[q] * determinant;
}

template <int n_nodes>
void gather_positions(const Discretisation &discretisation, const unsigned *nodes, NodeRow<n_nodes> &x1,
                      NodeRow<n_nodes> &x2) {
  for (int a = 0; a < n_nodes; ++a) {
    x1[a] = discretisation.positions[nodes[a]][0];
    x2[a] = discretisation.positions[nodes[a]][1];
  }
}

/// Gradients in space of one cell's shape functions at the quadrature points, and those times JxW.
template <int n_nodes>
struct CellGradients {
  explicit CellGradients(int n_points)
      : gradient_1(n_points), gradient_2(n_points), weighted_1(n_points), weighted_2(n_points) {}

  std::vector<NodeRow<n_nodes>> gradient_1;
  std::vector<NodeRow<n_nodes>> gradient_2;
  std::vector<NodeRow<n_nodes>> weighted_1;
  std::vector<NodeRow<n_nodes>> weighted_2;
};

/// Returns false if the Jacobian is not positive at some quadrature point.
template <int n_nodes>
bool map_cell(const PaddedTable<n_nodes> &table, const Discretisation &discretisation, const unsigned *nodes,
              CellGradients<n_nodes> &cell) {
  NodeRow<n_nodes> x1{}, x2{};
  gather_positions(discretisation, nodes, x1, x2);
  for (int q = 0; q < table.n_points; ++q) {
    const double jxw = map_gradients(table, q, x1, x2, cell.gradient_1[q], cell.gradient_2[q]);
    if (!(jxw > 0))
      return false;
    for (int a = 0; a < n_nodes; ++a) {
      cell.weighted_1[q][a] = jxw * cell.gradient_1[q][a];
      cell.weighted_2[q][a] = jxw * cell.gradient_2[q][a];
    }
  }
  return true;
}

/// A row at a time, which stays in registers. In lanes by hand: the compiler unrolls all and shuffles, which takes
/// three times as long.
template <int n_nodes>
void multiply_gradients(const CellGradients<n_nodes> &cell, GradientProducts<n_nodes> &products) {
  constexpr std::size_t n_packs = padded(n_nodes) / Lanes::size();
  for (int a = 0; a < n_nodes; ++a) {
    std::array<Lanes, n_packs> m11{}, m12{}, m22{};
    for (std::size_t q = 0; q < cell.gradient_1.size(); ++q) {
      const Lanes w1 = cell.weighted_1[q][a];
      const Lanes w2 = cell.weighted_2[q][a];
      for (std::size_t k = 0; k < n_packs; ++k) {
        const Lanes g1(&cell.gradient_1[q][k * Lanes::size()], simd::vector_aligned);
        const Lanes g2(&cell.gradient_2[q][k * Lanes::size()], simd::vector_aligned);
        m11[k] += w1 * g1;
        m12[k] += w1 * g2;
        m22[k] += w2 * g2;
      }
    }
    for (std::size_t k = 0; k < n_packs; ++k) {
      m11[k].copy_to(&products.m11[a][k * Lanes::size()], simd::vector_aligned);
      m12[k].copy_to(&products.m12[a][k * Lanes::size()], simd::vector_aligned);
      m22[k].copy_to(&products.m22[a][k * Lanes::size()], simd::vector_aligned);
    }
  }
}

/// To the columns of the band.
template <int n_nodes>
void add_to_matrix(const GradientProducts<n_nodes> &products, double lambda, double mu, const unsigned *nodes,
                   const Band &band, linear_algebra::BlockMatrix &matrix) {
  for (int b = 0; b < n_nodes; ++b) {
    const unsigned column = nodes[b];
    if (!band.holds(column))
      continue;
    const int first_block = matrix.block_start[column];
    const int n_blocks = matrix.block_start[column + 1] - first_block;
    double *column_0 = matrix.values.data() + matrix.first_entry(column);
    double *column_1 = column_0 + 2 * n_blocks - 1; // its row 2 column is not stored
    for (int a = 0; a < n_nodes; ++a) {
      const unsigned row = nodes[a];
      if (row < column)
        continue;
      const int k = matrix.find(row, column) - first_block;
      const double m11 = products.m11[a][b];
      const double m12 = products.m12[a][b];
      const double m21 = products.m12[b][a];
      const double m22 = products.m22[a][b];
      const double trace = m11 + m22;
      column_0[2 * k] += lambda * m11 + mu * (m11 + trace);
      column_0[2 * k + 1] += lambda * m21 + mu * m12;
      if (k > 0)
        column_1[2 * k] += lambda * m12 + mu * m21;
      column_1[2 * k + 1] += lambda * m22 + mu * (m22 + trace);
    }
  }
}

template <int n_nodes>
void add_internal_forces(const ReferenceElement &element, const Discretisation &discretisation,
                         std::span<const Material> materials, std::span<const double> displacement,
                         std::span<const double> cell_pressure, InternalForces &result) {
  const ShapeTable shape(element, cell_quadrature(element.n_vertices(), element.degree() + 1));
  const PaddedTable<n_nodes> table(shape);
  NodeRow<n_nodes> x1{}, x2{}, u1{}, u2{}, f1, f2, g1, g2;
  double twice_energy = 0;
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    if (discretisation.n_vertices[c] != element.n_vertices())
      continue;
    const auto &material = materials[static_cast<std::size_t>(discretisation.regions[c])];
    const double lambda = material.lambda();
    const double mu = material.mu();
    const unsigned *nodes = discretisation.nodes_of(c).data();
    gather_positions(discretisation, nodes, x1, x2);
    for (int a = 0; a < n_nodes; ++a) {
      u1[a] = displacement[2 * std::size_t{nodes[a]}] - displacement[2 * std::size_t{nodes[0]}];
      u2[a] = displacement[2 * std::size_t{nodes[a]} + 1] - displacement[2 * std::size_t{nodes[0]} + 1];
    }
    f1.fill(0);
    f2.fill(0);
    for (int q = 0; q < table.n_points; ++q) {
      const double jxw = map_gradients(table, q, x1, x2, g1, g2);
      double e11 = 0, e22 = 0, gamma = 0;
      for (int a = 0; a < n_nodes; ++a) {
        e11 += g1[a] * u1[a];
        e22 += g2[a] * u2[a];
        gamma += g2[a] * u1[a] + g1[a] * u2[a];
      }
      double trace = lambda * (e11 + e22);
      if (!cell_pressure.empty()) {
        trace = 0;
        for (int a = 0; a < n_nodes; ++a)
          trace += shape.values[q * n_nodes + a] * cell_pressure[discretisation.cell_start[c] + a];
      }
      const double s11 = jxw * (trace + 2 * mu * e11);
      const double s22 = jxw * (trace + 2 * mu * e22);
      const double s12 = jxw * mu * gamma;
      twice_energy += s11 * e11 + s22 * e22 + s12 * gamma;
      for (int a = 0; a < padded(n_nodes); ++a) {
        f1[a] += s11 * g1[a] + s12 * g2[a];
        f2[a] += s12 * g1[a] + s22 * g2[a];
      }
    }
    for (int a = 0; a < n_nodes; ++a) {
      result.forces[2 * std::size_t{nodes[a]}] += f1[a];
      result.forces[2 * std::size_t{nodes[a]} + 1] += f2[a];
    }
  }
  result.energy += .5 * twice_energy;
}

/// The columns of one band. Returns the first cell whose Jacobian is not positive, at which it ends, or n_cells.
template <int n_nodes>
std::size_t assemble(const ReferenceElement &element, const Discretisation &discretisation,
                     std::span<const Material> materials, const Band &band, linear_algebra::BlockMatrix &matrix) {
  const PaddedTable<n_nodes> table(ShapeTable(element, cell_quadrature(element.n_vertices(), element.degree() + 1)));
  CellGradients<n_nodes> cell(table.n_points);
  GradientProducts<n_nodes> products;
  for (const std::size_t c : cells_touching(band, discretisation, element.n_vertices())) {
    const auto &material = materials[static_cast<std::size_t>(discretisation.regions[c])];
    const unsigned *nodes = discretisation.nodes_of(c).data();
    if (!map_cell(table, discretisation, nodes, cell))
      return c;
    multiply_gradients(cell, products);
    add_to_matrix(products, material.lambda(), material.mu(), nodes, band, matrix);
  }
  return discretisation.n_cells;
}

/// Calls function(n_nodes, element) for both shapes, with n_nodes a compile-time constant: it tells the shape and the
/// degree apart.
template <typename Function>
void for_each_element(const Discretisation &discretisation, const Function &function) {
  for (const auto &element : discretisation.elements) {
    switch (element.n_nodes()) {
    case 3:
      function(std::integral_constant<int, 3>(), element);
      break;
    case 6:
      function(std::integral_constant<int, 6>(), element);
      break;
    case 10:
      function(std::integral_constant<int, 10>(), element);
      break;
    case 15:
      function(std::integral_constant<int, 15>(), element);
      break;
    case 4:
      function(std::integral_constant<int, 4>(), element);
      break;
    case 9:
      function(std::integral_constant<int, 9>(), element);
      break;
    case 16:
      function(std::integral_constant<int, 16>(), element);
      break;
    default:
      function(std::integral_constant<int, 25>(), element);
      break;
    }
  }
}
} // namespace

void refuse_jacobian(const Discretisation &discretisation, std::size_t c) {
  mesh::Point centre{};
  const auto nodes = discretisation.nodes_of(c);
  for (const unsigned node : nodes)
    for (std::size_t d = 0; d < 2; ++d)
      centre[d] += discretisation.original_position(node)[d] / static_cast<double>(nodes.size());
  throw InvalidInput(fmt::format(
      "mesh: the Jacobian of cell {} around ({}, {}) is not positive everywhere; {}", c, centre[0], centre[1],
      discretisation.curved[c] != 0 ? "a curved side folds it: use smaller cells there, or curve the sides inside too"
                                    : "move its vertices"));
}

void assemble_stiffness(const Discretisation &discretisation, std::span<const Material> materials,
                        linear_algebra::BlockMatrix &matrix) {
  for_each_element(discretisation, [&](auto n_nodes, const ReferenceElement &element) {
    std::vector<std::size_t> faulty(static_cast<std::size_t>(threads()));
    parallel::for_each_band(discretisation.n_nodes(), [&](const Band &band, int k) {
      faulty[static_cast<std::size_t>(k)] = assemble<n_nodes()>(element, discretisation, materials, band, matrix);
    });
    if (const auto first = *std::min_element(faulty.begin(), faulty.end()); first < discretisation.n_cells)
      refuse_jacobian(discretisation, first);
  });
}

InternalForces internal_forces(const Discretisation &discretisation, std::span<const Material> materials,
                               std::span<const double> displacement, std::span<const double> cell_pressure) {
  InternalForces result;
  result.forces.assign(displacement.size(), 0.);
  for_each_element(discretisation, [&](auto n_nodes, const ReferenceElement &element) {
    add_internal_forces<n_nodes()>(element, discretisation, materials, displacement, cell_pressure, result);
  });
  return result;
}
} // namespace fem_reference::elasticity
