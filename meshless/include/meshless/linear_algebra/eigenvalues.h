#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace meshless::linear_algebra {

/// Eigenvalues of a dense real matrix that need not be symmetric: Householder reduction to Hessenberg
/// form and shifted QR (Eigen), about 10 n^3 operations.
/// @param matrix n x n entries, row by row
/// @return all n, ordered by real part and then imaginary part; complex ones come in conjugate pairs
/// @throws std::invalid_argument if the size does not fit or an entry is not finite;
///   std::runtime_error if the iteration does not converge
std::vector<std::complex<double>> eigenvalues(std::span<const double> matrix, std::size_t n);

/// Largest absolute imaginary part.
double largest_imaginary_part(std::span<const std::complex<double>> eigenvalues);

} // namespace meshless::linear_algebra
