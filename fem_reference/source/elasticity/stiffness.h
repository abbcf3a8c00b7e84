#pragma once

#include "../linear_algebra/block_matrix.h"
#include "discretisation.h"
#include "fem_reference/elasticity/material.h"

namespace fem_reference::elasticity
{
/// Add the stiffness of all cells to the (zero) matrix, with unknown = 2 node + component:
///   K(a r, b s) = integral of lambda N_a,r N_b,s + mu (N_a,s N_b,r + delta_rs N_a,k N_b,k).
/// Throws InvalidInput if the Jacobian is not positive at a quadrature point, with the cell's index.
void assemble_stiffness(const Discretisation &discretisation,
                        const Material &material,
                        linear_algebra::BlockMatrix &matrix);
} // namespace fem_reference::elasticity
