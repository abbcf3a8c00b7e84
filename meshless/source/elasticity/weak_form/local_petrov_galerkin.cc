#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"

#include "../../parallel/ordered_chunks.h"
#include "../row_assembly.h"
#include "assembler.h"

#include "meshless/linear_algebra/sparse_rows.h"
#include "meshless/linear_algebra/stopwatch.h"
#include "meshless/parallel/threads.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::elasticity::weak_form {

namespace {

/// An evaluation near the particles of one region; it refers to its own filter.
struct RegionEvaluation {
  RegionFilter filter;
  basis::GroupedEvaluation<2> evaluation;

  RegionEvaluation(const Surroundings &surroundings, const cloud::CandidateSearch<2> &search,
                   const basis::ShapeFunctions<2> &basis, std::size_t region)
      : filter(surroundings, search.particles(), region),
        evaluation(basis, search, surroundings.simple() ? nullptr : &filter) {}
  RegionEvaluation(const RegionEvaluation &) = delete;
  RegionEvaluation &operator=(const RegionEvaluation &) = delete;
};

/// The basis must exist at the particles too, where quadrature points never fall: a support that is too small shows
/// there first.
void require_basis_at_particles(const Surroundings &surroundings, const cloud::CandidateSearch<2> &search,
                                const basis::ShapeFunctions<2> &basis) {
  constexpr std::size_t chunk = 512;
  const cloud::Particles<2> &particles = search.particles();
  for (std::size_t r = 0; r < surroundings.n_regions(); ++r) {
    std::vector<Point2> positions;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (static_cast<std::size_t>(particles.region(i)) == r) {
        positions.push_back(particles.position(i));
        numbers.push_back(i);
      }
    // One for each thread, not for each chunk: it goes through all particles when it is made.
    tbb::enumerable_thread_specific<RegionEvaluation> own(
        [&] { return RegionEvaluation(surroundings, search, basis, r); });
    const auto visit = [&](std::size_t begin, std::size_t end) {
      own.local().evaluation.visit(
          std::span(positions).subspan(begin, end - begin), {}, [](const auto &) {}, "particle",
          std::span(numbers).subspan(begin, end - begin));
    };
    if (parallel::threads() > 1)
      try {
        struct Nothing {};
        parallel::in_ordered_chunks<Nothing>(
            positions.size(), chunk, parallel::threads(),
            [&](std::size_t begin, std::size_t end) {
              visit(begin, end);
              return Nothing();
            },
            [](const Nothing &) {});
        continue;
      } catch (const basis::SingularMomentMatrix &) { // all together below: the message is that of one thread
      }
    visit(0, positions.size());
  }
}

Assembler make_assembler(const PlaneProblem &problem, const Surroundings &surroundings,
                         const cloud::CandidateSearch<2> &search, const basis::ShapeFunctions<2> &basis,
                         const Parameters &parameters, const std::shared_ptr<const RepeatedNeighbourhoods> &repeated) {
  Assembler assembler(problem, surroundings, search, basis, parameters);
  assembler.copy_repeated(repeated);
  return assembler;
}

} // namespace

double penalty_factor(const Parameters &parameters, const Material &material, double smoothing_length) {
  const double length =
      parameters.penalty_length == PenaltyLength::domain ? parameters.characteristic_length : smoothing_length;
  return parameters.penalty * material.plane_modulus() / length;
}

double nearest_smoothing_length(const cloud::Particles<2> &particles, std::span<const cloud::Index> candidates,
                                const Point2 &x) {
  // Far above what rounding makes of equal distances, far below a difference that matters.
  constexpr double equal = 1e-9;
  double least = INFINITY;
  for (const auto j : candidates)
    least = std::min(least, cloud::distance_squared<2>(particles.position(static_cast<std::size_t>(j)), x));
  double length = 0;
  for (const auto j : candidates) {
    const auto i = static_cast<std::size_t>(j);
    if (cloud::distance_squared<2>(particles.position(i), x) <= least * (1 + equal))
      length = std::max(length, particles.smoothing_length(i));
  }
  return length;
}

ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis, const Parameters &parameters) {
  problem.check();
  problem.require_inside(*particles);
  linear_algebra::Stopwatch watch;
  const std::size_t n = particles->size();
  const auto surroundings = std::make_shared<const Surroundings>(problem.regions);
  const cloud::CandidateSearch<2> search(*particles, basis->support());
  std::shared_ptr<const RepeatedNeighbourhoods> repeated;
  const auto make = [&] { return make_assembler(problem, *surroundings, search, *basis, parameters, repeated); };
  auto assembler = make();
  repeated = assembler.find_repeated();
  assembler.copy_repeated(repeated);
  assembler.seconds.neighbours = watch.lap();
  require_basis_at_particles(*surroundings, search, *basis);
  assembler.seconds.basis += watch.lap();

  auto solved = assemble_and_solve(assembler, make, n, 2, parameters.solver);
  ParticleSolution solution(std::move(particles), std::move(basis), parameters.derivatives, surroundings,
                            std::move(solved.system.solution));
  solution.set_thermal_strain(problem.thermal_strain);
  solution.set_figures(assembler.seconds, solved.nonzeros, solved.system);
  solution.n_repeated = repeated ? repeated->n_repeated() : 0;
  return solution;
}

LinearSystem linear_system(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                           const basis::ShapeFunctions<2> &basis, const Parameters &parameters) {
  problem.check();
  problem.require_inside(particles);
  const Surroundings surroundings(problem.regions);
  const cloud::CandidateSearch<2> search(particles, basis.support());
  std::shared_ptr<const RepeatedNeighbourhoods> repeated;
  const auto make = [&] { return make_assembler(problem, surroundings, search, basis, parameters, repeated); };
  auto assembler = make();
  repeated = assembler.find_repeated();
  assembler.copy_repeated(repeated);
  require_basis_at_particles(surroundings, search, basis);
  return assemble_system(assembler, make, particles.size(), 2);
}

ParticleSolution solution_of(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                             std::shared_ptr<const basis::ShapeFunctions<2>> basis, const Parameters &parameters,
                             std::vector<double> coefficients) {
  ParticleSolution solution(std::move(particles), std::move(basis), parameters.derivatives,
                            std::make_shared<const Surroundings>(problem.regions), std::move(coefficients));
  solution.set_thermal_strain(problem.thermal_strain);
  return solution;
}

RowSample sample_rows(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                      const basis::ShapeFunctions<2> &basis, const Parameters &parameters, std::size_t n_sampled) {
  problem.check();
  problem.require_inside(particles);
  linear_algebra::Stopwatch watch;
  const Surroundings surroundings(problem.regions);
  const cloud::CandidateSearch<2> search(particles, basis.support());
  Assembler assembler(problem, surroundings, search, basis, parameters);
  const auto repeated = assembler.find_repeated();
  const double once = watch.lap();
  auto sample = elasticity::sample_rows(assembler, particles.size(), 2, n_sampled);
  if (repeated) // copies take next to no time
    sample.seconds *= 1 - static_cast<double>(repeated->n_repeated()) / static_cast<double>(particles.size());
  sample.seconds += once;
  return sample;
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
  const cloud::CandidateSearch<2> search(*particles, basis->support());
  Assembler assembler(problem, *surroundings, search, *basis, parameters);
  assembler.set_densities({densities.begin(), densities.end()});
  assembler.seconds.neighbours = watch.lap();
  require_basis_at_particles(*surroundings, search, *basis);
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
