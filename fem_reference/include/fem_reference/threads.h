#pragma once

namespace fem_reference {

/// Threads that assembly, loads and the loops of multigrid may use from now on, one at first. As BLAS has it, this is a
/// setting of the process: change it between solves, not during one. Every sum keeps its order: the results are the
/// same to the last bit for any number.
///
/// deal.II's own loops (Taylor-Hood elements, natural frequencies, rods) obey from the first call on; until then they
/// take what cores there are. deal.II limits by it every user of TBB in the process.
///
/// With more than one thread PlaneProblem::body_force is called by several at once.
/// @throws InvalidInput unless n >= 1
void set_threads(int n);
int threads();

} // namespace fem_reference
