#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"

#include "assembler.h"

#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/sparse_rows.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::elasticity::weak_form {

namespace {

/// The basis must exist at the particles too, where quadrature points never fall: a support that is too small shows
/// there first.
void require_basis_at_particles(const Surroundings &surroundings, const cloud::Particles<2> &particles,
                                const basis::ShapeFunctions<2> &basis) {
  const cloud::CandidateSearch<2> search(particles, basis.support());
  for (std::size_t r = 0; r < surroundings.n_regions(); ++r) {
    std::vector<Point2> own;
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (static_cast<std::size_t>(particles.region(i)) == r)
        own.push_back(particles.position(i));
    RegionFilter filter(surroundings, particles, r);
    if (!own.empty())
      basis::GroupedEvaluation<2>(basis, search, surroundings.simple() ? nullptr : &filter)
          .visit(
              own, {}, [](const auto &) {}, "particle");
  }
}

} // namespace

ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis, const Parameters &parameters) {
  problem.check();
  problem.require_inside(*particles);
  linear_algebra::Stopwatch watch;
  const std::size_t n = particles->size();
  const auto surroundings = std::make_shared<const Surroundings>(problem.regions);
  Assembler assembler(problem, *surroundings, *particles, *basis, parameters);
  assembler.seconds.neighbours = watch.lap();
  require_basis_at_particles(*surroundings, *particles, *basis);
  assembler.seconds.basis += watch.lap();

  linear_algebra::SparseRows matrix(2 * static_cast<std::int64_t>(n));
  std::vector<double> right_hand_side;
  right_hand_side.reserve(2 * n);
  for (std::size_t i = 0; i < n; ++i)
    assembler.assemble(i, matrix, right_hand_side);
  watch.lap();
  const auto divisors = matrix.equilibrate_rows();
  for (std::size_t row = 0; row < divisors.size(); ++row)
    right_hand_side[row] /= divisors[row];
  assembler.seconds.assembly += watch.lap();
  auto lu = linear_algebra::solve_lu(matrix, right_hand_side);
  assembler.seconds.solve = watch.lap();

  const double backward = linear_algebra::backward_error(matrix, lu.solution, right_hand_side);
  ParticleSolution solution(std::move(particles), std::move(basis), parameters.derivatives, surroundings,
                            std::move(lu.solution));
  solution.set_thermal_strain(problem.thermal_strain);
  solution.seconds = assembler.seconds;
  solution.nonzeros = matrix.nonzeros();
  solution.backward_error = backward;
  solution.reciprocal_condition = lu.reciprocal_condition;
  return solution;
}

RowSample sample_rows(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                      const basis::ShapeFunctions<2> &basis, const Parameters &parameters, std::size_t n_sampled) {
  problem.check();
  problem.require_inside(particles);
  const std::size_t n = particles.size();
  n_sampled = std::min(n_sampled, n);
  if (n_sampled == 0)
    return {};
  linear_algebra::Stopwatch watch;
  const Surroundings surroundings(problem.regions);
  Assembler assembler(problem, surroundings, particles, basis, parameters);
  const double once = watch.lap();
  linear_algebra::SparseRows matrix(2 * static_cast<std::int64_t>(n));
  std::vector<double> right_hand_side;
  for (std::size_t k = 0; k < n_sampled; ++k)
    assembler.assemble(k * n / n_sampled, matrix, right_hand_side);
  const double factor = static_cast<double>(n) / static_cast<double>(n_sampled);
  return {factor * static_cast<double>(matrix.nonzeros()), once + factor * watch.lap()};
}

EquationsOfMotion equations_of_motion(const PlaneProblem &problem, std::span<const double> densities,
                                      std::shared_ptr<const cloud::Particles<2>> particles,
                                      std::shared_ptr<const basis::ShapeFunctions<2>> basis,
                                      const Parameters &parameters) {
  problem.check(true);
  problem.require_inside(*particles);
  if (densities.size() != problem.regions.size())
    throw std::invalid_argument(
        fmt::format("there are {} densities for {} regions", densities.size(), problem.regions.size()));
  for (const double density : densities)
    if (!(density > 0) || !std::isfinite(density))
      throw std::invalid_argument(fmt::format("a density of {} kg/m^3; it must be positive", density));
  linear_algebra::Stopwatch watch;
  const std::size_t n = particles->size();
  const auto surroundings = std::make_shared<const Surroundings>(problem.regions);
  Assembler assembler(problem, *surroundings, *particles, *basis, parameters);
  assembler.set_densities({densities.begin(), densities.end()});
  assembler.seconds.neighbours = watch.lap();
  require_basis_at_particles(*surroundings, *particles, *basis);
  assembler.seconds.basis += watch.lap();
  EquationsOfMotion equations{linear_algebra::SparseRows(2 * static_cast<std::int64_t>(n)),
                              linear_algebra::SparseRows(2 * static_cast<std::int64_t>(n)),
                              {},
                              particles,
                              basis,
                              surroundings,
                              parameters.derivatives,
                              {}};
  for (std::size_t i = 0; i < n; ++i) {
    assembler.assemble(i, equations.stiffness, equations.force);
    assembler.append_mass_rows(equations.mass);
  }
  equations.seconds = assembler.seconds;
  return equations;
}

} // namespace meshless::elasticity::weak_form
