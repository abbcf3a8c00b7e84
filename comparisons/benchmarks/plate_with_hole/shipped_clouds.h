#pragma once

#include "comparisons/problems/plane_problem.h"

#include <array>
#include <cstdint>

namespace comparisons::benchmarks::plate_with_hole {

/// Clouds that stand as files in meshes/.
inline constexpr std::array<std::size_t, 4> shipped_sizes{188, 686, 2600, 5200};
/// Seed of the shipped clouds.
inline constexpr std::uint64_t shipped_seed = 0;

/// "plate_with_hole_188.csv"
std::string shipped_name(std::size_t n_particles);

/// The cloud of a file in meshes/, for the radius 1 m and the half length and width 3 m.
/// @throws std::runtime_error if the file is missing, problems::CloudFileError if it is damaged
problems::Cloud shipped_cloud(std::size_t n_particles);

} // namespace comparisons::benchmarks::plate_with_hole
