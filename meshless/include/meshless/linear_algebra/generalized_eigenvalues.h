#pragma once

#include "meshless/linear_algebra/sparse_rows.h"

#include <complex>
#include <cstddef>
#include <vector>

namespace meshless::linear_algebra {

/// Eigenvalues of K x = lambda M x, where neither needs to be symmetric and M may be singular, by
/// theta = 1 / (lambda - shift) of (K - shift M)^-1 M (sparse LU). Infinite ones, of the rows in which M is empty, are
/// left out.
///
/// @param shift not an eigenvalue; those next to it are found best
/// @return by real part, then imaginary part
/// @throws SolveError if K - shift M is singular; std::invalid_argument if sizes do not fit
std::vector<std::complex<double>> generalized_eigenvalues(const SparseRows &stiffness, const SparseRows &mass,
                                                          double shift);

/// Of the same only the `wanted` ones nearest to the shift: Arnoldi's iteration from four start vectors, so that
/// eigenvalues up to four times repeated are found, until the residual of all is below 1e-10 |theta|.
/// @throws std::runtime_error if 400 vectors do not suffice
std::vector<std::complex<double>> nearest_eigenvalues(const SparseRows &stiffness, const SparseRows &mass, double shift,
                                                      std::size_t wanted);

} // namespace meshless::linear_algebra
