#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::solvers {

/// Linear solvers on one and the same system: those of weak1 on the cantilever and on the plate with a hole, solved by
/// sparse LU and by Krylov methods with their orderings and preconditioners, among them smoothed aggregation of
/// Trilinos ML with rigid-body modes.
///
/// A cell's errors: algebraic_error, |x - x*|_2 / |x*|_2 of the coefficients, where x* is the tightest solution there
/// is: sparse LU refined with residuals in extended precision. Its quantities: discretisation_error, the relative L2
/// error of x*'s displacement; algebraic_over_discretisation, which the rule wants to be at most .01; backward_error,
/// solver_iterations, estimated_error (what the solver itself says of its algebraic error), factor_bytes where known.
/// `parameters.chosen` is true for what the methods take by themselves at this size.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::solvers
