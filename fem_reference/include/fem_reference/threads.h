#pragma once

namespace fem_reference {

/// Threads that assembly, the products of multigrid and the loops of deal.II may use from now on, one at first. As BLAS
/// has it, this is a setting of the process: change it between solves, not during one. Every sum keeps its order: the
/// results are the same to the last bit for any number.
///
/// With more than one thread PlaneProblem::body_force is called by several at once, on cells each its own.
/// @throws InvalidInput unless n >= 1
void set_threads(int n);
int threads();

} // namespace fem_reference
