#include "meshless/elasticity/mixed_form/displacement_pressure.h"

#include "assembler.h"

#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::elasticity::mixed_form {

ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> displacement_basis,
                       std::shared_ptr<const basis::ShapeFunctions<2>> pressure_basis, const Parameters &parameters) {
  if (displacement_basis->order() < 2 || pressure_basis->order() < 1)
    throw std::invalid_argument(fmt::format("the mixed method needs a displacement of order 2 and a pressure of order "
                                            "1 at least, not {} and {}",
                                            displacement_basis->order(), pressure_basis->order()));
  problem.check();
  problem.require_inside(*particles);
  linear_algebra::Stopwatch watch;
  const std::size_t n = particles->size();
  const auto surroundings = std::make_shared<const Surroundings>(problem.regions);
  Assembler assembler(problem, *surroundings, *particles, *displacement_basis, *pressure_basis, parameters);
  assembler.seconds.neighbours = watch.lap();

  linear_algebra::SparseRows matrix(3 * static_cast<std::int64_t>(n));
  std::vector<double> right_hand_side;
  right_hand_side.reserve(3 * n);
  for (std::size_t i = 0; i < n; ++i)
    assembler.assemble(i, matrix, right_hand_side);
  watch.lap();
  const auto divisors = matrix.equilibrate_rows();
  for (std::size_t row = 0; row < divisors.size(); ++row)
    right_hand_side[row] /= divisors[row];
  assembler.seconds.assembly += watch.lap();
  const auto lu = linear_algebra::solve_lu(matrix, right_hand_side);
  assembler.seconds.solve = watch.lap();

  std::vector<double> displacement(2 * n);
  PressureField pressure{std::move(pressure_basis), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    displacement[2 * i] = lu.solution[3 * i];
    displacement[2 * i + 1] = lu.solution[3 * i + 1];
    const double mu = surroundings->material(static_cast<std::size_t>(particles->region(i))).shear();
    pressure.coefficients[i] = mu * lu.solution[3 * i + 2];
  }
  const double backward = linear_algebra::backward_error(matrix, lu.solution, right_hand_side);
  ParticleSolution solution(std::move(particles), std::move(displacement_basis), DerivativeRule::direct, surroundings,
                            std::move(displacement));
  solution.set_pressure(std::move(pressure));
  solution.seconds = assembler.seconds;
  solution.nonzeros = matrix.nonzeros();
  solution.backward_error = backward;
  solution.reciprocal_condition = lu.reciprocal_condition;
  return solution;
}

} // namespace meshless::elasticity::mixed_form
