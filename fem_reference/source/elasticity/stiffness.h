#pragma once

#include "../linear_algebra/block_matrix.h"
#include "discretisation.h"
#include "fem_reference/elasticity/material.h"

namespace fem_reference::elasticity {
/// Add the stiffness of all cells to the (zero) matrix, with unknown = 2 node + component:
///   K(a r, b s) = integral of lambda N_a,r N_b,s + mu (N_a,s N_b,r + delta_rs N_a,k N_b,k).
/// Throws InvalidInput if the Jacobian is not positive at a quadrature point, with the cell's index.
void assemble_stiffness(const Discretisation &discretisation, const Material &material,
                        linear_algebra::BlockMatrix &matrix);

/// load - K u, cell by cell from the stress, without the matrix. The displacement enters through its
/// differences within each cell, so that the rounding error is that of the strain and not of u / h:
/// one correction with this residual removes most of what a factorised matrix leaves.
std::vector<double> residual_by_cells(const Discretisation &discretisation, const Material &material,
                                      std::span<const double> displacement, std::span<const double> load);
} // namespace fem_reference::elasticity
