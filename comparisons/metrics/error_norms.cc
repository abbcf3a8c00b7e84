#include "comparisons/metrics/error_norms.h"

#include "comparisons/metrics/energy.h"

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
    energy_difference += weight * twice_energy_density(error, material);
    energy_norm += weight * twice_energy_density(s, material);
  }
  errors["stress_l2_relative"] = std::sqrt(difference / norm);
  // At nu = 1/2 in plane strain the energy of a pressure error is zero to rounding, or just below.
  errors["energy_relative"] = std::sqrt(std::max(0.0, energy_difference) / energy_norm);
}

void add_component_error(const methods::Solution &solution, const problems::PlaneProblem &problem,
                         std::span<const Point2> points, const problems::PlaneProblem::ComponentError &request,
                         std::map<std::string, double> &errors) {
  using Kind = problems::PlaneProblem::ComponentError::Kind;
  const auto computed = evaluate(solution, "displacement", points);
  std::vector<Vector2> exact(points.size());
  problem.exact().displacement(points, exact);
  const auto k = static_cast<std::size_t>(request.component);
  double largest = 0;
  double largest_difference = 0;
  double squared = 0; // along the line, by the trapezoidal rule
  double last = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double difference = std::abs(computed[2 * i + k] - exact[i][k]);
    largest = std::max(largest, std::abs(exact[i][k]));
    largest_difference = std::max(largest_difference, difference);
    if (i > 0)
      squared += 0.5 * (difference * difference + last * last) *
                 std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
    last = difference;
  }
  errors[request.quantity] = request.kind == Kind::l2        ? std::sqrt(squared)
                             : request.kind == Kind::largest ? largest_difference
                                                             : largest_difference / largest;
}

void add_component_errors(const methods::Solution &solution, const problems::PlaneProblem &problem,
                          const problems::Quadrature &quadrature, std::map<std::string, double> &errors) {
  const auto requests = problem.component_errors();
  const auto lines = requests.empty() ? std::vector<problems::SampleLine>{} : problem.sample_lines();
  for (const auto &request : requests) {
    if (request.line.empty())
      add_component_error(solution, problem, quadrature.points, request, errors);
    for (const auto &line : lines)
      if (line.name == request.line)
        add_component_error(solution, problem, line.points, request, errors);
  }
}

} // namespace

std::map<std::string, double> error_norms(const methods::Solution &solution, const problems::PlaneProblem &problem,
                                          const problems::Quadrature &of_level) {
  std::map<std::string, double> errors;
  const auto &exact = problem.exact();
  const auto &quadrature = exact.only_at ? *exact.only_at : of_level;
  if (exact.displacement)
    add_displacement_errors(solution, problem, quadrature, errors);
  if (exact.stress)
    add_stress_errors(solution, problem, quadrature, errors);
  if (exact.displacement)
    add_component_errors(solution, problem, quadrature, errors);
  return errors;
}

} // namespace comparisons::metrics
