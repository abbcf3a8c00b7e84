#include "mixed.h"

#include "stiffness.h"

#include "fem_reference/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
using Matrix = dealii::SparseMatrix<double>;
using Vector1d = dealii::Vector<double>;

/// Unknowns of the pressure: one for each region and vertex of a cell.
class PressureUnknowns {
public:
  explicit PressureUnknowns(const Discretisation &discretisation) {
    std::map<std::pair<int, unsigned>, unsigned> number;
    for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
      const auto nodes = discretisation.nodes_of(c);
      const auto &element = discretisation.element_of(c);
      std::array<unsigned, 4> unknowns{};
      for (unsigned k = 0; k < element.n_vertices(); ++k) {
        const auto key = std::pair(discretisation.regions[c], nodes[element.corner(k)]);
        unknowns[k] = number.emplace(key, static_cast<unsigned>(number.size())).first->second;
      }
      of_cell_.push_back(unknowns);
    }
    size_ = number.size();
  }
  std::size_t size() const { return size_; }
  unsigned at(std::size_t cell, unsigned corner) const { return of_cell_[cell][corner]; }

private:
  std::vector<std::array<unsigned, 4>> of_cell_;
  std::size_t size_ = 0;
};

/// Values of the linear shape functions of the corners, in the order of the corners.
std::vector<std::array<double, 4>> corner_values(const ReferenceElement &element, std::span<const mesh::Point> points) {
  const ReferenceElement linear(element.n_vertices(), 1);
  std::vector<std::array<double, 4>> result;
  ReferenceElement::Values values, unused_1, unused_2;
  for (const auto &point : points) {
    linear.evaluate(point, values, unused_1, unused_2);
    auto &row = result.emplace_back();
    for (unsigned k = 0; k < element.n_vertices(); ++k)
      row[k] = values[linear.corner(k)];
  }
  return result;
}

/// Unknowns of a cell: two of every node, then the pressure of every corner.
std::vector<unsigned> cell_unknowns(const Discretisation &discretisation, const PressureUnknowns &pressures,
                                    std::size_t c) {
  std::vector<unsigned> unknowns;
  for (const unsigned node : discretisation.nodes_of(c)) {
    unknowns.push_back(2 * node);
    unknowns.push_back(2 * node + 1);
  }
  const auto first = static_cast<unsigned>(2 * discretisation.n_nodes());
  for (unsigned k = 0; k < discretisation.element_of(c).n_vertices(); ++k)
    unknowns.push_back(first + pressures.at(c, k));
  return unknowns;
}

/// Tables of one shape of cell.
struct Tables {
  explicit Tables(const ReferenceElement &element)
      : Tables(element, cell_quadrature(element.n_vertices(), element.degree() + 1)) {}
  Tables(const ReferenceElement &element, const Quadrature2d &quadrature)
      : shape(element, quadrature), pressure(corner_values(element, quadrature.points)),
        at_nodes(corner_values(element, element.nodes())) {}

  ShapeTable shape;
  std::vector<std::array<double, 4>> pressure; ///< at the quadrature points
  std::vector<std::array<double, 4>> at_nodes;
};

void integrate_cell(const Discretisation &discretisation, const Tables &tables, const Material &material, std::size_t c,
                    dealii::FullMatrix<double> &local) {
  const auto nodes = discretisation.nodes_of(c);
  const auto n = static_cast<unsigned>(nodes.size());
  const unsigned n_corners = discretisation.element_of(c).n_vertices();
  const double mu = material.mu(), lambda = material.lambda();
  const double c1 = lambda / (lambda + 2 * mu), c2 = 1 / (lambda + 2 * mu);
  local.reinit(2 * n + n_corners, 2 * n + n_corners);
  std::vector<double> g1(n), g2(n);
  for (int q = 0; q < tables.shape.n_points; ++q) {
    const double *d1 = &tables.shape.gradients_1[static_cast<std::size_t>(q) * n];
    const double *d2 = &tables.shape.gradients_2[static_cast<std::size_t>(q) * n];
    const auto j = discretisation.jacobian(c, d1, d2);
    const double determinant = j.determinant();
    if (!(determinant > 0))
      refuse_jacobian(discretisation, c);
    const double jxw = tables.shape.weights[static_cast<std::size_t>(q)] * determinant;
    for (unsigned a = 0; a < n; ++a) {
      g1[a] = (j.j22 * d1[a] - j.j21 * d2[a]) / determinant;
      g2[a] = (j.j11 * d2[a] - j.j12 * d1[a]) / determinant;
    }
    const auto &psi = tables.pressure[static_cast<std::size_t>(q)];
    for (unsigned a = 0; a < n; ++a) {
      for (unsigned b = 0; b < n; ++b) {
        local(2 * a, 2 * b) += jxw * mu * (2 * g1[a] * g1[b] + g2[a] * g2[b]);
        local(2 * a, 2 * b + 1) += jxw * mu * g2[a] * g1[b];
        local(2 * a + 1, 2 * b) += jxw * mu * g1[a] * g2[b];
        local(2 * a + 1, 2 * b + 1) += jxw * mu * (g1[a] * g1[b] + 2 * g2[a] * g2[b]);
      }
      for (unsigned k = 0; k < n_corners; ++k) {
        local(2 * a, 2 * n + k) += jxw * mu * g1[a] * psi[k];
        local(2 * a + 1, 2 * n + k) += jxw * mu * g2[a] * psi[k];
        local(2 * n + k, 2 * a) += jxw * mu * c1 * psi[k] * g1[a];
        local(2 * n + k, 2 * a + 1) += jxw * mu * c1 * psi[k] * g2[a];
      }
    }
    for (unsigned k = 0; k < n_corners; ++k)
      for (unsigned l = 0; l < n_corners; ++l)
        local(2 * n + k, 2 * n + l) -= jxw * mu * mu * c2 * psi[k] * psi[l];
  }
}

/// Prescribed rows become u = ubar, their columns stay: the matrix is not symmetric anyway.
void impose(const EssentialData &essential, Matrix &matrix, Vector1d &right) {
  for (unsigned i = 0; i < essential.prescribed.size(); ++i) {
    if (essential.prescribed[i] == 0)
      continue;
    double largest = 0; // of the row: the equations keep one size
    for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry) {
      largest = std::max(largest, std::abs(entry->value()));
      entry->value() = 0;
    }
    matrix.set(i, i, largest);
    right[i] = largest * essential.values[i];
  }
}

double backward_error(const Matrix &matrix, const Vector1d &solution, const Vector1d &right) {
  Vector1d residual(right.size());
  matrix.vmult(residual, solution);
  residual -= right;
  const double scale = matrix.linfty_norm() * solution.linfty_norm() + right.linfty_norm();
  return scale > 0 ? residual.linfty_norm() / scale : 0;
}
} // namespace

MixedResult solve_mixed(const Discretisation &discretisation, std::span<const Material> materials,
                        const EssentialData &essential, const Loads &loads) {
  if (discretisation.degree() != 2)
    throw InvalidInput("Taylor-Hood elements are of degree 2");
  const PressureUnknowns pressures(discretisation);
  const std::size_t n_displacements = 2 * discretisation.n_nodes();
  const auto n = static_cast<unsigned>(n_displacements + pressures.size());
  dealii::DynamicSparsityPattern dynamic(n, n);
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    auto unknowns = cell_unknowns(discretisation, pressures, c);
    std::sort(unknowns.begin(), unknowns.end());
    for (const unsigned row : unknowns)
      dynamic.add_entries(row, unknowns.begin(), unknowns.end(), true);
  }
  dealii::SparsityPattern pattern;
  pattern.copy_from(dynamic);
  Matrix matrix(pattern);
  const std::array<Tables, 2> tables{Tables(discretisation.elements[0]), Tables(discretisation.elements[1])};
  dealii::FullMatrix<double> local;
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    integrate_cell(discretisation, tables[discretisation.n_vertices[c] - 3U],
                   materials[static_cast<std::size_t>(discretisation.regions[c])], c, local);
    matrix.add(cell_unknowns(discretisation, pressures, c), local);
  }
  Vector1d right(n), solution(n);
  for (unsigned i = 0; i < n_displacements; ++i)
    right[i] = loads.nodal[i];
  impose(essential, matrix, right);
  try {
    dealii::SparseDirectUMFPACK factors;
    factors.initialize(matrix);
    factors.vmult(solution, right);
  } catch (const dealii::ExceptionBase &error) {
    throw SolveFailure(fmt::format("the mixed system of {} unknowns could not be solved: {}", n, error.what()));
  }
  MixedResult result;
  result.n_dofs = n;
  result.nonzeros = matrix.n_nonzero_elements();
  result.backward_error = backward_error(matrix, solution, right);
  result.displacement.assign(solution.begin(), solution.begin() + static_cast<std::ptrdiff_t>(n_displacements));
  result.cell_pressure.reserve(discretisation.cell_nodes.size());
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const auto &element = discretisation.element_of(c);
    const double mu = materials[static_cast<std::size_t>(discretisation.regions[c])].mu();
    for (unsigned a = 0; a < element.n_nodes(); ++a) {
      double p = 0;
      for (unsigned k = 0; k < element.n_vertices(); ++k)
        p += tables[element.n_vertices() - 3U].at_nodes[a][k] *
             solution[static_cast<unsigned>(n_displacements) + pressures.at(c, k)];
      result.cell_pressure.push_back(mu * p);
    }
  }
  return result;
}
} // namespace fem_reference::elasticity
