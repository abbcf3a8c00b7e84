#include "fem_reference/elasticity/plane_elasticity.h"

#include "../linear_algebra/direct_solvers.h"
#include "../stopwatch.h"
#include "boundary_conditions.h"
#include "discretisation.h"
#include "point_location.h"
#include "stiffness.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>

#include <fmt/format.h>

namespace fem_reference::elasticity {
class PlaneSolution::Implementation {
public:
  explicit Implementation(const Material &material_) : material(material_) {}

  /// Call `function(k, cell, N_1d, dN_1d)` for every point, with the 1D shape functions along both
  /// reference axes.
  template <typename Function>
  void for_each_point(std::span<const Point> points, const Function &function) const;

  const PointLocation &location() const {
    std::call_once(location_built_, [this] { location_.emplace(discretisation); });
    return *location_;
  }

  Material material;
  Discretisation discretisation;
  std::vector<double> values; ///< unknown = 2 node + component
  std::size_t nonzeros = 0;
  std::size_t contradicted = 0;
  Seconds seconds;
  double relative_residual = 0;
  double backward_error = 0;
  mutable std::atomic<std::size_t> points_outside{0};

private:
  mutable std::once_flag location_built_;
  mutable std::optional<PointLocation> location_; // built by the first evaluation
};

namespace {
using Basis1d = std::array<LagrangeBasis::Values, 2>;

void check_same_size(std::size_t n_points, std::size_t n_values) {
  if (n_points != n_values)
    throw InvalidInput(fmt::format("evaluation: {} points but room for {} values", n_points, n_values));
}
} // namespace

template <typename Function>
void PlaneSolution::Implementation::for_each_point(std::span<const Point> points, const Function &function) const {
  const LagrangeBasis basis(discretisation.degree);
  const auto &where = location();
  std::size_t outside = 0;
  Basis1d shape{};
  Basis1d derivative{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto found = where.locate({points[k][0] - discretisation.origin[0], points[k][1] - discretisation.origin[1]});
    outside += found.outside ? 1 : 0;
    for (std::size_t d = 0; d < 2; ++d)
      basis.evaluate(found.xi[d], shape[d], derivative[d]);
    function(k, found.cell, shape, derivative);
  }
  points_outside = outside;
}

PlaneSolution::PlaneSolution(std::shared_ptr<const Implementation> implementation)
    : implementation_(std::move(implementation)) {}

std::size_t PlaneSolution::n_cells() const { return implementation_->discretisation.n_cells; }

std::size_t PlaneSolution::n_dofs() const { return implementation_->values.size(); }

std::size_t PlaneSolution::nonzeros() const { return implementation_->nonzeros; }

const Seconds &PlaneSolution::seconds() const { return implementation_->seconds; }

double PlaneSolution::relative_residual() const { return implementation_->relative_residual; }

double PlaneSolution::backward_error() const { return implementation_->backward_error; }

std::size_t PlaneSolution::contradicted_values() const { return implementation_->contradicted; }

std::size_t PlaneSolution::points_outside() const { return implementation_->points_outside; }

void PlaneSolution::displacement(std::span<const Point> points, std::span<Vector> values) const {
  check_same_size(points.size(), values.size());
  const auto &discretisation = implementation_->discretisation;
  const double *u = implementation_->values.data();
  const auto n = static_cast<std::size_t>(discretisation.degree) + 1;
  implementation_->for_each_point(points, [&](std::size_t k, std::size_t cell, const Basis1d &shape, const Basis1d &) {
    const unsigned *node = discretisation.nodes_of(cell).data();
    Vector sum{};
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i, ++node) {
        const double weight = shape[0][i] * shape[1][j];
        sum[0] += weight * u[2 * std::size_t{*node}];
        sum[1] += weight * u[2 * std::size_t{*node} + 1];
      }
    values[k] = sum;
  });
}

void PlaneSolution::stress(std::span<const Point> points, std::span<std::array<double, 3>> values) const {
  check_same_size(points.size(), values.size());
  const auto &discretisation = implementation_->discretisation;
  const double *u = implementation_->values.data();
  const auto n = static_cast<std::size_t>(discretisation.degree) + 1;
  const double lambda = implementation_->material.lambda();
  const double mu = implementation_->material.mu();
  implementation_->for_each_point(
      points, [&](std::size_t k, std::size_t cell, const Basis1d &shape, const Basis1d &derivative) {
        const unsigned *node = discretisation.nodes_of(cell).data();
        std::array<Vector, 2> dx{}; // dx[c][d] = d x_d / d xi_c
        std::array<Vector, 2> du{};
        for (std::size_t j = 0; j < n; ++j)
          for (std::size_t i = 0; i < n; ++i, ++node) {
            const std::array<double, 2> slope = {derivative[0][i] * shape[1][j], shape[0][i] * derivative[1][j]};
            for (std::size_t c = 0; c < 2; ++c)
              for (std::size_t d = 0; d < 2; ++d) {
                dx[c][d] += slope[c] * discretisation.positions[*node][d];
                du[c][d] += slope[c] * u[2 * std::size_t{*node} + d];
              }
          }
        const double inverse = 1 / (dx[0][0] * dx[1][1] - dx[0][1] * dx[1][0]);
        const auto along_1 = [&](std::size_t d) { return (dx[1][1] * du[0][d] - dx[0][1] * du[1][d]) * inverse; };
        const auto along_2 = [&](std::size_t d) { return (dx[0][0] * du[1][d] - dx[1][0] * du[0][d]) * inverse; };
        const double e11 = along_1(0);
        const double e22 = along_2(1);
        const double trace = lambda * (e11 + e22);
        values[k] = {trace + 2 * mu * e11, trace + 2 * mu * e22, mu * (along_2(0) + along_1(1))};
      });
}

namespace {
double norm(std::span<const double> x) {
  double sum = 0;
  for (const double value : x)
    sum += value * value;
  return std::sqrt(sum);
}

double maximum_norm(std::span<const double> x) {
  double maximum = 0;
  for (const double value : x)
    maximum = std::max(maximum, std::abs(value));
  return maximum;
}

void measure_residual(const linear_algebra::BlockMatrix &matrix, const std::vector<double> &right_hand_side,
                      PlaneSolution::Implementation &solution) {
  std::vector<double> residual(right_hand_side.size());
  std::vector<double> row_sums(right_hand_side.size());
  multiply(matrix, solution.values, residual, row_sums);
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] -= right_hand_side[i];
  const double largest = maximum_norm(residual);
  if (largest == 0)
    return; // no loads at all, for instance
  solution.relative_residual = norm(residual) / norm(right_hand_side);
  solution.backward_error =
      largest / (maximum_norm(row_sums) * maximum_norm(solution.values) + maximum_norm(right_hand_side));
}

std::unique_ptr<linear_algebra::DirectSolver> factorise(LinearSolver solver, const linear_algebra::BlockMatrix &matrix,
                                                        const Discretisation &discretisation) {
  try {
    return solver == LinearSolver::cholesky ? linear_algebra::factorise_cholesky(matrix)
                                            : linear_algebra::factorise_umfpack(matrix);
  } catch (const linear_algebra::PivotFailure &failure) {
    std::string where;
    if (failure.unknown >= 0) {
      const auto node = static_cast<std::size_t>(failure.unknown) / 2;
      const auto position = discretisation.original_position(node);
      where = fmt::format(" at the equation of u{} at ({}, {})", failure.unknown % 2 + 1, position[0], position[1]);
    }
    throw SolveFailure(
        fmt::format("the stiffness of {} unknowns is singular or not positive definite{}: {}; look for parts of the "
                    "mesh that hang together in one vertex only, and for nu too close to 1/2 in plane strain",
                    matrix.n_rows(), where, failure.reason));
  }
}
/// The prescribed values to the last bit: the factorisation returns them with rounding.
void impose(const EssentialData &essential, std::vector<double> &displacement) {
  for (std::size_t i = 0; i < displacement.size(); ++i)
    if (essential.prescribed[i] != 0)
      displacement[i] = essential.values[i];
}

/// One step of iterative refinement with the accurate residual.
void correct(const Discretisation &discretisation, const Material &material, const std::vector<double> &load,
             const EssentialData &essential, linear_algebra::DirectSolver &solver, std::vector<double> &displacement) {
  auto residual = residual_by_cells(discretisation, material, displacement, load);
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (essential.prescribed[i] != 0)
      residual[i] = 0;
  const auto correction = solver.solve(residual);
  for (std::size_t i = 0; i < displacement.size(); ++i)
    if (essential.prescribed[i] == 0)
      displacement[i] += correction[i];
}
} // namespace

PlaneSolution solve(const PlaneProblem &problem, const Options &options) {
  if (options.degree < 1 || options.degree > max_degree)
    throw InvalidInput(
        fmt::format("element degree {}: expected 1 to {} (Q1 ... Q{})", options.degree, max_degree, max_degree));
  auto solution = std::make_shared<PlaneSolution::Implementation>(problem.material);
  auto &seconds = solution->seconds;
  solution->discretisation = discretise(problem.mesh, options.degree, seconds.mesh, seconds.degrees_of_freedom);
  const auto &discretisation = solution->discretisation;
  check_conditions(problem);

  Stopwatch stopwatch;
  linear_algebra::BlockMatrix matrix(discretisation.n_nodes(), discretisation.cell_nodes,
                                     discretisation.nodes_per_cell);
  seconds.degrees_of_freedom += stopwatch.lap();

  const auto essential = essential_data(problem, discretisation);
  assemble_stiffness(discretisation, problem.material, matrix);
  const auto load = load_vector(problem, discretisation);
  auto right_hand_side = load;
  eliminate(essential, matrix, right_hand_side);
  seconds.assembly = stopwatch.lap();

  const auto solver = factorise(options.solver, matrix, discretisation);
  solution->values = solver->solve(right_hand_side);
  impose(essential, solution->values);
  for (int step = 0; step < options.corrections; ++step)
    correct(discretisation, problem.material, load, essential, *solver, solution->values);
  for (std::size_t i = 0; i < solution->values.size(); ++i)
    if (!std::isfinite(solution->values[i]))
      throw SolveFailure(fmt::format("the solution is not finite at unknown {}", i));
  measure_residual(matrix, right_hand_side, *solution);
  solution->nonzeros = 2 * matrix.n_nonzeros_lower() - static_cast<std::size_t>(matrix.n_rows());
  solution->contradicted = essential.contradicted;
  seconds.solve = stopwatch.lap();
  return PlaneSolution(std::move(solution));
}
} // namespace fem_reference::elasticity
