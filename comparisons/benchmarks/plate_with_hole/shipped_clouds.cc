#include "comparisons/benchmarks/plate_with_hole/shipped_clouds.h"

#include "comparisons/problems/cloud_file.h"
#include "comparisons/program/data_files.h"

#include <fmt/format.h>

#include <stdexcept>

namespace comparisons::benchmarks::plate_with_hole {

std::string shipped_name(std::size_t n_particles) { return fmt::format("plate_with_hole_{}.csv", n_particles); }

problems::Cloud shipped_cloud(std::size_t n_particles) {
  auto file = problems::read_cloud_csv(program::meshes_directory() / shipped_name(n_particles));
  if (file.positions.size() != n_particles || file.spacing.size() != n_particles)
    throw std::runtime_error(fmt::format("{} has {} particles and {} values of h, not {}", shipped_name(n_particles),
                                         file.positions.size(), file.spacing.size(), n_particles));
  return {std::move(file.positions), std::move(file.spacing)};
}

} // namespace comparisons::benchmarks::plate_with_hole
