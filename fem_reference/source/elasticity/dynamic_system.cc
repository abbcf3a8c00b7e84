#include "dynamic_system.h"

#include "../stopwatch.h"
#include "mass.h"
#include "stiffness.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
void check(const PlaneProblem &problem, const PlaneDynamicsOptions &options) {
  check_materials(problem);
  check_conditions(problem);
  if (options.densities.size() != problem.materials.size())
    throw InvalidInput(fmt::format("there are {} densities for {} regions; each region needs one",
                                   options.densities.size(), problem.materials.size()));
  for (const double density : options.densities)
    if (!(density > 0) || !std::isfinite(density))
      throw InvalidInput(fmt::format("a density of {} kg/m^3; expected a positive one", density));
}

int checked_degree(int degree) {
  if (degree < 1 || degree > max_degree)
    throw InvalidInput(fmt::format("element degree {}: expected 1 to {}", degree, max_degree));
  return degree;
}
} // namespace

DynamicSystem::DynamicSystem(const PlaneProblem &problem, const PlaneDynamicsOptions &options)
    : discretisation(
          discretise(problem.mesh, checked_degree(options.degree), seconds.mesh, seconds.degrees_of_freedom)),
      stiffness(discretisation.n_nodes(), discretisation.cell_start, discretisation.cell_nodes), mass(stiffness) {
  check(problem, options);
  Stopwatch watch;
  essential = essential_data(problem, discretisation, FreeMotions::allowed);
  for (const double value : essential.values)
    if (value != 0)
      throw InvalidInput(fmt::format("a displacement of {} m is prescribed; in motion supports must be at rest, with "
                                     "prescribed displacements of zero",
                                     value));
  assemble_stiffness(discretisation, problem.materials, stiffness);
  force = loads(problem, discretisation).nodal;
  eliminate(essential, stiffness, force);
  if (options.mass == Mass::lumped) {
    const auto nodal = lumped_mass(discretisation, options.densities);
    set_diagonal(nodal, mass);
    for (std::size_t i = 0; i < force.size(); ++i)
      diagonal_mass.push_back(essential.prescribed[i] != 0 ? 0 : nodal[i / 2]);
  } else
    assemble_mass(discretisation, options.densities, mass);
  std::vector<double> unused(force.size(), 0);
  eliminate(essential, mass, unused);
  for (std::size_t r = 0; r < problem.materials.size(); ++r) {
    const auto &material = problem.materials[r];
    wave_speed = std::max(wave_speed, std::sqrt((material.lambda() + 2 * material.mu()) / options.densities[r]));
  }
  seconds.assembly = watch.lap();
}

std::unique_ptr<linear_algebra::DirectSolver> DynamicSystem::factorise(double mass_factor,
                                                                       double stiffness_factor) const {
  linear_algebra::BlockMatrix sum = stiffness;
  for (std::size_t k = 0; k < sum.values.size(); ++k)
    sum.values[k] = stiffness_factor * stiffness.values[k] + mass_factor * mass.values[k];
  try {
    return linear_algebra::factorise_cholesky(sum);
  } catch (const linear_algebra::PivotFailure &failure) {
    throw SolveFailure(fmt::format("the sum of stiffness and mass of {} unknowns is not positive definite: {}",
                                   sum.n_rows(), failure.reason));
  }
}
} // namespace fem_reference::elasticity
