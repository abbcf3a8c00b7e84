#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::function_approximation {

/// Kernel estimates of a function and its derivatives by any basis and kernel, Zhang & Batra 2008,
/// sections 6.1 and 6.2, beside the finite-element interpolant with the same number of unknowns.
///
/// Errors of function (l2), first derivatives (h1) and second derivatives (h2), each alone (seminorms, as in
/// the paper): `*_sum` are the paper's sums over particles, sqrt(sum_i V_i e_i^2); without it the true
/// integrals by Gauss quadrature.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::function_approximation
