#include "comparisons/metrics/error_norms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comparisons::metrics {

namespace {

using problems::Point2;
using problems::Stress2;
using problems::Vector2;

std::vector<double> evaluate(const methods::Solution &solution, const char *field, std::span<const Point2> points) {
  std::vector<double> values(points.size() * solution.n_components(field));
  solution.evaluate(field, points, values);
  const std::size_t n = solution.n_components(field);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw std::runtime_error(
          fmt::format("the {} at ({:.6g}, {:.6g}) is not finite", field, points[i / n][0], points[i / n][1]));
  return values;
}

/// sigma : C^-1 : sigma for isotropic elasticity in the plane, with E0, nu0.
double energy(const Stress2 &s, const problems::Material &material) {
  const double nu = material.poisson_ratio;
  const double nu0 = material.plane_strain ? nu / (1 - nu) : nu;
  const double e0 = material.plane_strain ? material.youngs_modulus / ((1 - nu) * (1 + nu)) : material.youngs_modulus;
  return (s[0] * s[0] + s[1] * s[1] - 2 * nu0 * s[0] * s[1]) / e0 +
         2 * (1 + nu) * s[2] * s[2] / material.youngs_modulus;
}

void add_displacement_errors(const methods::Solution &solution, const problems::PlaneProblem &problem,
                             const problems::Quadrature &quadrature, std::map<std::string, double> &errors) {
  const auto computed = evaluate(solution, "displacement", quadrature.points);
  std::vector<Vector2> exact(quadrature.points.size());
  problem.exact().displacement(quadrature.points, exact);
  double difference = 0;
  double norm = 0;
  double computed_norm = 0;
  double largest = 0;
  double largest_difference = 0;
  for (std::size_t q = 0; q < exact.size(); ++q)
    for (std::size_t k = 0; k < 2; ++k) {
      const double weight = quadrature.weights[q];
      const double u = exact[q][k];
      const double error = computed[2 * q + k] - u;
      difference += weight * error * error;
      norm += weight * u * u;
      computed_norm += weight * computed[2 * q + k] * computed[2 * q + k];
      largest = std::max(largest, std::abs(u));
      largest_difference = std::max(largest_difference, std::abs(error));
    }
  const double l2 = std::sqrt(difference / norm);
  errors["displacement_l2_relative"] = l2;
  // A solution that is exact to the last bit has no logarithm; its error is below rounding.
  constexpr double rounding = 1e-16;
  errors["displacement_log10_l2"] = std::log10(std::max(l2, rounding));
  errors["displacement_log10_E"] =
      std::log10(std::max(std::abs(std::sqrt(computed_norm) - std::sqrt(norm)) / std::sqrt(norm), rounding));
  errors["displacement_max_relative"] = largest_difference / largest;
}

void add_stress_errors(const methods::Solution &solution, const problems::PlaneProblem &problem,
                       const problems::Quadrature &quadrature, std::map<std::string, double> &errors) {
  const auto computed = evaluate(solution, "stress", quadrature.points);
  std::vector<Stress2> exact(quadrature.points.size());
  problem.exact().stress(quadrature.points, exact);
  double difference = 0;
  double norm = 0;
  double energy_difference = 0;
  double energy_norm = 0;
  for (std::size_t q = 0; q < exact.size(); ++q) {
    const Stress2 &s = exact[q];
    const Stress2 error{computed[3 * q] - s[0], computed[3 * q + 1] - s[1], computed[3 * q + 2] - s[2]};
    const double weight = quadrature.weights[q];
    difference += weight * (error[0] * error[0] + error[1] * error[1] + 2 * error[2] * error[2]);
    norm += weight * (s[0] * s[0] + s[1] * s[1] + 2 * s[2] * s[2]);
    const auto region = quadrature.regions.empty() ? 0 : static_cast<std::size_t>(quadrature.regions[q]);
    const auto &material = problem.statement().regions[region].material;
    energy_difference += weight * energy(error, material);
    energy_norm += weight * energy(s, material);
  }
  errors["stress_l2_relative"] = std::sqrt(difference / norm);
  // At nu = 1/2 in plane strain the energy of a pressure error is zero to rounding, or just below.
  errors["energy_relative"] = std::sqrt(std::max(0.0, energy_difference) / energy_norm);
}

void add_largest_error(const methods::Solution &solution, const problems::PlaneProblem &problem,
                       const problems::PlaneProblem::LargestError &request, std::map<std::string, double> &errors) {
  for (const auto &line : problem.sample_lines()) {
    if (line.name != request.line)
      continue;
    const auto computed = evaluate(solution, "displacement", line.points);
    std::vector<Vector2> exact(line.points.size());
    problem.exact().displacement(line.points, exact);
    const auto k = static_cast<std::size_t>(request.component);
    double largest = 0;
    double largest_difference = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      largest = std::max(largest, std::abs(exact[i][k]));
      largest_difference = std::max(largest_difference, std::abs(computed[2 * i + k] - exact[i][k]));
    }
    errors[request.quantity] = largest_difference / largest;
  }
}

} // namespace

std::map<std::string, double> error_norms(const methods::Solution &solution, const problems::PlaneProblem &problem,
                                          const problems::Quadrature &quadrature) {
  std::map<std::string, double> errors;
  const auto &exact = problem.exact();
  if (exact.displacement)
    add_displacement_errors(solution, problem, quadrature, errors);
  if (exact.stress)
    add_stress_errors(solution, problem, quadrature, errors);
  if (const auto request = problem.largest_error(); request && exact.displacement)
    add_largest_error(solution, problem, *request, errors);
  return errors;
}

} // namespace comparisons::metrics
