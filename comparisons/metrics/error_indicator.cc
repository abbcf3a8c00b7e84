#include "comparisons/metrics/error_indicator.h"

#include "comparisons/problems/boundary_quadrature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::metrics {

namespace {

using problems::Point2;
using problems::Vector2;

struct Limit {
  const char *name;
  double limit;
  const char *meaning;
};

/// Calibrated on the hard cases (`petrov verify`), where every error of u above 10 % exceeds one of them.
constexpr Limit limits[] = {
    {"force_imbalance", 0.06, "the forces on the body do not balance: {:.0f} % of the loads are left over"},
    {"traction_residual", 0.25, "the stress misses the prescribed tractions by {:.0f} % of its size on the boundary"},
    {"stress_jump", 0.35,
     "the stress jumps by {:.0f} % of its size from cell to cell: the elements are too coarse or lock"},
};

double traction_residual(const methods::Solution &solution, const problems::PlaneStatement &statement) {
  double error = 0, norm = 0;
  for (const auto &[id, points] : problems::boundary_quadrature(statement)) {
    const auto &condition = statement.conditions.at(id);
    if (condition.displacement_prescribed[0] && condition.displacement_prescribed[1])
      continue;
    std::vector<double> stress(3 * points.points.size());
    std::vector<Vector2> traction(points.points.size());
    solution.evaluate("stress", points.points, stress);
    if (condition.traction)
      condition.traction(points.points, points.normals, traction);
    for (std::size_t q = 0; q < traction.size(); ++q) {
      const double *s = &stress[3 * q];
      const auto [n1, n2] = points.normals[q];
      const Vector2 carried{s[0] * n1 + s[2] * n2, s[2] * n1 + s[1] * n2};
      for (std::size_t k = 0; k < 2; ++k)
        if (!condition.displacement_prescribed[k])
          error += points.weights[q] * (carried[k] - traction[q][k]) * (carried[k] - traction[q][k]);
      norm += points.weights[q] * (s[0] * s[0] + s[1] * s[1] + 2 * s[2] * s[2]);
    }
  }
  return norm > 0 ? std::sqrt(error / norm) : 0;
}

double stress_jump(const methods::Solution &solution, std::span<const Point2> points) {
  std::vector<double> direct(3 * points.size()), recovered(3 * points.size());
  solution.evaluate("stress", points, direct);
  solution.evaluate("recovered_stress", points, recovered);
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    const double weight = i % 3 == 2 ? 2 : 1;
    error += weight * (recovered[i] - direct[i]) * (recovered[i] - direct[i]);
    norm += weight * direct[i] * direct[i];
  }
  return norm > 0 ? std::sqrt(error / norm) : 0;
}

/// A motion without strain leaves rounding for stress: there is nothing to judge.
bool free_of_stress(const methods::Solution &solution, const problems::PlaneStatement &statement) {
  double modulus = 0;
  for (const auto &region : statement.regions)
    modulus = std::max(modulus, region.material.youngs_modulus);
  double largest_stress = 0, largest_displacement = 0;
  Point2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const auto &[id, points] : problems::boundary_quadrature(statement)) {
    std::vector<double> stress(3 * points.points.size()), displacement(2 * points.points.size());
    solution.evaluate("stress", points.points, stress);
    solution.evaluate("displacement", points.points, displacement);
    for (const double s : stress)
      largest_stress = std::max(largest_stress, std::abs(s));
    for (const double u : displacement)
      largest_displacement = std::max(largest_displacement, std::abs(u));
    for (const auto &x : points.points)
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], x[k]);
        high[k] = std::max(high[k], x[k]);
      }
  }
  const double length = std::hypot(high[0] - low[0], high[1] - low[1]);
  return largest_stress <= 1e-9 * modulus * largest_displacement / length;
}

} // namespace

ErrorIndicators error_indicators(const methods::Solution &solution, const problems::PlaneStatement &statement,
                                 const Equilibrium &equilibrium, std::span<const Point2> points) {
  ErrorIndicators result;
  if (free_of_stress(solution, statement))
    return result;
  if (!solution.own_forces())
    result["force_imbalance"] = equilibrium.imbalance;
  result["traction_residual"] = traction_residual(solution, statement);
  const auto fields = solution.fields();
  if (!points.empty() && std::find(fields.begin(), fields.end(), "recovered_stress") != fields.end())
    result["stress_jump"] = stress_jump(solution, points);
  return result;
}

std::optional<double> effectivity(double indicator, const std::map<std::string, double> &errors) {
  constexpr double rounding = 1e-12;
  const auto error = errors.find("stress_l2_relative");
  if (error == errors.end() || !(error->second > rounding))
    return {};
  return indicator / error->second;
}

std::vector<std::string> doubts(const ErrorIndicators &indicators) {
  std::vector<std::string> result;
  for (const auto &[name, limit, meaning] : limits) {
    const auto found = indicators.find(name);
    if (found != indicators.end() && !(found->second <= limit))
      result.push_back(fmt::format(fmt::runtime(meaning), 100 * found->second));
  }
  return result;
}

} // namespace comparisons::metrics
