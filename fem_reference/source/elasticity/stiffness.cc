#include "stiffness.h"

#include "fem_reference/errors.h"
#include "reference_element.h"

#include <array>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
/// Integrals of N_a,r N_b,s over one cell. Rows are padded to whole vectors.
template <int degree>
struct GradientProducts {
  static constexpr int n_nodes = (degree + 1) * (degree + 1);
  static constexpr int stride = (n_nodes + 7) / 8 * 8;
  using Matrix = std::array<std::array<double, stride>, n_nodes>;

  alignas(64) Matrix m11;
  alignas(64) Matrix m12; // row: derivative 1, column: derivative 2
  alignas(64) Matrix m22;
};

/// Shape gradients at the quadrature points, rows padded with zeros.
template <int degree>
struct PaddedTable {
  using Row = std::array<double, GradientProducts<degree>::stride>;
  static constexpr int n_points = (degree + 1) * (degree + 1);

  explicit PaddedTable(const ShapeTable &table) {
    for (int q = 0; q < n_points; ++q) {
      weight[q] = table.weights[q];
      for (int a = 0; a < table.n_nodes; ++a) {
        gradient_1[q][a] = table.gradients_1[q * table.n_nodes + a];
        gradient_2[q][a] = table.gradients_2[q * table.n_nodes + a];
      }
    }
  }

  alignas(64) std::array<Row, n_points> gradient_1{};
  alignas(64) std::array<Row, n_points> gradient_2{};
  std::array<double, n_points> weight{};
};

template <int degree>
using NodeRow = typename PaddedTable<degree>::Row;

/// Gradients of the shape functions in space at one quadrature point. Returns JxW, not positive if the
/// cell is inverted there.
template <int degree>
double map_gradients(const PaddedTable<degree> &table, int q, const NodeRow<degree> &x1, const NodeRow<degree> &x2,
                     NodeRow<degree> &g1, NodeRow<degree> &g2) {
  const auto &d1 = table.gradient_1[q];
  const auto &d2 = table.gradient_2[q];
  double j11 = 0, j12 = 0, j21 = 0, j22 = 0; // j_ik = d x_i / d xi_k
  for (int a = 0; a < GradientProducts<degree>::n_nodes; ++a) {
    j11 += x1[a] * d1[a];
    j12 += x1[a] * d2[a];
    j21 += x2[a] * d1[a];
    j22 += x2[a] * d2[a];
  }
  const double determinant = j11 * j22 - j12 * j21;
  const double inverse = 1 / determinant;
  for (int a = 0; a < GradientProducts<degree>::stride; ++a) {
    g1[a] = (j22 * d1[a] - j21 * d2[a]) * inverse;
    g2[a] = (j11 * d2[a] - j12 * d1[a]) * inverse;
  }
  return table.weight[q] * determinant;
}

template <int degree>
void gather_positions(const Discretisation &discretisation, const unsigned *nodes, NodeRow<degree> &x1,
                      NodeRow<degree> &x2) {
  for (int a = 0; a < GradientProducts<degree>::n_nodes; ++a) {
    x1[a] = discretisation.positions[nodes[a]][0];
    x2[a] = discretisation.positions[nodes[a]][1];
  }
}

/// Returns false if the Jacobian is not positive at some quadrature point.
template <int degree>
bool integrate_cell(const PaddedTable<degree> &table, const Discretisation &discretisation, const unsigned *nodes,
                    GradientProducts<degree> &products) {
  constexpr int n = GradientProducts<degree>::n_nodes;
  constexpr int stride = GradientProducts<degree>::stride;
  alignas(64) NodeRow<degree> x1{};
  alignas(64) NodeRow<degree> x2{};
  gather_positions<degree>(discretisation, nodes, x1, x2);
  products = {};
  for (int q = 0; q < table.n_points; ++q) {
    alignas(64) NodeRow<degree> g1;
    alignas(64) NodeRow<degree> g2;
    const double jxw = map_gradients<degree>(table, q, x1, x2, g1, g2);
    if (!(jxw > 0))
      return false;
    for (int a = 0; a < n; ++a) {
      const double w1 = jxw * g1[a];
      const double w2 = jxw * g2[a];
      for (int b = 0; b < stride; ++b) {
        products.m11[a][b] += w1 * g1[b];
        products.m12[a][b] += w1 * g2[b];
        products.m22[a][b] += w2 * g2[b];
      }
    }
  }
  return true;
}

template <int degree>
void add_to_matrix(const GradientProducts<degree> &products, double lambda, double mu, const unsigned *nodes,
                   linear_algebra::BlockMatrix &matrix) {
  constexpr int n = GradientProducts<degree>::n_nodes;
  for (int b = 0; b < n; ++b) {
    const unsigned column = nodes[b];
    const int first_block = matrix.block_start[column];
    const int n_blocks = matrix.block_start[column + 1] - first_block;
    double *column_0 = matrix.values.data() + matrix.first_entry(column);
    double *column_1 = column_0 + 2 * n_blocks - 1; // its row 2 column is not stored
    for (int a = 0; a < n; ++a) {
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

template <int degree>
void subtract_internal_forces(const Discretisation &discretisation, const Material &material,
                              std::span<const double> displacement, std::vector<double> &residual) {
  constexpr int n = GradientProducts<degree>::n_nodes;
  constexpr int stride = GradientProducts<degree>::stride;
  const PaddedTable<degree> table(ShapeTable(degree, degree + 1));
  const double lambda = material.lambda();
  const double mu = material.mu();
  alignas(64) NodeRow<degree> x1{}, x2{}, u1{}, u2{}, f1, f2, g1, g2;
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const unsigned *nodes = discretisation.nodes_of(c).data();
    gather_positions<degree>(discretisation, nodes, x1, x2);
    for (int a = 0; a < n; ++a) {
      u1[a] = displacement[2 * std::size_t{nodes[a]}] - displacement[2 * std::size_t{nodes[0]}];
      u2[a] = displacement[2 * std::size_t{nodes[a]} + 1] - displacement[2 * std::size_t{nodes[0]} + 1];
    }
    f1.fill(0);
    f2.fill(0);
    for (int q = 0; q < table.n_points; ++q) {
      const double jxw = map_gradients<degree>(table, q, x1, x2, g1, g2);
      double e11 = 0, e22 = 0, gamma = 0;
      for (int a = 0; a < n; ++a) {
        e11 += g1[a] * u1[a];
        e22 += g2[a] * u2[a];
        gamma += g2[a] * u1[a] + g1[a] * u2[a];
      }
      const double s11 = jxw * (lambda * (e11 + e22) + 2 * mu * e11);
      const double s22 = jxw * (lambda * (e11 + e22) + 2 * mu * e22);
      const double s12 = jxw * mu * gamma;
      for (int a = 0; a < stride; ++a) {
        f1[a] += s11 * g1[a] + s12 * g2[a];
        f2[a] += s12 * g1[a] + s22 * g2[a];
      }
    }
    for (int a = 0; a < n; ++a) {
      residual[2 * std::size_t{nodes[a]}] -= f1[a];
      residual[2 * std::size_t{nodes[a]} + 1] -= f2[a];
    }
  }
}

template <int degree>
void assemble(const Discretisation &discretisation, const Material &material, linear_algebra::BlockMatrix &matrix) {
  const PaddedTable<degree> table(ShapeTable(degree, degree + 1));
  const double lambda = material.lambda();
  const double mu = material.mu();
  GradientProducts<degree> products;
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const unsigned *nodes = discretisation.nodes_of(c).data();
    if (!integrate_cell(table, discretisation, nodes, products))
      throw InvalidInput(fmt::format("mesh: the Jacobian of cell {} is not positive everywhere; move its vertices", c));
    add_to_matrix(products, lambda, mu, nodes, matrix);
  }
}
} // namespace

void assemble_stiffness(const Discretisation &discretisation, const Material &material,
                        linear_algebra::BlockMatrix &matrix) {
  switch (discretisation.degree) {
  case 1:
    return assemble<1>(discretisation, material, matrix);
  case 2:
    return assemble<2>(discretisation, material, matrix);
  case 3:
    return assemble<3>(discretisation, material, matrix);
  default:
    return assemble<4>(discretisation, material, matrix);
  }
}

std::vector<double> residual_by_cells(const Discretisation &discretisation, const Material &material,
                                      std::span<const double> displacement, std::span<const double> load) {
  std::vector<double> residual(load.begin(), load.end());
  switch (discretisation.degree) {
  case 1:
    subtract_internal_forces<1>(discretisation, material, displacement, residual);
    break;
  case 2:
    subtract_internal_forces<2>(discretisation, material, displacement, residual);
    break;
  case 3:
    subtract_internal_forces<3>(discretisation, material, displacement, residual);
    break;
  default:
    subtract_internal_forces<4>(discretisation, material, displacement, residual);
    break;
  }
  return residual;
}
} // namespace fem_reference::elasticity
