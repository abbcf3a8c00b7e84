#include "meshless/elasticity/strong_form/collocation.h"

#include "../equations.h"

#include "meshless/linear_algebra/floating_point_traps.h"
#include "meshless/linear_algebra/sparse_rows.h"
#include "meshless/linear_algebra/stopwatch.h"
#include "meshless/linear_algebra/system_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::elasticity::strong_form {

namespace {

using linear_algebra::Stopwatch;

enum class RowKind {
  interior, ///< equilibrium
  boundary, ///< what is prescribed there
  follows,  ///< on an interface: the displacement is that of the other region
  balance,  ///< on an interface: the traction is that of the other region
};

/// What one particle's two rows are.
struct Rows {
  RowKind kind = RowKind::interior;
  std::array<RowCondition, 2> conditions{};
  std::size_t other_region = 0; ///< across the interface
  std::size_t piece = 0;        ///< of the interface
  std::array<double, 2> right_hand_side{};
};

Vector2 normal_at(const PlaneProblem &problem, std::size_t region, std::size_t piece, const Point2 &point) {
  const auto &p = problem.regions[region].boundary.pieces()[piece];
  return p.normal(p.nearest(point));
}

double prescribed(const PlaneProblem &problem, std::size_t region, const RowCondition &row, const Point2 &point) {
  const auto &condition = problem.conditions.at(problem.regions[region].boundary.pieces()[row.piece].id);
  Vector2 value{};
  if (row.kind == ConditionKind::displacement)
    condition.displacement({&point, 1}, {&value, 1});
  else if (condition.traction) {
    const Vector2 normal = normal_at(problem, region, row.piece, point);
    condition.traction({&point, 1}, {&normal, 1}, {&value, 1});
  }
  if (row.kind == ConditionKind::traction && problem.thermal_strain) {
    double free = 0;
    problem.thermal_strain({&point, 1}, {&free, 1});
    const Vector2 normal = normal_at(problem, region, row.piece, point);
    const double stress = problem.regions[region].material.thermal_modulus() * free;
    return value[static_cast<std::size_t>(row.component)] + stress * normal[static_cast<std::size_t>(row.component)];
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

/// Where an interface meets the outer boundary the side that follows follows, the other does what is prescribed.
Rows rows_at(const PlaneProblem &problem, const Interfaces &interfaces, std::size_t region, const Point2 &point,
             const std::vector<CornerRule> &rules, std::vector<bool> &used) {
  const auto &boundary = problem.regions[region].boundary;
  Rows rows;
  std::vector<std::size_t> outer;
  for (const std::size_t piece : boundary.pieces_at(point)) {
    if (boundary.pieces()[piece].id != interface_id) {
      outer.push_back(piece);
      continue;
    }
    const auto &side = interfaces.at(region, piece);
    if (rows.kind == RowKind::follows)
      continue;
    rows.kind = side.follows ? RowKind::follows : RowKind::balance;
    rows.other_region = side.region;
    rows.piece = piece;
  }
  if (outer.empty() || rows.kind == RowKind::follows)
    return rows;
  rows.kind = RowKind::boundary;
  rows.conditions = conditions_at(problem, region, point, outer, rule_at(rules, point, boundary.tolerance(), used));
  for (std::size_t k = 0; k < 2; ++k)
    rows.right_hand_side[k] = prescribed(problem, region, rows.conditions[k], point);
  return rows;
}

std::vector<Rows> prepare_rows(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                               const std::vector<CornerRule> &rules) {
  const Interfaces interfaces(problem.regions);
  std::vector<bool> used(rules.size());
  std::vector<Rows> rows;
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    rows.push_back(rows_at(problem, interfaces, static_cast<std::size_t>(particles.region(i)), particles.position(i),
                           rules, used));
    if (rows.back().kind == RowKind::interior)
      inside.push_back(i);
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
      rows[inside[k]].right_hand_side = {-force[k][0], -force[k][1]};
  }
  return rows;
}

using Values = basis::ShapeFunctionValues<2>;

/// The two rows of one particle: entries of u1 and u2 of a candidate in both.
struct Entry {
  std::int64_t column; ///< of u1
  std::array<std::array<double, 2>, 2> rows;
};
using ParticleRows = std::vector<Entry>;

/// Rows of all particles, by what they are made of.
class Collocation {
public:
  Collocation(const PlaneProblem &problem, const cloud::Particles<2> &particles, std::vector<Rows> rows)
      : problem_(problem), particles_(particles), rows_(std::move(rows)), entries_(particles.size()) {
    if (!problem.thermal_strain)
      return;
    thermal_.resize(particles.size());
    problem.thermal_strain(particles.positions(), thermal_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i].kind == RowKind::balance) {
        const double difference = problem.regions[region(i)].material.thermal_modulus() -
                                  problem.regions[rows_[i].other_region].material.thermal_modulus();
        const Vector2 n = normal(i, rows_[i].piece);
        for (std::size_t k = 0; k < 2; ++k)
          rows_[i].right_hand_side[k] += difference * thermal_[i] * n[k];
      }
  }

  /// Adds the shape functions of the particle's own region, at point p of a batch.
  void add_own(std::size_t particle, std::size_t p, const basis::GroupedEvaluation<2>::Group &group) {
    const auto &material = problem_.regions[region(particle)].material;
    auto &rows = rows_[particle];
    if (!thermal_.empty() && rows.kind == RowKind::interior) // sigma_ij,j has the gradient of the thermal stress
      for (std::size_t j = 0; j < group.n_neighbours(p); ++j)
        for (int i = 0; i < 2; ++i)
          rows.right_hand_side[static_cast<std::size_t>(i)] +=
              material.thermal_modulus() * group.values.gradient(i, j)[p] *
              thermal_[static_cast<std::size_t>(group.neighbour(j, p))];
    const linear_algebra::FloatingPointTraps traps;
    entries_[particle].reserve(entries_[particle].size() + group.n_neighbours(p));
    for (std::size_t j = 0; j < group.n_neighbours(p); ++j) {
      if (group.values.value(j)[p] == 0 && group.values.gradient(0, j)[p] == 0 && group.values.gradient(1, j)[p] == 0 &&
          group.values.hessian(0, j)[p] == 0 && group.values.hessian(1, j)[p] == 0)
        continue; // outside the support of this particle
      Entry entry{2 * std::int64_t{group.neighbour(j, p)}, {}};
      for (std::size_t i = 0; i < 2; ++i)
        entry.rows[i] = own_row(rows, material, particle, i, group.values, j, p);
      entries_[particle].push_back(entry);
    }
  }

  /// Calls for rows of the mass, by the densities of the regions.
  void set_densities(std::span<const double> densities) {
    densities_ = densities;
    mass_.resize(particles_.size());
  }

  /// -rho phi_j of those inside, whose other side is sigma_ij,j = rho a_i - b_i; nothing on boundaries.
  void add_mass(std::size_t particle, std::size_t p, const basis::GroupedEvaluation<2>::Group &group) {
    if (rows_[particle].kind != RowKind::interior)
      return;
    for (std::size_t j = 0; j < group.n_neighbours(p); ++j)
      if (const double value = group.values.value(j)[p]; value != 0)
        mass_[particle].emplace_back(2 * std::int64_t{group.neighbour(j, p)}, -densities_[region(particle)] * value);
  }

  void append_mass_rows(linear_algebra::SparseRows &mass) {
    std::vector<std::int64_t> columns;
    std::vector<double> values;
    for (auto &entries : mass_) {
      std::sort(entries.begin(), entries.end());
      for (std::int64_t i = 0; i < 2; ++i) {
        columns.clear();
        values.clear();
        for (const auto &[column, value] : entries) {
          columns.push_back(column + i);
          values.push_back(value);
        }
        mass.append_row(columns, values);
      }
    }
  }

  /// Subtracts those of the region across the interface.
  void add_other(std::size_t particle, std::size_t p, const basis::GroupedEvaluation<2>::Group &group) {
    const linear_algebra::FloatingPointTraps traps;
    const auto &rows = rows_[particle];
    const auto &material = problem_.regions[rows.other_region].material;
    for (std::size_t j = 0; j < group.n_neighbours(p); ++j) {
      Entry entry{2 * std::int64_t{group.neighbour(j, p)}, {}};
      for (std::size_t i = 0; i < 2; ++i) {
        if (rows.kind == RowKind::follows)
          entry.rows[i][i] = -group.values.value(j)[p];
        else {
          entry.rows[i] = traction(material, group.values, j, p, static_cast<int>(i), normal(particle, rows.piece));
          for (double &x : entry.rows[i])
            x = -x;
        }
      }
      entries_[particle].push_back(entry);
    }
  }

  /// Particles whose rows have shape functions of the region `other` in them; particles of the region `own`.
  std::vector<std::size_t> across(std::size_t other) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if ((rows_[i].kind == RowKind::follows || rows_[i].kind == RowKind::balance) && rows_[i].other_region == other)
        found.push_back(i);
    return found;
  }
  std::vector<std::size_t> members(std::size_t own) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (region(i) == own)
        found.push_back(i);
    return found;
  }

  void append_rows(linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side) {
    std::vector<std::int64_t> columns;
    std::vector<double> values;
    for (std::size_t particle = 0; particle < entries_.size(); ++particle) {
      auto &entries = entries_[particle];
      std::sort(entries.begin(), entries.end(), [](const auto &a, const auto &b) { return a.column < b.column; });
      for (std::size_t i = 0; i < 2; ++i) {
        columns.clear();
        values.clear();
        for (const auto &entry : entries) {
          columns.insert(columns.end(), {entry.column, entry.column + 1});
          values.insert(values.end(), entry.rows[i].begin(), entry.rows[i].end());
        }
        matrix.append_row(columns, values);
        right_hand_side.push_back(rows_[particle].right_hand_side[i]);
      }
    }
  }

private:
  std::size_t region(std::size_t particle) const { return static_cast<std::size_t>(particles_.region(particle)); }
  Vector2 normal(std::size_t particle, std::size_t piece) const {
    return normal_at(problem_, region(particle), piece, particles_.position(particle));
  }

  std::array<double, 2> own_row(const Rows &rows, const Material &material, std::size_t particle, std::size_t i,
                                const Values &values, std::size_t j, std::size_t p) const {
    std::array<double, 2> value{};
    switch (rows.kind) {
    case RowKind::interior:
      return equilibrium(material, values, j, p, static_cast<int>(i));
    case RowKind::follows:
      value[i] = values.value(j)[p];
      return value;
    case RowKind::balance:
      return traction(material, values, j, p, static_cast<int>(i), normal(particle, rows.piece));
    case RowKind::boundary:
      break;
    }
    const auto &row = rows.conditions[i];
    if (row.kind == ConditionKind::traction)
      return traction(material, values, j, p, row.component, normal(particle, row.piece));
    value[static_cast<std::size_t>(row.component)] = values.value(j)[p];
    return value;
  }

  const PlaneProblem &problem_;
  const cloud::Particles<2> &particles_;
  std::vector<Rows> rows_;
  std::vector<ParticleRows> entries_;
  std::vector<double> thermal_;       ///< free strain at the particles; empty: none
  std::span<const double> densities_; ///< empty: no mass is asked for
  std::vector<std::vector<std::pair<std::int64_t, double>>> mass_;
};

/// Evaluates the shape functions for all rows of `collocation`, whose mass too if `with_mass`.
void add_rows(const PlaneProblem &problem, const Surroundings &surroundings, const cloud::Particles<2> &particles,
              const basis::ShapeFunctions<2> &basis, const cloud::CandidateSearch<2> &search, bool with_mass,
              Collocation &collocation, SolveSeconds &seconds) {
  Stopwatch watch;
  // Groups come in the order of cells, rows must follow the particles: they are kept until all are there.
  std::vector<Point2> points;
  for (std::size_t r = 0; r < problem.regions.size(); ++r) {
    RegionFilter filter(surroundings, particles, r);
    const basis::GroupedEvaluation<2> evaluation(basis, search, surroundings.simple() ? nullptr : &filter);
    const auto visit = [&](const std::vector<std::size_t> &members, const basis::Wanted &wanted, auto &&add) {
      points.clear();
      for (const std::size_t i : members)
        points.push_back(particles.position(i));
      if (!points.empty())
        evaluation.visit(
            points, wanted,
            [&](const auto &group) {
              seconds.basis += watch.lap();
              for (std::size_t p = 0; p < group.points.size(); ++p)
                add(members[group.points[p]], p, group);
              seconds.assembly += watch.lap();
            },
            "particle", members);
    };
    visit(collocation.members(r), {.value = true, .gradient = true, .hessian = true},
          [&](std::size_t i, std::size_t p, const auto &group) {
            collocation.add_own(i, p, group);
            if (with_mass)
              collocation.add_mass(i, p, group);
          });
    visit(collocation.across(r), {.value = true, .gradient = true},
          [&](std::size_t i, std::size_t p, const auto &group) { collocation.add_other(i, p, group); });
  }
}

} // namespace

ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis,
                       const std::vector<CornerRule> &corner_rules, const linear_algebra::SolverRequest &solver) {
  problem.check();
  problem.require_inside(*particles);
  SolveSeconds seconds;
  Stopwatch watch;
  const auto surroundings = std::make_shared<const Surroundings>(problem.regions);
  const std::size_t n = particles->size();
  const cloud::CandidateSearch<2> search(*particles, basis->support());
  seconds.neighbours = watch.lap();
  Collocation collocation(problem, *particles, prepare_rows(problem, *particles, corner_rules));
  seconds.assembly = watch.lap();

  add_rows(problem, *surroundings, *particles, *basis, search, false, collocation, seconds);
  watch.lap();
  linear_algebra::SparseRows matrix(2 * static_cast<std::int64_t>(n));
  std::vector<double> right_hand_side;
  right_hand_side.reserve(2 * n);
  collocation.append_rows(matrix, right_hand_side);
  const auto divisors = matrix.equilibrate_rows();
  for (std::size_t row = 0; row < divisors.size(); ++row)
    right_hand_side[row] /= divisors[row];
  seconds.assembly += watch.lap();
  // Of order 4 the iteration does not converge on irregular particles.
  auto request = solver;
  if (solver.solver == linear_algebra::SystemSolver::automatic && basis->order() > 3)
    request.solver = linear_algebra::SystemSolver::direct;
  auto system = linear_algebra::solve_system(matrix, right_hand_side, request);
  seconds.solve = watch.lap();

  ParticleSolution solution(std::move(particles), std::move(basis), DerivativeRule::direct, surroundings,
                            std::move(system.solution));
  solution.set_thermal_strain(problem.thermal_strain);
  solution.set_figures(seconds, matrix.nonzeros(), system);
  return solution;
}

EquationsOfMotion equations_of_motion(const PlaneProblem &problem, std::span<const double> densities,
                                      std::shared_ptr<const cloud::Particles<2>> particles,
                                      std::shared_ptr<const basis::ShapeFunctions<2>> basis,
                                      const std::vector<CornerRule> &corner_rules) {
  problem.check(true);
  problem.require_inside(*particles);
  SolveSeconds seconds;
  Stopwatch watch;
  const auto surroundings = std::make_shared<const Surroundings>(problem.regions);
  const cloud::CandidateSearch<2> search(*particles, basis->support());
  seconds.neighbours = watch.lap();
  Collocation collocation(problem, *particles, prepare_rows(problem, *particles, corner_rules));
  collocation.set_densities(densities);
  seconds.assembly = watch.lap();
  add_rows(problem, *surroundings, *particles, *basis, search, true, collocation, seconds);
  watch.lap();
  const auto n = 2 * static_cast<std::int64_t>(particles->size());
  EquationsOfMotion equations{linear_algebra::SparseRows(n),
                              linear_algebra::SparseRows(n),
                              {},
                              particles,
                              basis,
                              surroundings,
                              DerivativeRule::direct,
                              seconds};
  collocation.append_rows(equations.stiffness, equations.force);
  collocation.append_mass_rows(equations.mass);
  equations.seconds.assembly += watch.lap();
  return equations;
}

} // namespace meshless::elasticity::strong_form
