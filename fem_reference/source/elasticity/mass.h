#pragma once

#include "../linear_algebra/block_matrix.h"
#include "discretisation.h"

#include <span>
#include <vector>

namespace fem_reference::elasticity {
/// Add the consistent mass of all cells, the integral of rho N_a N_b for both components; kg per m of thickness.
void assemble_mass(const Discretisation &discretisation, std::span<const double> densities,
                   linear_algebra::BlockMatrix &matrix);

/// The diagonal mass of every node, see Mass::lumped.
std::vector<double> lumped_mass(const Discretisation &discretisation, std::span<const double> densities);

/// Write the diagonal mass into a zero matrix.
void set_diagonal(std::span<const double> nodal_mass, linear_algebra::BlockMatrix &matrix);
} // namespace fem_reference::elasticity
