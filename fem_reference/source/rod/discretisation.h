#pragma once

#include "fem_reference/rod/elastic_rod.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

namespace fem_reference::rod {

/// Mesh, numbering and elements of a rod.
///
/// Lengths are measured from the middle of the rod in units of half its length, so that neither a far
/// origin nor the unit costs digits.
struct Discretisation {
  /// @throws InvalidInput
  Discretisation(const std::vector<double> &vertices, int degree);

  double to_local(double x) const { return (x - middle) / half_length; }
  double to_global(double local) const { return middle + half_length * local; }
  unsigned end_node(int side) const { return end_nodes[side]; }

  std::vector<double> vertices; ///< m
  double middle = 0;            ///< m
  double half_length = 1;       ///< m
  dealii::Triangulation<1> triangulation;
  dealii::FE_Q<1> element;
  dealii::DoFHandler<1> numbering;
  dealii::SparsityPattern pattern;
  std::array<unsigned, 2> end_nodes{};
  Seconds seconds;
};

/// @throws InvalidInput for Young's modulus, density or end conditions
void check(const Rod &rod);

/// K in local lengths: its entries times E / half_length are those of the rod.
void assemble_stiffness(const Discretisation &discretisation, dealii::SparseMatrix<double> &stiffness);

/// M in local lengths: times density * half_length. `rule` decides between lumped and consistent.
void assemble_mass(const Discretisation &discretisation, const dealii::Quadrature<1> &rule,
                   dealii::SparseMatrix<double> &mass);

} // namespace fem_reference::rod
