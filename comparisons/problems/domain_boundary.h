#pragma once

#include "comparisons/problems/plane_problem.h"

#include "meshless/domain/boundary.h"

#include <span>

namespace comparisons::problems {

/// The boundary of a region as the particle library has it.
/// @throws std::invalid_argument if the pieces do not close or cross
meshless::domain::Boundary domain_boundary(std::span<const BoundaryPiece> pieces);

} // namespace comparisons::problems
