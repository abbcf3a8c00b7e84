#include "comparisons/metrics/force_balance.h"

#include "comparisons/metrics/support_force.h"
#include "comparisons/problems/boundary_quadrature.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace comparisons::metrics {

namespace {

using Force = Equilibrium::Force;
using problems::Point2;
using problems::Vector2;
using BoundaryPoints = std::map<int, problems::BoundaryQuadrature>;

/// Integral of the prescribed traction over the points of one boundary id.
Force applied(const problems::BoundaryCondition &condition, const problems::BoundaryQuadrature &points) {
  Force force{};
  if (!condition.traction)
    return force;
  std::vector<Vector2> values(points.points.size());
  condition.traction(points.points, points.normals, values);
  for (std::size_t q = 0; q < values.size(); ++q)
    for (std::size_t k = 0; k < 2; ++k)
      force[k] += points.weights[q] * values[q][k];
  return force;
}

/// Integral of sigma n.
Force carried(const methods::Solution &solution, const problems::BoundaryQuadrature &points) {
  std::vector<double> stress(3 * points.points.size());
  solution.evaluate("stress", points.points, stress);
  std::array<long double, 2> force{}; // the rounding of hundreds of terms is not to show in the balance
  for (std::size_t q = 0; q < points.points.size(); ++q) {
    const auto [n1, n2] = points.normals[q];
    force[0] += points.weights[q] * (stress[3 * q] * n1 + stress[3 * q + 2] * n2);
    force[1] += points.weights[q] * (stress[3 * q + 2] * n1 + stress[3 * q + 1] * n2);
  }
  return {static_cast<double>(force[0]), static_cast<double>(force[1])};
}

void integrate(const methods::Solution &solution, const problems::PlaneStatement &statement,
               const BoundaryPoints &boundary, const problems::Quadrature &quadrature, Equilibrium &result) {
  for (const auto &[id, condition] : statement.conditions) {
    const auto found = boundary.find(id);
    if (found == boundary.end())
      continue;
    Force force = applied(condition, found->second);
    const auto &prescribed = condition.displacement_prescribed;
    if (prescribed[0] || prescribed[1]) {
      const Force reaction = carried(solution, found->second);
      for (std::size_t k = 0; k < 2; ++k)
        if (prescribed[k])
          force[k] = reaction[k];
    }
    result.boundary[id] = force;
  }
  if (!statement.body_force)
    return;
  std::vector<Vector2> values(quadrature.points.size());
  statement.body_force(quadrature.points, values);
  for (std::size_t q = 0; q < values.size(); ++q)
    for (std::size_t k = 0; k < 2; ++k)
      result.body[k] += quadrature.weights[q] * values[q][k];
}

/// Sum of the forces of all supports by the discrete equations of a method with a penalty: int (sigma n - alpha (u -
/// ubar)). The penalty's part alternates from particle to particle, so there are some points between two of them.
std::optional<Force> discrete_support_force(const methods::Solution &solution,
                                            const problems::PlaneStatement &statement) {
  const double parts = 8 * std::sqrt(static_cast<double>(solution.record().n_points));
  std::array<long double, 2> force{};
  for (const auto &[id, points] : problems::boundary_quadrature(statement, std::max(96., parts))) {
    const auto condition = statement.conditions.find(id);
    if (condition == statement.conditions.end())
      continue;
    const auto &prescribed = condition->second.displacement_prescribed;
    if (!prescribed[0] && !prescribed[1])
      continue;
    const auto alpha = solution.penalty(points.points);
    if (alpha.empty())
      return {};
    const Force stress = carried(solution, points);
    std::vector<double> u(2 * points.points.size());
    std::vector<Vector2> given(points.points.size());
    solution.evaluate("displacement", points.points, u);
    condition->second.displacement(points.points, given);
    for (std::size_t k = 0; k < 2; ++k)
      if (prescribed[k]) {
        force[k] += stress[k];
        for (std::size_t q = 0; q < given.size(); ++q)
          force[k] -= points.weights[q] * alpha[q] * (u[2 * q + k] - given[q][k]);
      }
  }
  return Force{static_cast<double>(force[0]), static_cast<double>(force[1])};
}

/// The support's force is that of the stress inside the body where one boundary alone prescribes a component, and what
/// several prescribe is in the sum so.
/// @returns the sum of the forces of all supports less those of `result`
Force extract(const methods::Solution &solution, const problems::PlaneStatement &statement,
              const BoundaryPoints &boundary, const problems::Quadrature &quadrature, Equilibrium &result) {
  const auto total = support_force(solution, statement, boundary, quadrature);
  Force difference{};
  for (std::size_t k = 0; k < 2; ++k) {
    if (!total[k])
      continue;
    difference[k] = *total[k];
    Force *only = nullptr;
    std::size_t n_supports = 0;
    for (auto &[id, force] : result.boundary)
      if (statement.conditions.at(id).displacement_prescribed[k]) {
        difference[k] -= force[k];
        only = &force;
        ++n_supports;
      }
    if (n_supports == 1) {
      (*only)[k] = *total[k];
      difference[k] = 0;
    }
  }
  return difference;
}

double magnitude(const Force &force) { return std::hypot(force[0], force[1]); }

/// Integral of the magnitude of what is applied: prescribed components of the traction, and the body force. Loads that
/// balance within one boundary count as well.
double applied_magnitude(const problems::PlaneStatement &statement, const BoundaryPoints &boundary,
                         const problems::Quadrature &quadrature) {
  double total = 0;
  std::vector<Vector2> values;
  for (const auto &[id, points] : boundary) {
    const auto condition = statement.conditions.find(id);
    if (condition == statement.conditions.end() || !condition->second.traction)
      continue;
    values.assign(points.points.size(), {});
    condition->second.traction(points.points, points.normals, values);
    for (std::size_t q = 0; q < values.size(); ++q) {
      for (std::size_t k = 0; k < 2; ++k)
        if (condition->second.displacement_prescribed[k])
          values[q][k] = 0;
      total += points.weights[q] * std::hypot(values[q][0], values[q][1]);
    }
  }
  if (statement.body_force) {
    values.assign(quadrature.points.size(), {});
    statement.body_force(quadrature.points, values);
    for (std::size_t q = 0; q < values.size(); ++q)
      total += quadrature.weights[q] * std::hypot(values[q][0], values[q][1]);
  }
  return total;
}

/// Integral of the magnitude of sigma n over the whole boundary.
double carried_magnitude(const methods::Solution &solution, const BoundaryPoints &boundary) {
  double total = 0;
  for (const auto &[id, points] : boundary) {
    std::vector<double> s(3 * points.points.size());
    solution.evaluate("stress", points.points, s);
    for (std::size_t q = 0; q < points.points.size(); ++q) {
      const auto [n1, n2] = points.normals[q];
      total += points.weights[q] * std::hypot(s[3 * q] * n1 + s[3 * q + 2] * n2, s[3 * q + 2] * n1 + s[3 * q + 1] * n2);
    }
  }
  return total;
}

} // namespace

Equilibrium equilibrium(const methods::Solution &solution, const problems::PlaneStatement &statement,
                        const problems::Quadrature &quadrature) {
  const auto boundary = problems::boundary_quadrature(statement);
  Equilibrium result;
  if (const auto own = solution.own_forces()) {
    result.boundary = own->boundary;
    result.body = own->body;
  } else
    integrate(solution, statement, boundary, quadrature, result);
  Force sum{};
  if (!solution.own_forces() && !quadrature.points.empty())
    sum = extract(solution, statement, boundary, quadrature, result);
  for (std::size_t k = 0; k < 2; ++k)
    sum[k] += result.body[k];
  double all = magnitude(result.body);
  for (const auto &[id, force] : result.boundary) {
    for (std::size_t k = 0; k < 2; ++k)
      sum[k] += force[k];
    all += magnitude(force);
  }
  const double loads = applied_magnitude(statement, boundary, quadrature);
  const double scale = loads > 1e-12 * all ? loads : carried_magnitude(solution, boundary);
  result.imbalance = scale > 0 ? magnitude(sum) / scale : 0;
  if (const auto own = solution.own_forces() ? std::nullopt : discrete_support_force(solution, statement)) {
    Force left = *own;
    for (std::size_t k = 0; k < 2; ++k) {
      left[k] += result.body[k];
      for (const auto &[id, force] : result.boundary)
        if (!statement.conditions.at(id).displacement_prescribed[k])
          left[k] += force[k];
    }
    result.discrete_imbalance = scale > 0 ? magnitude(left) / scale : 0;
  }
  return result;
}

} // namespace comparisons::metrics
