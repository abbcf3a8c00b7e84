#pragma once

#include "fem_reference/gas/discontinuous_galerkin.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgp.h>
#include <deal.II/grid/tria.h>

namespace fem_reference::gas {

/// Mesh, numbering and integrals of discontinuous elements on a tube: FE_DGP of degree 0 or 1, whose Legendre
/// polynomials make the mass matrix diagonal. All arrays are ordered by cells from the left to the right; the second
/// entry of a pair is of the linear function and unused for degree 0.
struct Discretisation {
  Discretisation(const Tube &tube, int degree);

  dealii::Triangulation<1> triangulation;
  dealii::FE_DGP<1> element;
  dealii::DoFHandler<1> numbering;

  std::vector<double> ends;                        ///< m, one more than cells
  std::vector<double> centres;                     ///< m
  std::vector<std::array<double, 2>> inverse_mass; ///< of the two functions, 1 / m
  // Of the linear function, zero for degree 0: at the two ends of a cell, at its Gauss points, and phi,x JxW there,
  // which does not depend on the cell's width.
  std::array<double, 2> traces{}, point_values{}, gradient_weights{};
  /// Coefficients of the projection of the initial state.
  std::vector<std::array<Conserved, 2>> initial;
};

} // namespace fem_reference::gas
