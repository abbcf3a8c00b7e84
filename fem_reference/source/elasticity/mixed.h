#pragma once

#include "boundary_conditions.h"
#include "discretisation.h"
#include "fem_reference/elasticity/material.h"

#include <span>
#include <vector>

namespace fem_reference::elasticity {
/// What the mixed system gave.
struct MixedResult {
  std::vector<double> displacement; ///< unknown = 2 node + component
  /// Pressure p = lambda div u at the nodes of every cell, as cell_nodes: it jumps between regions. Pa.
  std::vector<double> cell_pressure;
  std::size_t n_dofs = 0;
  std::size_t nonzeros = 0;
  double backward_error = 0; ///< maximum norms
};

/// Taylor-Hood elements: displacement of degree 2, continuous pressure of degree 1 within each region, Taylor & Hood
/// 1973:
///   integral of 2 mu eps(u) : eps(v) + p div v = loads(v),   integral of q (c1 div u - c2 p) = 0,
/// c2 = 1 / (lambda + 2 mu), c1 = lambda c2: p = lambda div u, and no coefficient is infinite for nu -> 1/2.
/// Unknowns of the pressure are p / mu. Solved by UMFPACK.
/// @throws SolveFailure if the factorisation fails, InvalidInput for an inverted cell or a degree that is not 2
MixedResult solve_mixed(const Discretisation &discretisation, std::span<const Material> materials,
                        const EssentialData &essential, const Loads &loads);
} // namespace fem_reference::elasticity
