#pragma once

#include <vector>

namespace fem_test {
/// Squares of the frequencies of the plate 2 x 1 by Rayleigh and Ritz: products of n Legendre polynomials a direction,
/// times (1 - s^2) (1 - t^2) if all sides are clamped. No mesh, no nodes, dense matrices.
std::vector<double> ritz_squares(int n, bool clamped, double lambda, double mu, double density);
} // namespace fem_test
