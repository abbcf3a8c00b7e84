#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace comparisons::benchmarks::function_approximation {

/// Particles on the unit interval, square or cube, with the volume (m/rho) and the local spacing of each.
template <int dim>
struct Arrangement {
  std::vector<std::array<double, dim>> positions;
  std::vector<double> volumes;
  std::vector<double> spacing;
};

/// Particles along each axis, `n` of them, and their tensor product:
/// - uniform: cell-centred, x_i = (i - 1/2) / n (what the papers' tables need);
/// - graded: gaps D (1 + 0.2 (i - 1)), i = 1 ... n - 1, from end to end, volumes between midpoints; the gap
///   law printed with Zhang & Batra's Fig. 4, D (i + 0.2 (i - 1)), leaves supports of two particles;
/// - jittered: uniform, each moved by at most `jitter` spacings in each direction.
/// @throws std::invalid_argument for another name or fewer than 3 particles
template <int dim>
Arrangement<dim> arrange(const std::string &name, int n, double jitter, std::uint64_t seed);

} // namespace comparisons::benchmarks::function_approximation
