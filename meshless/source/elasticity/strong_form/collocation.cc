#include "meshless/elasticity/strong_form/collocation.h"

#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/sparse_rows.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace meshless::elasticity::strong_form {

namespace {

using linear_algebra::Stopwatch;

/// What each particle's two rows are: inside, nothing is prescribed.
struct Rows {
  std::vector<bool> interior;
  std::vector<std::array<RowCondition, 2>> conditions;
  std::vector<std::array<double, 2>> right_hand_side;
};

double prescribed(const PlaneProblem &problem, const RowCondition &row, const Point2 &point) {
  const auto &piece = problem.boundary.pieces()[row.piece];
  const auto &condition = problem.conditions.at(piece.id);
  Vector2 value{};
  if (row.kind == ConditionKind::displacement)
    condition.displacement({&point, 1}, {&value, 1});
  else if (condition.traction) {
    const Vector2 normal = piece.normal(piece.nearest(point));
    condition.traction({&point, 1}, {&normal, 1}, {&value, 1});
  }
  return value[static_cast<std::size_t>(row.component)];
}

const CornerRule *rule_at(const std::vector<CornerRule> &rules, const Point2 &point, double tolerance,
                          std::vector<bool> &used) {
  for (std::size_t r = 0; r < rules.size(); ++r)
    if (std::hypot(point[0] - rules[r].corner[0], point[1] - rules[r].corner[1]) <= tolerance) {
      used[r] = true;
      return &rules[r];
    }
  return nullptr;
}

Rows prepare_rows(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                  const std::vector<CornerRule> &rules) {
  const std::size_t n = particles.size();
  Rows rows{std::vector<bool>(n), std::vector<std::array<RowCondition, 2>>(n), std::vector<std::array<double, 2>>(n)};
  std::vector<bool> used(rules.size());
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < n; ++i) {
    const auto pieces = problem.boundary.pieces_at(particles.position(i));
    rows.interior[i] = pieces.empty();
    if (pieces.empty()) {
      inside.push_back(i);
      continue;
    }
    const CornerRule *rule = rule_at(rules, particles.position(i), problem.boundary.tolerance(), used);
    rows.conditions[i] = conditions_at(problem, pieces, rule);
    for (std::size_t k = 0; k < 2; ++k)
      rows.right_hand_side[i][k] = prescribed(problem, rows.conditions[i][k], particles.position(i));
  }
  for (std::size_t r = 0; r < rules.size(); ++r)
    if (!used[r])
      throw std::invalid_argument(fmt::format("no particle at the corner ({:.6g}, {:.6g}) of a corner rule",
                                              rules[r].corner[0], rules[r].corner[1]));
  if (problem.body_force) {
    std::vector<Point2> points;
    for (const std::size_t i : inside)
      points.push_back(particles.position(i));
    std::vector<Vector2> force(points.size());
    problem.body_force(points, force);
    for (std::size_t k = 0; k < inside.size(); ++k)
      rows.right_hand_side[inside[k]] = {-force[k][0], -force[k][1]};
  }
  return rows;
}

using Values = basis::ShapeFunctionValues<2>;

/// Coefficients of u1 and u2 of candidate j in one row at point p of a batch.
std::array<double, 2> equilibrium(const Material &d, const Values &values, std::size_t j, std::size_t p,
                                  int component) {
  const double xx = values.hessian(0, j)[p];
  const double xy = values.hessian(1, j)[p];
  const double yy = values.hessian(2, j)[p];
  const double mixed = (d.coupling() + d.shear()) * xy;
  if (component == 0)
    return {d.axial() * xx + d.shear() * yy, mixed};
  return {mixed, d.shear() * xx + d.axial() * yy};
}

std::array<double, 2> traction(const Material &d, const Values &values, std::size_t j, std::size_t p, int component,
                               const Vector2 &normal) {
  const double x = values.gradient(0, j)[p];
  const double y = values.gradient(1, j)[p];
  const auto [n1, n2] = normal;
  if (component == 0)
    return {d.axial() * x * n1 + d.shear() * y * n2, d.coupling() * y * n1 + d.shear() * x * n2};
  return {d.shear() * y * n1 + d.coupling() * x * n2, d.shear() * x * n1 + d.axial() * y * n2};
}

/// The two rows of one particle, as columns and entries.
struct ParticleRows {
  std::vector<std::int64_t> columns;
  std::array<std::vector<double>, 2> entries;
};

ParticleRows rows_of(const PlaneProblem &problem, const Rows &rows, std::size_t particle, std::size_t p,
                     const basis::GroupedEvaluation<2>::Group &group) {
  ParticleRows result;
  for (std::size_t j = 0; j < group.candidates.size(); ++j) {
    if (group.values.value(j)[p] == 0 && group.values.gradient(0, j)[p] == 0 && group.values.gradient(1, j)[p] == 0 &&
        group.values.hessian(0, j)[p] == 0 && group.values.hessian(1, j)[p] == 0)
      continue; // outside the support of this particle
    const std::int64_t column = 2 * std::int64_t{group.candidates[j]};
    result.columns.insert(result.columns.end(), {column, column + 1});
    for (std::size_t i = 0; i < 2; ++i) {
      std::array<double, 2> entry{};
      if (rows.interior[particle])
        entry = equilibrium(problem.material, group.values, j, p, static_cast<int>(i));
      else {
        const auto &row = rows.conditions[particle][i];
        if (row.kind == ConditionKind::displacement)
          entry[static_cast<std::size_t>(row.component)] = group.values.value(j)[p];
        else
          entry = traction(problem.material, group.values, j, p, row.component,
                           problem.boundary.pieces()[row.piece].normal());
      }
      result.entries[i].insert(result.entries[i].end(), entry.begin(), entry.end());
    }
  }
  return result;
}

} // namespace

ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis,
                       const std::vector<CornerRule> &corner_rules) {
  problem.check();
  problem.require_inside(particles->positions());
  SolveSeconds seconds;
  Stopwatch watch;
  const std::size_t n = particles->size();
  const cloud::CandidateSearch<2> search(*particles, basis->support());
  seconds.neighbours = watch.lap();
  const Rows rows = prepare_rows(problem, *particles, corner_rules);
  seconds.assembly = watch.lap();

  // Groups come in the order of cells, rows must follow the particles: keep them until all are there.
  std::vector<ParticleRows> particle_rows(n);
  const basis::GroupedEvaluation<2> evaluation(*basis, search);
  evaluation.visit(
      particles->positions(), {.value = true, .gradient = true, .hessian = true},
      [&](const auto &group) {
        seconds.basis += watch.lap();
        for (std::size_t p = 0; p < group.points.size(); ++p)
          particle_rows[group.points[p]] = rows_of(problem, rows, group.points[p], p, group);
        seconds.assembly += watch.lap();
      },
      "particle");
  linear_algebra::SparseRows matrix(2 * static_cast<std::int64_t>(n));
  std::vector<double> right_hand_side;
  right_hand_side.reserve(2 * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      matrix.append_row(particle_rows[i].columns, particle_rows[i].entries[k]);
      right_hand_side.push_back(rows.right_hand_side[i][k]);
    }
  const auto divisors = matrix.equilibrate_rows();
  for (std::size_t row = 0; row < divisors.size(); ++row)
    right_hand_side[row] /= divisors[row];
  seconds.assembly += watch.lap();
  auto lu = linear_algebra::solve_lu(matrix, right_hand_side);
  seconds.solve = watch.lap();

  const double backward = linear_algebra::backward_error(matrix, lu.solution, right_hand_side);
  ParticleSolution solution(std::move(particles), std::move(basis), DerivativeRule::direct, problem.material,
                            std::move(lu.solution));
  solution.seconds = seconds;
  solution.nonzeros = matrix.nonzeros();
  solution.backward_error = backward;
  solution.reciprocal_condition = lu.reciprocal_condition;
  return solution;
}

} // namespace meshless::elasticity::strong_form
