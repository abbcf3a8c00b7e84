#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::smoothing_functions {

/// Smoothing functions and their conditions, Liu, Liu & Lam 2003, sections 2 and 3: every kernel of the table checked
/// against (22) and (23), the paper's four functions constructed from their conditions, and two of its formulas
/// as printed.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::smoothing_functions
