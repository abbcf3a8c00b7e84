#pragma once

#include "comparisons/methods/method_table.h"

#include "fem_reference/elasticity/plane_elasticity.h"

namespace comparisons::methods {

/// The finite-element reference: isoparametric Q1 to Q4 by deal.II.
Method fem();

/// The statement on a mesh in the words of the reference.
fem_reference::elasticity::PlaneProblem reference_problem(const problems::PlaneStatement &statement,
                                                          problems::Mesh mesh);

} // namespace comparisons::methods
