#pragma once

#include "../linear_algebra/block_matrix.h"
#include "discretisation.h"
#include "fem_reference/elasticity/material.h"

namespace fem_reference::elasticity {
/// Add the stiffness of all cells to the (zero) matrix, with unknown = 2 node + component:
///   K(a r, b s) = integral of lambda N_a,r N_b,s + mu (N_a,s N_b,r + delta_rs N_a,k N_b,k).
/// `materials` are those of the regions. Throws InvalidInput if the Jacobian is not positive at a quadrature point,
/// with the cell's index and position.
void assemble_stiffness(const Discretisation &discretisation, std::span<const Material> materials,
                        linear_algebra::BlockMatrix &matrix);

/// Throws InvalidInput naming the cell, where it is and what helps: its Jacobian is not positive at a quadrature point.
[[noreturn]] void refuse_jacobian(const Discretisation &discretisation, std::size_t cell);

/// K u cell by cell from the stress (2 mu eps + p I with the pressure of a mixed method), without the matrix, and the
/// strain energy u K u / 2, both per m of thickness. The displacement enters through its differences within each cell,
/// so that the rounding error is that of the strain and not of u / h: one correction with this residual removes most of
/// what a factorised matrix leaves.
struct InternalForces {
  std::vector<double> forces;
  double energy = 0;
};
InternalForces internal_forces(const Discretisation &discretisation, std::span<const Material> materials,
                               std::span<const double> displacement, std::span<const double> cell_pressure = {});
} // namespace fem_reference::elasticity
