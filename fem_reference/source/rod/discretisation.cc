#include "discretisation.h"

#include "../stopwatch.h"

#include <cmath>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <fmt/format.h>

namespace fem_reference::rod {
namespace {
void check_vertices(const std::vector<double> &vertices) {
  if (vertices.size() < 2)
    throw InvalidInput(fmt::format("a rod of {} vertices; at least 2 are needed", vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (!std::isfinite(vertices[k]))
      throw InvalidInput(fmt::format("vertex {} of the rod is at {}; expected a finite place", k, vertices[k]));
    if (k > 0 && !(vertices[k] > vertices[k - 1]))
      throw InvalidInput(fmt::format("vertex {} of the rod is at {} m, vertex {} at {} m; vertices must increase", k,
                                     vertices[k], k - 1, vertices[k - 1]));
  }
}

int checked_degree(int degree) {
  if (degree < 1 || degree > 3)
    throw InvalidInput(fmt::format("elements of degree {}; a rod has 1, 2 or 3", degree));
  return degree;
}

const std::vector<double> &checked(const std::vector<double> &vertices) {
  check_vertices(vertices);
  return vertices;
}

/// Adds `entry(values, q, a, b)` times JxW over all cells.
template <typename Entry>
void assemble(const Discretisation &discretisation, const dealii::Quadrature<1> &rule, dealii::UpdateFlags flags,
              const Entry &entry, dealii::SparseMatrix<double> &matrix) {
  dealii::FEValues<1> values(discretisation.element, rule, flags | dealii::update_JxW_values);
  const unsigned n_nodes = discretisation.element.n_dofs_per_cell();
  std::vector<dealii::types::global_dof_index> nodes(n_nodes);
  for (const auto &cell : discretisation.numbering.active_cell_iterators()) {
    values.reinit(cell);
    cell->get_dof_indices(nodes);
    for (unsigned q = 0; q < rule.size(); ++q)
      for (unsigned a = 0; a < n_nodes; ++a)
        for (unsigned b = 0; b < n_nodes; ++b)
          matrix.add(nodes[a], nodes[b], entry(values, q, a, b) * values.JxW(q));
  }
}
} // namespace

Discretisation::Discretisation(const std::vector<double> &given, int degree)
    : vertices(checked(given)), middle(vertices.front() + .5 * (vertices.back() - vertices.front())),
      half_length(.5 * (vertices.back() - vertices.front())), element(checked_degree(degree)),
      numbering(triangulation) {
  Stopwatch watch;
  std::vector<dealii::Point<1>> points;
  points.reserve(vertices.size());
  for (const double x : vertices)
    points.emplace_back(to_local(x));
  std::vector<dealii::CellData<1>> cells(vertices.size() - 1);
  for (unsigned c = 0; c < cells.size(); ++c)
    cells[c].vertices = {c, c + 1};
  triangulation.create_triangulation(points, cells, dealii::SubCellData());
  seconds.mesh = watch.lap();

  numbering.distribute_dofs(element);
  for (const auto &cell : numbering.active_cell_iterators())
    for (const unsigned side : {0U, 1U})
      if (cell->at_boundary(side))
        end_nodes[side] = static_cast<unsigned>(cell->vertex_dof_index(side, 0));
  dealii::DynamicSparsityPattern dynamic(numbering.n_dofs());
  dealii::DoFTools::make_sparsity_pattern(numbering, dynamic);
  pattern.copy_from(dynamic);
  seconds.degrees_of_freedom = watch.lap();
}

void check(const Rod &rod) {
  if (!(rod.youngs_modulus > 0) || !std::isfinite(rod.youngs_modulus))
    throw InvalidInput(fmt::format("Young's modulus is {} Pa, expected a positive number", rod.youngs_modulus));
  if (!(rod.density > 0) || !std::isfinite(rod.density))
    throw InvalidInput(fmt::format("the density is {} kg/m^3, expected a positive number", rod.density));
  for (const auto &end : rod.ends)
    if (!std::isfinite(end.value))
      throw InvalidInput(fmt::format("{} is prescribed at an end of the rod; expected a finite number", end.value));
  if (rod.ends[0].kind == EndKind::traction && rod.ends[1].kind == EndKind::traction)
    throw InvalidInput("no end of the rod has a prescribed displacement: it may move freely");
}

void assemble_stiffness(const Discretisation &discretisation, dealii::SparseMatrix<double> &stiffness) {
  const dealii::QGauss<1> rule(discretisation.element.degree + 1);
  assemble(
      discretisation, rule, dealii::update_gradients,
      [](const dealii::FEValues<1> &values, unsigned q, unsigned a, unsigned b) {
        return values.shape_grad(a, q)[0] * values.shape_grad(b, q)[0];
      },
      stiffness);
}

void assemble_mass(const Discretisation &discretisation, const dealii::Quadrature<1> &rule,
                   dealii::SparseMatrix<double> &mass) {
  assemble(
      discretisation, rule, dealii::update_values,
      [](const dealii::FEValues<1> &values, unsigned q, unsigned a, unsigned b) {
        return values.shape_value(a, q) * values.shape_value(b, q);
      },
      mass);
}
} // namespace fem_reference::rod
