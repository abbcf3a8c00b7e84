#include "discretisation.h"

#include "../stopwatch.h"

#include <algorithm>
#include <cmath>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/vector.h>

#include <fmt/format.h>

namespace fem_reference::rod {

class Solution::Implementation {
public:
  Implementation(const std::vector<double> &vertices, int degree)
      : discretisation(vertices, degree), nodal(discretisation.numbering.n_dofs()) {}

  Discretisation discretisation;
  dealii::Vector<double> nodal; ///< m
  double backward_error = 0;

  /// Nodal values of every cell, cell by cell, in the order of the rod.
  void keep_cells() {
    const unsigned n_nodes = discretisation.element.n_dofs_per_cell();
    cells_.reserve(n_nodes * (discretisation.vertices.size() - 1));
    std::vector<dealii::types::global_dof_index> nodes(n_nodes);
    for (const auto &cell : discretisation.numbering.active_cell_iterators()) {
      cell->get_dof_indices(nodes);
      for (const auto node : nodes)
        cells_.push_back(nodal[node]);
    }
  }

  /// The last vertex belongs to the last cell, every other to the cell on its right.
  std::size_t cell_of(double x) const {
    const auto &v = discretisation.vertices;
    if (!(x >= v.front() && x <= v.back()))
      throw InvalidInput(fmt::format("x = {} m is outside the rod from {} m to {} m", x, v.front(), v.back()));
    const auto next = std::upper_bound(v.begin(), v.end(), x) - v.begin();
    return std::min(static_cast<std::size_t>(next), v.size() - 1) - 1;
  }

  /// Derivative of the given order (0, 1, 2) with respect to x in m.
  double evaluate(std::size_t cell, double x, int derivative) const {
    const auto &v = discretisation.vertices;
    const double size = v[cell + 1] - v[cell];
    const dealii::Point<1> local((x - v[cell]) / size);
    const auto &element = discretisation.element;
    const unsigned n_nodes = element.n_dofs_per_cell();
    double sum = 0;
    for (unsigned a = 0; a < n_nodes; ++a) {
      const double shape = derivative == 0   ? element.shape_value(a, local)
                           : derivative == 1 ? element.shape_grad(a, local)[0] / size
                                             : element.shape_grad_grad(a, local)[0][0] / (size * size);
      sum += cells_[cell * n_nodes + a] * shape;
    }
    return sum;
  }

private:
  std::vector<double> cells_;
};

namespace {
/// Integral of the body force with the shape functions, N/m^2; in places of the rod, not local ones.
void add_load(const Discretisation &discretisation, const Field &body_force, dealii::Vector<double> &load) {
  const dealii::QGauss<1> rule(discretisation.element.degree + 3);
  dealii::FEValues<1> values(discretisation.element, rule,
                             dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values);
  const unsigned n_nodes = discretisation.element.n_dofs_per_cell();
  std::vector<dealii::types::global_dof_index> nodes(n_nodes);
  std::vector<double> points(rule.size()), force(rule.size());
  for (const auto &cell : discretisation.numbering.active_cell_iterators()) {
    values.reinit(cell);
    cell->get_dof_indices(nodes);
    for (unsigned q = 0; q < rule.size(); ++q)
      points[q] = discretisation.to_global(values.quadrature_point(q)[0]);
    body_force(points, force);
    for (unsigned q = 0; q < rule.size(); ++q)
      for (unsigned a = 0; a < n_nodes; ++a)
        load[nodes[a]] += force[q] * values.shape_value(a, q) * values.JxW(q) * discretisation.half_length;
  }
}

/// f - K u cell by cell from the strain. It comes from differences of nodal values within a cell, so that the large
/// common part of u, which costs the residual of the assembled matrix its digits, drops out.
dealii::Vector<double> residual_by_cells(const Rod &rod, const Discretisation &discretisation,
                                         const dealii::Vector<double> &nodal, const dealii::Vector<double> &load) {
  const dealii::QGauss<1> rule(discretisation.element.degree + 1);
  dealii::FEValues<1> values(discretisation.element, rule, dealii::update_gradients | dealii::update_JxW_values);
  const unsigned n_nodes = discretisation.element.n_dofs_per_cell();
  std::vector<dealii::types::global_dof_index> nodes(n_nodes);
  dealii::Vector<double> residual = load;
  const double scale = rod.youngs_modulus / discretisation.half_length;
  for (const auto &cell : discretisation.numbering.active_cell_iterators()) {
    values.reinit(cell);
    cell->get_dof_indices(nodes);
    for (unsigned q = 0; q < rule.size(); ++q) {
      double strain = 0;
      for (unsigned a = 1; a < n_nodes; ++a)
        strain += (nodal[nodes[a]] - nodal[nodes[0]]) * values.shape_grad(a, q)[0];
      for (unsigned a = 0; a < n_nodes; ++a)
        residual[nodes[a]] -= scale * strain * values.shape_grad(a, q)[0] * values.JxW(q);
    }
  }
  for (const int side : {0, 1})
    if (rod.ends[side].kind == EndKind::displacement)
      residual[discretisation.end_node(side)] = 0;
  return residual;
}

/// Rows and columns of prescribed nodes become those of the identity, scaled like their neighbours.
void prescribe(const Rod &rod, const Discretisation &discretisation, dealii::SparseMatrix<double> &matrix,
               dealii::Vector<double> &load) {
  for (const int side : {0, 1}) {
    const auto &end = rod.ends[side];
    const unsigned node = discretisation.end_node(side);
    if (end.kind == EndKind::traction)
      continue;
    const double diagonal = matrix.diag_element(node);
    for (auto entry = matrix.begin(node); entry != matrix.end(node); ++entry) {
      const auto other = entry->column();
      if (other == node)
        continue;
      load[other] -= matrix.el(other, node) * end.value;
      matrix.set(other, node, 0);
      entry->value() = 0;
    }
    load[node] = diagonal * end.value;
  }
}

double backward_error_of(const dealii::SparseMatrix<double> &matrix, const dealii::Vector<double> &solution,
                         const dealii::Vector<double> &load) {
  dealii::Vector<double> residual(load.size());
  matrix.residual(residual, solution, load);
  const double size = matrix.linfty_norm() * solution.linfty_norm() + load.linfty_norm();
  return size > 0 ? residual.linfty_norm() / size : 0;
}
} // namespace

Solution::Solution(std::shared_ptr<const Implementation> implementation) : implementation_(std::move(implementation)) {}

std::size_t Solution::n_dofs() const { return implementation_->nodal.size(); }
std::size_t Solution::nonzeros() const { return implementation_->discretisation.pattern.n_nonzero_elements(); }
const Seconds &Solution::seconds() const { return implementation_->discretisation.seconds; }
double Solution::backward_error() const { return implementation_->backward_error; }

void Solution::displacement(std::span<const double> points, std::span<double> values) const {
  for (std::size_t k = 0; k < points.size(); ++k)
    values[k] = implementation_->evaluate(implementation_->cell_of(points[k]), points[k], 0);
}

void Solution::strain(std::span<const double> points, std::span<double> values) const {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t cell = implementation_->cell_of(points[k]);
    values[k] = implementation_->evaluate(cell, points[k], 1);
    if (cell > 0 && points[k] == implementation_->discretisation.vertices[cell])
      values[k] = .5 * (values[k] + implementation_->evaluate(cell - 1, points[k], 1));
  }
}

std::vector<double> Solution::second_derivatives_at_cell_ends() const {
  const auto &vertices = implementation_->discretisation.vertices;
  std::vector<double> values;
  values.reserve(2 * (vertices.size() - 1));
  for (std::size_t cell = 0; cell + 1 < vertices.size(); ++cell)
    for (const double x : {vertices[cell], vertices[cell + 1]})
      values.push_back(implementation_->evaluate(cell, x, 2));
  return values;
}

Solution solve(const Rod &rod, const Options &options) {
  check(rod);
  auto implementation = std::make_shared<Solution::Implementation>(rod.vertices, options.degree);
  auto &discretisation = implementation->discretisation;
  Stopwatch watch;
  dealii::SparseMatrix<double> matrix(discretisation.pattern);
  assemble_stiffness(discretisation, matrix);
  matrix *= rod.youngs_modulus / discretisation.half_length;
  dealii::Vector<double> load(discretisation.numbering.n_dofs());
  if (rod.body_force)
    add_load(discretisation, rod.body_force, load);
  for (const int side : {0, 1})
    if (rod.ends[side].kind == EndKind::traction)
      load[discretisation.end_node(side)] += rod.ends[side].value;
  const dealii::Vector<double> forces = load;
  prescribe(rod, discretisation, matrix, load);
  discretisation.seconds.assembly = watch.lap();

  dealii::SparseDirectUMFPACK factors;
  try {
    factors.initialize(matrix);
    factors.vmult(implementation->nodal, load);
    dealii::Vector<double> correction(load.size());
    factors.vmult(correction, residual_by_cells(rod, discretisation, implementation->nodal, forces));
    implementation->nodal += correction;
  } catch (const dealii::ExceptionBase &error) {
    throw SolveFailure(fmt::format("the linear system of the rod could not be solved: {}", error.what()));
  }
  discretisation.seconds.solve = watch.lap();
  if (!std::isfinite(implementation->nodal.l1_norm()))
    throw SolveFailure("the displacement of the rod is not finite; is the body force finite?");
  implementation->backward_error = backward_error_of(matrix, implementation->nodal, load);
  implementation->keep_cells();
  return Solution(std::move(implementation));
}

Solution interpolate(const std::vector<double> &vertices, const Field &function, int degree) {
  auto implementation = std::make_shared<Solution::Implementation>(vertices, degree);
  auto &discretisation = implementation->discretisation;
  Stopwatch watch;
  const auto &support = discretisation.element.get_unit_support_points();
  std::vector<dealii::types::global_dof_index> nodes(support.size());
  std::vector<double> points(support.size()), values(support.size());
  std::size_t k = 0;
  for (const auto &cell : discretisation.numbering.active_cell_iterators()) {
    cell->get_dof_indices(nodes);
    const double size = vertices[k + 1] - vertices[k];
    for (std::size_t a = 0; a < support.size(); ++a)
      points[a] = support[a][0] == 1 ? vertices[k + 1] : vertices[k] + size * support[a][0];
    function(points, values);
    for (std::size_t a = 0; a < support.size(); ++a) {
      if (!std::isfinite(values[a]))
        throw InvalidInput(fmt::format("the function is {} at x = {} m", values[a], points[a]));
      implementation->nodal[nodes[a]] = values[a];
    }
    ++k;
  }
  implementation->keep_cells();
  discretisation.seconds.assembly = watch.lap();
  return Solution(std::move(implementation));
}
} // namespace fem_reference::rod
