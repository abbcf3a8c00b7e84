#include "comparisons/methods/fem.h"

#include "comparisons/methods/locking.h"

#include "fem_reference/elasticity/plane_elasticity.h"

#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace comparisons::methods {

namespace reference = fem_reference::elasticity;

/// Displacement of degree 2, pressure of degree 1.
constexpr const char *taylor_hood = "Q2Q1";

reference::PlaneProblem reference_problem(const problems::PlaneStatement &statement, problems::Mesh mesh) {
  reference::PlaneProblem problem;
  for (const auto &[name, material, boundary] : statement.regions)
    problem.materials.emplace_back(material.youngs_modulus, material.poisson_ratio,
                                   material.plane_strain ? reference::PlaneModel::plane_strain
                                                         : reference::PlaneModel::plane_stress);
  problem.body_force = statement.body_force;
  problem.thermal_strain = statement.thermal_strain;
  problem.mesh.vertices = std::move(mesh.vertices);
  for (const auto &cell : mesh.cells)
    problem.mesh.cells.push_back({cell.vertices, cell.n_vertices, cell.region});
  for (const auto &edge : mesh.boundary)
    problem.mesh.boundary.push_back({edge.vertices, edge.id, edge.arc_centre});
  for (const auto &edge : mesh.curved_edges)
    problem.mesh.curved_edges.push_back({edge.vertices, edge.midpoint});
  for (const auto &[id, condition] : statement.conditions) {
    reference::BoundaryCondition translated;
    for (std::size_t k = 0; k < 2; ++k)
      translated.kind[k] = condition.displacement_prescribed[k] ? reference::ConditionKind::displacement
                                                                : reference::ConditionKind::traction;
    translated.displacement = condition.displacement;
    translated.traction = condition.traction;
    problem.boundary[id] = std::move(translated);
  }
  return problem;
}

namespace {

using scene::Type;

std::map<std::string, std::string> names_of_solver(const reference::Options &options) {
  if (options.solver == reference::LinearSolver::multigrid && !options.mixed)
    return {{"method", "cg"}, {"preconditioner", "multigrid"}};
  const bool cholesky = options.solver == reference::LinearSolver::cholesky && !options.mixed;
  return {{"method", cholesky ? "cholesky" : "umfpack"}, {"ordering", "amd"}};
}

class ElementField final : public Solution {
public:
  ElementField(reference::PlaneSolution solution, const reference::Options &options, std::size_t n_vertices,
               double points_seconds, bool thermal, std::vector<std::string> warnings)
      : solution_(std::move(solution)), thermal_(thermal) {
    const auto &s = solution_.seconds();
    record_.warnings = std::move(warnings);
    record_.n_points = static_cast<std::int64_t>(n_vertices);
    record_.n_dofs = static_cast<std::int64_t>(solution_.n_dofs());
    record_.nonzeros = static_cast<std::int64_t>(solution_.nonzeros());
    // Connectivity, numbering and sparsity are what neighbour search is to particles.
    record_.seconds = {{"points", points_seconds + s.mesh},
                       {"neighbours", s.degrees_of_freedom},
                       {"assembly", s.assembly},
                       {"solve", s.solve}};
    record_.quantities = {{"backward_error", solution_.backward_error()}};
    if (const auto error = solution_.algebraic_error())
      record_.quantities["algebraic_error"] = *error;
    record_.linear_solver = names_of_solver(options);
    if (solution_.iterations() > 0)
      record_.quantities["solver_iterations"] = solution_.iterations();
  }

  std::vector<std::string> fields() const override {
    if (solution_.has_pressure())
      return {"displacement", "stress", "recovered_stress", "pressure"};
    return {"displacement", "stress", "recovered_stress"};
  }
  std::size_t n_components(std::string_view field) const override {
    return field == "pressure" ? 1 : field == "displacement" ? 2 : 3;
  }

  void evaluate(std::string_view field, std::span<const std::array<double, 2>> points,
                std::span<double> values) const override {
    if (field == "displacement") {
      std::vector<reference::Vector> u(points.size());
      solution_.displacement(points, u);
      for (std::size_t i = 0; i < u.size(); ++i)
        std::copy(u[i].begin(), u[i].end(), values.begin() + static_cast<std::ptrdiff_t>(2 * i));
    } else if (field == "stress" || field == "recovered_stress") {
      std::vector<std::array<double, 3>> s(points.size());
      if (field == "stress")
        solution_.stress(points, s);
      else
        solution_.recovered_stress(points, s);
      for (std::size_t i = 0; i < s.size(); ++i)
        std::copy(s[i].begin(), s[i].end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
    } else if (field == "pressure" && solution_.has_pressure())
      solution_.pressure(points, values);
    else
      throw std::invalid_argument(
          fmt::format("no field '{}'; there are displacement, stress and recovered_stress", field));
  }

  std::optional<ForceBalance> own_forces() const override {
    ForceBalance balance;
    for (const auto &forces : {solution_.reactions(), solution_.applied_tractions()})
      for (const auto &[id, force] : forces)
        for (std::size_t d = 0; d < 2; ++d)
          balance.boundary[id][d] += force[d];
    balance.body = solution_.applied_body_force();
    return balance;
  }

  /// Not with a free strain: the elements' sum is of the whole strain.
  std::optional<double> own_strain_energy() const override {
    return thermal_ ? std::nullopt : std::optional(solution_.strain_energy());
  }

private:
  reference::PlaneSolution solution_;
  bool thermal_;
};

std::unique_ptr<Solution> solve(const SolveRequest &request) {
  meshless::linear_algebra::Stopwatch watch;
  const auto problem = reference_problem(request.statement, request.mesh());
  const double points_seconds = watch.lap();
  reference::Options options;
  const std::string &element = request.parameters.text("element");
  options.mixed = element == taylor_hood;
  options.degree = options.mixed ? 2 : element.back() - '0';
  const std::string &solver = request.parameters.text("solver");
  options.solver = solver == "umfpack"     ? reference::LinearSolver::umfpack
                   : solver == "multigrid" ? reference::LinearSolver::multigrid
                                           : reference::LinearSolver::cholesky;
  std::vector<std::string> warnings;
  for (const auto &region : request.statement.regions)
    if (!options.mixed && locks(region.material)) {
      warnings.push_back(locking_warning(region.material));
      break;
    }
  return std::make_unique<ElementField>(reference::solve(problem, options), options, problem.mesh.vertices.size(),
                                        points_seconds, static_cast<bool>(problem.thermal_strain), std::move(warnings));
}

} // namespace

Method fem() {
  Method method;
  method.description.name = "fem";
  method.description.meaning = "isoparametric finite elements, Q1 to Q4 on quadrilaterals and P1 to P4 on triangles";
  method.description.parameters = {
      {.name = "element",
       .type = Type::choice,
       .choices = {"Q1", "Q2", "Q3", "Q4", taylor_hood},
       .default_value = "Q2",
       .meaning = "degree of displacement and geometry; on triangles Q2 stands for P2, and so on; Q2Q1: "
                  "Taylor-Hood with a linear pressure, by UMFPACK, does not lock as nu -> 1/2"},
      {.name = "solver",
       .type = Type::choice,
       .choices = {"cholesky", "umfpack", "multigrid"},
       .default_value = "cholesky",
       .meaning = "CHOLMOD, UMFPACK, or geometric multigrid without a matrix (quadrilaterals only; the first for large "
                  "systems)"},
  };
  method.description.effects = {"elasticity", "body_force", "thermal_expansion"};
  method.description.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    if (context.method.text("element") != taylor_hood)
      check_locking(context, diagnostics);
  };
  method.solve = solve;
  return method;
}

} // namespace comparisons::methods
