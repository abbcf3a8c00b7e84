#include "meshless/elasticity/particle_solution.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace meshless::elasticity {

ParticleSolution::ParticleSolution(std::shared_ptr<const cloud::Particles<2>> particles,
                                   std::shared_ptr<const basis::ShapeFunctions<2>> basis, DerivativeRule rule,
                                   std::shared_ptr<const Surroundings> surroundings, std::vector<double> coefficients)
    : particles_(std::move(particles)), basis_(std::move(basis)), rule_(rule), surroundings_(std::move(surroundings)),
      coefficients_(std::move(coefficients)), search_(*particles_, basis_->support()) {}

void ParticleSolution::set_figures(const SolveSeconds &spent, std::int64_t entries,
                                   const linear_algebra::SystemSolution &system) {
  seconds = spent;
  nonzeros = entries;
  backward_error = system.backward_error;
  algebraic_error = system.algebraic_error;
  reciprocal_condition = system.reciprocal_condition;
  solver = system.taken;
  iterations = system.iterations;
  fell_back = system.fell_back;
  n_restarts = system.n_restarts;
  coarse_left_out = system.coarse_left_out;
}

void ParticleSolution::set_pressure(PressureField pressure) {
  if (pressure.coefficients.size() != particles_->size())
    throw std::invalid_argument("as many coefficients of the pressure as particles are needed");
  pressure_ = std::move(pressure);
  pressure_search_.emplace(*particles_, pressure_.basis->support());
}

void ParticleSolution::visit(const basis::ShapeFunctions<2> &basis, const cloud::CandidateSearch<2> &search,
                             std::span<const Point2> points, std::span<const int> regions, const basis::Wanted &wanted,
                             const Visitor &visitor) const {
  if (!regions.empty() && regions.size() != points.size())
    throw std::invalid_argument("as many regions as points are needed, or none");
  std::vector<std::vector<std::size_t>> members(surroundings_->n_regions());
  for (std::size_t i = 0; i < points.size(); ++i)
    members.at(regions.empty() ? surroundings_->region_of(points[i]) : static_cast<std::size_t>(regions[i]))
        .push_back(i);
  std::vector<Point2> own;
  std::vector<std::size_t> indices;
  for (std::size_t r = 0; r < members.size(); ++r) {
    own.clear();
    for (const std::size_t i : members[r])
      own.push_back(points[i]);
    RegionFilter filter(*surroundings_, *particles_, r);
    const basis::GroupedEvaluation<2> evaluation(basis, search, surroundings_->simple() ? nullptr : &filter);
    if (!own.empty())
      evaluation.visit(own, wanted, [&](const auto &group) {
        indices.clear();
        for (const std::size_t i : group.points)
          indices.push_back(members[r][i]);
        visitor(group, r, indices);
      });
  }
}

void ParticleSolution::displacement(std::span<const Point2> points, std::span<Vector2> values,
                                    std::span<const int> regions) const {
  visit(*basis_, search_, points, regions, {.value = true},
        [&](const auto &group, std::size_t, std::span<const std::size_t> group_points) {
          for (std::size_t p = 0; p < group_points.size(); ++p) {
            Vector2 u{};
            for (std::size_t j = 0; j < group.n_neighbours(p); ++j) {
              const double *coefficient = &coefficients_[2 * static_cast<std::size_t>(group.neighbour(j, p))];
              for (int k = 0; k < 2; ++k)
                u[k] += group.values.value(j)[p] * coefficient[k];
            }
            values[group_points[p]] = u;
          }
        });
}

void ParticleSolution::stress(std::span<const Point2> points, std::span<Stress2> values,
                              std::span<const int> regions) const {
  const bool direct = rule_ == DerivativeRule::direct;
  const basis::Wanted wanted{.gradient = direct, .differentiated_gradient = !direct};
  visit(*basis_, search_, points, regions, wanted,
        [&](const auto &group, std::size_t region, std::span<const std::size_t> group_points) {
          const auto &d = surroundings_->material(region);
          for (std::size_t p = 0; p < group_points.size(); ++p) {
            std::array<double, 4> gradient{}; // u1,1 u1,2 u2,1 u2,2
            for (std::size_t j = 0; j < group.n_neighbours(p); ++j) {
              const double *coefficient = &coefficients_[2 * static_cast<std::size_t>(group.neighbour(j, p))];
              for (int k = 0; k < 2; ++k) {
                const double *row = direct ? group.values.gradient(k, j) : group.values.differentiated_gradient(k, j);
                gradient[k] += row[p] * coefficient[0];
                gradient[2 + k] += row[p] * coefficient[1];
              }
            }
            if (has_pressure()) {
              const double mu = d.shear();
              values[group_points[p]] = {2 * mu * gradient[0], 2 * mu * gradient[3], mu * (gradient[1] + gradient[2])};
              continue;
            }
            values[group_points[p]] = {d.axial() * gradient[0] + d.coupling() * gradient[3],
                                       d.coupling() * gradient[0] + d.axial() * gradient[3],
                                       d.shear() * (gradient[1] + gradient[2])};
          }
        });
  if (thermal_strain_)
    subtract_thermal(points, values, regions);
  if (!has_pressure())
    return;
  std::vector<double> p(points.size());
  pressure(points, p, regions);
  for (std::size_t i = 0; i < p.size(); ++i) {
    values[i][0] += p[i];
    values[i][1] += p[i];
  }
}

void ParticleSolution::subtract_thermal(std::span<const Point2> points, std::span<Stress2> values,
                                        std::span<const int> regions) const {
  std::vector<double> free(points.size());
  thermal_strain_(points, free);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto region = regions.empty() ? surroundings_->region_of(points[i]) : static_cast<std::size_t>(regions[i]);
    for (std::size_t k = 0; k < 2; ++k)
      values[i][k] -= surroundings_->material(region).thermal_modulus() * free[i];
  }
}

void ParticleSolution::pressure(std::span<const Point2> points, std::span<double> values,
                                std::span<const int> regions) const {
  if (!has_pressure())
    throw std::logic_error("this solution has no pressure of its own");
  visit(*pressure_.basis, *pressure_search_, points, regions, {.value = true},
        [&](const auto &group, std::size_t, std::span<const std::size_t> group_points) {
          for (std::size_t p = 0; p < group_points.size(); ++p) {
            double sum = 0;
            for (std::size_t j = 0; j < group.n_neighbours(p); ++j)
              sum += group.values.value(j)[p] * pressure_.coefficients[static_cast<std::size_t>(group.neighbour(j, p))];
            values[group_points[p]] = sum;
          }
        });
}

} // namespace meshless::elasticity
