#include "meshless/elasticity/particle_solution.h"

#include <algorithm>

namespace meshless::elasticity {

ParticleSolution::ParticleSolution(std::shared_ptr<const cloud::Particles<2>> particles,
                                   std::shared_ptr<const basis::ShapeFunctions<2>> basis, DerivativeRule rule,
                                   Material material, std::vector<double> coefficients)
    : particles_(std::move(particles)), basis_(std::move(basis)), rule_(rule), material_(material),
      coefficients_(std::move(coefficients)), search_(*particles_, basis_->support()) {}

void ParticleSolution::displacement(std::span<const Point2> points, std::span<Vector2> values) const {
  const basis::GroupedEvaluation<2> evaluation(*basis_, search_);
  evaluation.visit(points, {.value = true}, [&](const auto &group) {
    for (const std::size_t i : group.points)
      values[i] = {0, 0};
    for (std::size_t j = 0; j < group.candidates.size(); ++j) {
      const double *coefficient = &coefficients_[2 * static_cast<std::size_t>(group.candidates[j])];
      const double *shape = group.values.value(j);
      for (std::size_t p = 0; p < group.points.size(); ++p)
        for (int k = 0; k < 2; ++k)
          values[group.points[p]][k] += shape[p] * coefficient[k];
    }
  });
}

void ParticleSolution::stress(std::span<const Point2> points, std::span<Stress2> values) const {
  const bool direct = rule_ == DerivativeRule::direct;
  const basis::Wanted wanted{.gradient = direct, .differentiated_gradient = !direct};
  const basis::GroupedEvaluation<2> evaluation(*basis_, search_);
  evaluation.visit(points, wanted, [&](const auto &group) {
    for (std::size_t p = 0; p < group.points.size(); ++p) {
      std::array<double, 4> gradient{}; // u1,1 u1,2 u2,1 u2,2
      for (std::size_t j = 0; j < group.candidates.size(); ++j) {
        const double *coefficient = &coefficients_[2 * static_cast<std::size_t>(group.candidates[j])];
        for (int k = 0; k < 2; ++k) {
          const double *row = direct ? group.values.gradient(k, j) : group.values.differentiated_gradient(k, j);
          gradient[k] += row[p] * coefficient[0];
          gradient[2 + k] += row[p] * coefficient[1];
        }
      }
      values[group.points[p]] = {material_.axial() * gradient[0] + material_.coupling() * gradient[3],
                                 material_.coupling() * gradient[0] + material_.axial() * gradient[3],
                                 material_.shear() * (gradient[1] + gradient[2])};
    }
  });
}

} // namespace meshless::elasticity
