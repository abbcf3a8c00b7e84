#include "meshless/elasticity/mixed_form/displacement_pressure.h"

#include "../row_assembly.h"
#include "assembler.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::elasticity::mixed_form {

namespace {

void check_orders(const basis::ShapeFunctions<2> &displacement, const basis::ShapeFunctions<2> &pressure) {
  if (displacement.order() < 2 || pressure.order() < 1)
    throw std::invalid_argument(fmt::format("the mixed method needs a displacement of order 2 and a pressure of order "
                                            "1 at least, not {} and {}",
                                            displacement.order(), pressure.order()));
}

} // namespace

ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> displacement_basis,
                       std::shared_ptr<const basis::ShapeFunctions<2>> pressure_basis, const Parameters &parameters) {
  check_orders(*displacement_basis, *pressure_basis);
  problem.check();
  problem.require_inside(*particles);
  linear_algebra::Stopwatch watch;
  const std::size_t n = particles->size();
  const auto surroundings = std::make_shared<const Surroundings>(problem.regions);
  const auto make = [&] {
    return Assembler(problem, *surroundings, *particles, *displacement_basis, *pressure_basis, parameters);
  };
  auto assembler = make();
  assembler.seconds.neighbours = watch.lap();

  linear_algebra::SolverRequest request(linear_algebra::SystemSolver::direct);
  request.ordering = parameters.ordering;
  const auto solved = assemble_and_solve(assembler, make, n, 3, request);

  std::vector<double> displacement(2 * n);
  PressureField pressure{std::move(pressure_basis), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    displacement[2 * i] = solved.system.solution[3 * i];
    displacement[2 * i + 1] = solved.system.solution[3 * i + 1];
    const double mu = surroundings->material(static_cast<std::size_t>(particles->region(i))).shear();
    pressure.coefficients[i] = mu * solved.system.solution[3 * i + 2];
  }
  ParticleSolution solution(std::move(particles), std::move(displacement_basis), DerivativeRule::direct, surroundings,
                            std::move(displacement));
  solution.set_pressure(std::move(pressure));
  solution.set_figures(assembler.seconds, solved.nonzeros, solved.system);
  return solution;
}

RowSample sample_rows(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                      const basis::ShapeFunctions<2> &displacement_basis,
                      const basis::ShapeFunctions<2> &pressure_basis, const Parameters &parameters,
                      std::size_t n_sampled) {
  check_orders(displacement_basis, pressure_basis);
  problem.check();
  problem.require_inside(particles);
  linear_algebra::Stopwatch watch;
  const Surroundings surroundings(problem.regions);
  Assembler assembler(problem, surroundings, particles, displacement_basis, pressure_basis, parameters);
  const double once = watch.lap();
  auto sample = elasticity::sample_rows(assembler, particles.size(), 3, n_sampled);
  sample.seconds += once;
  return sample;
}

} // namespace meshless::elasticity::mixed_form
