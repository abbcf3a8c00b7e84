#include "comparisons/methods/particle_field.h"

#include "comparisons/methods/recoveries.h"
#include "comparisons/methods/solver_keys.h"

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/elasticity/cloud_quality.h"
#include "meshless/elasticity/surroundings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace comparisons::methods {

namespace elasticity = meshless::elasticity;

CloudReport cloud_report(const Prepared &prepared) {
  const auto quality = elasticity::cloud_quality(elasticity::Surroundings(prepared.problem.regions),
                                                 *prepared.particles, *prepared.basis, prepared.test_radius);
  return {.order = prepared.basis->order(),
          .fewest_neighbours = quality.fewest_neighbours,
          .median_neighbours = quality.median_neighbours,
          .most_neighbours = quality.most_neighbours,
          .smallest_distance = quality.smallest_distance,
          .pivot_ratio = quality.smallest_pivot_ratio,
          .worst_point = quality.worst_point,
          .n_orders_lowered = prepared.order.n_lowered,
          .n_enlarged = prepared.n_enlarged,
          .largest_enlargement = prepared.largest_factor,
          .n_pivoted = quality.n_indefinite};
}

ParticleField::ParticleField(elasticity::ParticleSolution solution, Prepared prepared,
                             std::vector<std::string> warnings)
    : solution_(std::move(solution)), prepared_(std::move(prepared)) {
  const auto &s = solution_.seconds;
  record_.warnings = std::move(warnings);
  record_.n_points = static_cast<std::int64_t>(solution_.particles().size());
  record_.n_dofs = (solution_.has_pressure() ? 3 : 2) * record_.n_points;
  record_.nonzeros = solution_.nonzeros;
  record_.seconds = {{"points", prepared_.points_seconds},
                     {"neighbours", s.neighbours + prepared_.enlarge_seconds},
                     {"basis", s.basis + prepared_.order.lost_seconds},
                     {"assembly", s.assembly},
                     {"solve", s.solve}};
  record_.quantities = {{"backward_error", solution_.backward_error},
                        {"algebraic_error", solution_.algebraic_error},
                        {"reciprocal_condition", solution_.reciprocal_condition}};
  record_.linear_solver = names_of(solution_.solver);
  if (solution_.iterations > 0)
    record_.quantities["solver_iterations"] = solution_.iterations;
  if (solution_.n_repeated > 0)
    record_.quantities["repeated_rows"] = static_cast<double>(solution_.n_repeated);
  add_recoveries();
  if (solution_.backward_error > 1e-10)
    record_.warnings.push_back(
        fmt::format("the linear system was solved with a backward error of {:.1e} only", solution_.backward_error));
}

void ParticleField::add_recoveries() {
  auto recoveries = recoveries_of(prepared_);
  record_.quantities.merge(recoveries.quantities);
  record_.warnings.insert(record_.warnings.end(), recoveries.warnings.begin(), recoveries.warnings.end());
  if (solution_.n_restarts > 0)
    record_.quantities["n_restarts"] = solution_.n_restarts;
  if (solution_.coarse_left_out) {
    record_.quantities["n_coarse_left_out"] = 1;
    record_.warnings.emplace_back("the coarse system of the preconditioner is singular; left out");
  }
  if (solution_.fell_back) {
    record_.quantities["n_direct_instead"] = 1;
    record_.warnings.emplace_back("the iteration for the linear system did not converge; solved by sparse LU");
  }
}

std::vector<std::string> ParticleField::fields() const {
  if (solution_.has_pressure())
    return {"displacement", "stress", "pressure"};
  return {"displacement", "stress"};
}
std::size_t ParticleField::n_components(std::string_view field) const {
  return field == "pressure" ? 1 : field == "displacement" ? 2 : 3;
}

void ParticleField::evaluate(std::string_view field, std::span<const std::array<double, 2>> points,
                             std::span<double> values) const {
  if (field == "displacement") {
    std::vector<elasticity::Vector2> u(points.size());
    solution_.displacement(points, u);
    for (std::size_t i = 0; i < u.size(); ++i)
      std::copy(u[i].begin(), u[i].end(), values.begin() + static_cast<std::ptrdiff_t>(2 * i));
  } else if (field == "stress") {
    std::vector<elasticity::Stress2> s(points.size());
    solution_.stress(points, s);
    for (std::size_t i = 0; i < s.size(); ++i)
      std::copy(s[i].begin(), s[i].end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
  } else if (field == "pressure" && solution_.has_pressure())
    solution_.pressure(points, values);
  else
    throw std::invalid_argument(fmt::format("no field '{}'; there are {}", field, fmt::join(fields(), ", ")));
}

std::vector<double> ParticleField::penalty(std::span<const std::array<double, 2>> points) const {
  std::vector<double> values;
  if (!prepared_.weak)
    return values;
  const auto &particles = solution_.particles();
  const meshless::cloud::CandidateSearch<2> search(particles, prepared_.basis->support());
  std::vector<meshless::cloud::Index> candidates;
  for (const auto &point : points) {
    const std::size_t region = solution_.surroundings().region_of(point);
    search.collect(point, 0, candidates);
    std::erase_if(candidates, [&](auto j) {
      return static_cast<std::size_t>(particles.region(static_cast<std::size_t>(j))) != region;
    });
    values.push_back(elasticity::weak_form::penalty_factor(
        *prepared_.weak, solution_.surroundings().material(region),
        elasticity::weak_form::nearest_smoothing_length(particles, candidates, point)));
  }
  return values;
}

std::vector<std::array<double, 2>> ParticleField::own_points() const {
  const auto positions = solution_.particles().positions();
  return {positions.begin(), positions.end()};
}

std::map<std::string, std::vector<double>> ParticleField::own_figures() const {
  const auto &particles = solution_.particles();
  const meshless::cloud::CandidateSearch<2> search(particles, prepared_.basis->support());
  const meshless::basis::GroupedEvaluation<2> evaluation(*prepared_.basis, search);
  std::vector<double> n_neighbours, regularity;
  for (std::size_t i = 0; i < particles.size(); ++i)
    evaluation.visit(particles.positions().subspan(i, 1), {.value = true}, [&](const auto &group) {
      n_neighbours.push_back(static_cast<double>(group.n_neighbours(0)));
      regularity.push_back(group.regularity.smallest_pivot_ratio);
    });
  return {{"smoothing_length", {particles.smoothing_lengths().begin(), particles.smoothing_lengths().end()}},
          {"n_neighbours", std::move(n_neighbours)},
          {"moment_pivot_ratio", std::move(regularity)}};
}

} // namespace comparisons::methods
