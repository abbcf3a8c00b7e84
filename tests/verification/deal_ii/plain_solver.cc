#include "plain_solver.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/matrix_tools.h>

#include <algorithm>
#include <memory>

namespace plain_deal_ii {

namespace {

using namespace fem_reference::elasticity;

void make_triangulation(const fem_reference::mesh::PlaneMesh &mesh, dealii::Triangulation<2> &triangulation) {
  std::vector<dealii::Point<2>> vertices;
  for (const auto &x : mesh.vertices)
    vertices.emplace_back(x[0], x[1]);
  std::vector<dealii::CellData<2>> cells;
  for (const auto &cell : mesh.cells) {
    dealii::CellData<2> data(cell.n_vertices);
    for (unsigned k = 0; k < cell.n_vertices; ++k)
      data.vertices[k] = cell.vertices[k];
    if (cell.n_vertices == 4) // deal.II counts in rows
      std::swap(data.vertices[2], data.vertices[3]);
    cells.push_back(data);
  }
  dealii::SubCellData boundary;
  for (const auto &edge : mesh.boundary) {
    dealii::CellData<1> data(2);
    data.vertices = {edge.vertices[0], edge.vertices[1]};
    data.boundary_id = static_cast<dealii::types::boundary_id>(edge.id);
    if (edge.arc_centre) {
      data.manifold_id = static_cast<dealii::types::manifold_id>(edge.id);
      triangulation.set_manifold(data.manifold_id, dealii::SphericalManifold<2>(
                                                       dealii::Point<2>((*edge.arc_centre)[0], (*edge.arc_centre)[1])));
    }
    boundary.boundary_lines.push_back(data);
  }
  if (mesh.cells.front().n_vertices == 4)
    dealii::GridTools::consistently_order_cells(cells);
  triangulation.create_triangulation(vertices, cells, boundary);
}

/// All of one solve.
class Program {
public:
  Program(const PlaneProblem &problem, unsigned degree) : problem_(problem) {
    triangles_ = problem.mesh.cells.front().n_vertices == 3;
    make_triangulation(problem.mesh, triangulation_);
    if (triangles_) {
      element_ = std::make_unique<dealii::FESystem<2>>(dealii::FE_SimplexP<2>(degree), 2);
      mapping_ = std::make_unique<dealii::MappingFE<2>>(dealii::FE_SimplexP<2>(1));
      cell_rule_ = dealii::QGaussSimplex<2>(degree + 1);
      load_rule_ = dealii::QGaussSimplex<2>(degree + 2);
      face_rule_ = dealii::QGaussSimplex<1>(degree + 2);
    } else {
      element_ = std::make_unique<dealii::FESystem<2>>(dealii::FE_Q<2>(degree), 2);
      mapping_ = std::make_unique<dealii::MappingQ<2>>(degree);
      cell_rule_ = dealii::QGauss<2>(degree + 1);
      load_rule_ = dealii::QGauss<2>(degree + 2);
      face_rule_ = dealii::QGauss<1>(degree + 2);
    }
    dofs_.reinit(triangulation_);
    dofs_.distribute_dofs(*element_);
  }

  std::vector<Vector> solve() {
    dealii::DynamicSparsityPattern pattern(dofs_.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dofs_, pattern);
    dealii::SparsityPattern sparsity;
    sparsity.copy_from(pattern);
    matrix_.reinit(sparsity);
    load_.reinit(dofs_.n_dofs());
    dealii::Vector<double> solution(dofs_.n_dofs());
    assemble_cells();
    if (problem_.body_force)
      assemble_body_force();
    assemble_tractions();
    auto essential = essential_values();
    dealii::MatrixTools::apply_boundary_values(essential, matrix_, solution, load_);
    dealii::SparseDirectUMFPACK lu;
    lu.initialize(matrix_);
    lu.vmult(solution, load_);
    // The first dofs of a cell are those of its vertices, whatever the element.
    std::vector<Vector> result(problem_.mesh.vertices.size());
    for (const auto &cell : dofs_.active_cell_iterators())
      for (const unsigned v : cell->vertex_indices())
        for (unsigned k = 0; k < 2; ++k)
          result[cell->vertex_index(v)][k] = solution(cell->vertex_dof_index(v, k));
    return result;
  }

private:
  void assemble_cells() {
    const auto &material = problem_.materials.front();
    dealii::FEValues<2> values(*mapping_, *element_, cell_rule_, dealii::update_gradients | dealii::update_JxW_values);
    const unsigned n = element_->n_dofs_per_cell();
    dealii::FullMatrix<double> local(n, n);
    std::vector<dealii::types::global_dof_index> indices(n);
    const dealii::FEValuesExtractors::Vector u(0);
    for (const auto &cell : dofs_.active_cell_iterators()) {
      values.reinit(cell);
      cell->get_dof_indices(indices);
      local = 0;
      for (const unsigned q : values.quadrature_point_indices()) {
        for (unsigned i = 0; i < n; ++i) {
          for (unsigned j = 0; j < n; ++j)
            local(i, j) +=
                values.JxW(q) *
                (material.lambda() * values[u].divergence(i, q) * values[u].divergence(j, q) +
                 2 * material.mu() * (values[u].symmetric_gradient(i, q) * values[u].symmetric_gradient(j, q)));
        }
      }
      matrix_.add(indices, local);
    }
  }

  void assemble_body_force() {
    dealii::FEValues<2> values(*mapping_, *element_, load_rule_,
                               dealii::update_values | dealii::update_JxW_values | dealii::update_quadrature_points);
    std::vector<dealii::types::global_dof_index> indices(element_->n_dofs_per_cell());
    const dealii::FEValuesExtractors::Vector u(0);
    for (const auto &cell : dofs_.active_cell_iterators()) {
      values.reinit(cell);
      cell->get_dof_indices(indices);
      for (const unsigned q : values.quadrature_point_indices()) {
        const Point x{values.quadrature_point(q)[0], values.quadrature_point(q)[1]};
        Vector force{};
        problem_.body_force({&x, 1}, {&force, 1});
        for (unsigned i = 0; i < indices.size(); ++i)
          for (unsigned k = 0; k < 2; ++k)
            load_(indices[i]) += values.JxW(q) * values[u].value(i, q)[k] * force[k];
      }
    }
  }

  void assemble_tractions() {
    dealii::FEFaceValues<2> values(*mapping_, *element_, face_rule_,
                                   dealii::update_values | dealii::update_JxW_values | dealii::update_normal_vectors |
                                       dealii::update_quadrature_points);
    std::vector<dealii::types::global_dof_index> indices(element_->n_dofs_per_cell());
    const dealii::FEValuesExtractors::Vector u(0);
    for (const auto &cell : dofs_.active_cell_iterators())
      for (const unsigned f : cell->face_indices()) {
        if (!cell->face(f)->at_boundary())
          continue;
        const auto &condition = problem_.boundary.at(static_cast<int>(cell->face(f)->boundary_id()));
        if (!condition.traction)
          continue;
        values.reinit(cell, f);
        cell->get_dof_indices(indices);
        for (const unsigned q : values.quadrature_point_indices()) {
          const Point x{values.quadrature_point(q)[0], values.quadrature_point(q)[1]};
          const Vector normal{values.normal_vector(q)[0], values.normal_vector(q)[1]};
          Vector traction{};
          condition.traction({&x, 1}, {&normal, 1}, {&traction, 1});
          for (unsigned i = 0; i < indices.size(); ++i)
            for (unsigned k = 0; k < 2; ++k)
              if (condition.kind[k] == ConditionKind::traction)
                load_(indices[i]) += values.JxW(q) * values[u].value(i, q)[k] * traction[k];
        }
      }
  }

  std::map<dealii::types::global_dof_index, double> essential_values() {
    std::map<dealii::types::global_dof_index, dealii::Point<2>> places;
    dealii::DoFTools::map_dofs_to_support_points(*mapping_, dofs_, places);
    std::map<dealii::types::global_dof_index, double> result;
    for (const auto &[id, condition] : problem_.boundary)
      for (unsigned k = 0; k < 2; ++k) {
        if (condition.kind[k] != ConditionKind::displacement)
          continue;
        std::vector<bool> component(2, false);
        component[k] = true;
        const auto on_boundary = dealii::DoFTools::extract_boundary_dofs(dofs_, dealii::ComponentMask(component),
                                                                         {static_cast<dealii::types::boundary_id>(id)});
        for (const auto dof : on_boundary) {
          const Point x{places.at(dof)[0], places.at(dof)[1]};
          Vector value{};
          condition.displacement({&x, 1}, {&value, 1});
          result[dof] = value[k];
        }
      }
    return result;
  }

  const PlaneProblem &problem_;
  bool triangles_ = false;
  dealii::Triangulation<2> triangulation_;
  std::unique_ptr<dealii::FESystem<2>> element_;
  std::unique_ptr<dealii::Mapping<2>> mapping_;
  dealii::Quadrature<2> cell_rule_;
  dealii::Quadrature<2> load_rule_;
  dealii::Quadrature<1> face_rule_;
  dealii::DoFHandler<2> dofs_;
  dealii::SparseMatrix<double> matrix_;
  dealii::Vector<double> load_;
};

} // namespace

std::vector<Vector> displacement_at_vertices(const PlaneProblem &problem, unsigned degree) {
  return Program(problem, degree).solve();
}

} // namespace plain_deal_ii
