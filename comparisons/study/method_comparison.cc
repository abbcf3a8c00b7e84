#include "comparisons/study/method_comparison.h"

#include "comparisons/methods/method_facts.h"
#include "comparisons/metrics/bandwidth.h"
#include "comparisons/metrics/energy.h"
#include "comparisons/metrics/error_norms.h"
#include "comparisons/problems/boundary_quadrature.h"
#include "comparisons/problems/insertion.h"

#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace comparisons::study {

namespace {

using meshless::linear_algebra::Stopwatch;
using problems::Point2;
using problems::Stress2;
using problems::Vector2;
using Facts = std::map<std::string, double>;

bool is_elements(const methods::SolveRequest &request) { return request.parameters.has("element"); }

void put(Facts &facts, const char *name, const std::optional<double> &value) {
  if (value && std::isfinite(*value))
    facts[name] = *value;
}

double area_of(const problems::Quadrature &quadrature) {
  double area = 0;
  for (const double weight : quadrature.weights)
    area += weight;
  return area;
}

/// Numbers that describe the points to a program, and the lines of a file with one particle, vertex, cell or boundary
/// edge on each. A particle carries its distance to neighbours only where the smoothing lengths are taken from it.
void add_input(const methods::SolveRequest &request, Facts &facts) {
  Stopwatch watch;
  if (is_elements(request)) {
    const auto mesh = request.mesh();
    facts["fact_preparation_seconds"] = watch.lap();
    double integers = 3 * static_cast<double>(mesh.boundary.size());
    for (const auto &cell : mesh.cells)
      integers += cell.n_vertices;
    const auto n = static_cast<double>(mesh.vertices.size());
    facts["fact_reals_per_point"] = 2;
    facts["fact_integers_per_point"] = integers / n;
    facts["fact_input_lines"] = n + static_cast<double>(mesh.cells.size() + mesh.boundary.size());
    return;
  }
  const auto cloud = request.cloud();
  facts["fact_preparation_seconds"] = watch.lap();
  facts["fact_reals_per_point"] = request.parameters.text("smoothing_rule") == "given" ? 3 : 2;
  facts["fact_integers_per_point"] = cloud.regions.empty() ? 0 : 1;
  facts["fact_input_lines"] = static_cast<double>(cloud.positions.size());
}

/// The fastest wave of all regions for a density of 1 kg/m^3, sqrt(lambda + 2 mu), of the plane model.
double unit_wave_speed(const problems::PlaneStatement &statement) {
  double speed = 0;
  for (const auto &[name, material, boundary] : statement.regions) {
    const double nu = material.poisson_ratio;
    speed =
        std::max(speed, std::sqrt(material.plane_strain ? material.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
                                                        : material.youngs_modulus / (1 - nu * nu)));
  }
  return speed;
}

void add_method_facts(const methods::MethodFacts &measured, const problems::PlaneStatement &statement, double spacing,
                      Facts &facts, std::vector<std::string> &warnings) {
  put(facts, "fact_integrated_domains", measured.n_integrated_domains);
  put(facts, "fact_quadrature_points", measured.n_quadrature_points);
  put(facts, "fact_subdomains", measured.n_subdomains);
  put(facts, "fact_subdomains_per_point", measured.subdomains_per_point);
  put(facts, "fact_functions_per_point", measured.functions_per_point);
  const auto microseconds = [](const std::optional<double> &seconds) {
    return seconds ? std::optional(1e6 * *seconds) : std::nullopt;
  };
  put(facts, "fact_microseconds_value", microseconds(measured.value_seconds));
  put(facts, "fact_microseconds_gradient", microseconds(measured.gradient_seconds));
  for (const auto &[name, seconds] : {std::pair{"fact_microseconds_place", measured.value_seconds},
                                      std::pair{"fact_microseconds_place_gradient", measured.gradient_seconds}})
    if (seconds && measured.functions_per_point)
      facts[name] = 1e6 * *seconds * *measured.functions_per_point;
  put(facts, "fact_symmetry_defect", measured.symmetry_defect);
  put(facts, "fact_symmetry_defect_inside", measured.symmetry_defect_inside);
  if (!measured.row_start.empty()) {
    const auto n = static_cast<double>(measured.row_start.size() - 1);
    facts["fact_rows"] = 2 * n;
    facts["fact_nonzeros_per_row"] = 2 * static_cast<double>(measured.columns.size()) / n;
    // Two unknowns a node.
    facts["fact_half_bandwidth"] =
        2 * static_cast<double>(metrics::half_bandwidth(measured.row_start, measured.columns)) + 1;
  }
  if (measured.critical_step) {
    facts["fact_critical_courant"] = *measured.critical_step * unit_wave_speed(statement) / spacing;
    facts["fact_critical_step_seconds"] = measured.critical_step_seconds;
  } else
    warnings.push_back("no critical time step: " + measured.no_critical_step);
}

/// sqrt(sum |jump|^2 / sum |mean|^2) of the stress over the inner edges of the mesh, three points on each: from one
/// side to the other, a millionth of the edge apart. The same places for every method.
double stress_jump(const methods::Solution &solution, const problems::Mesh &mesh) {
  std::map<std::pair<unsigned, unsigned>, int> n_cells;
  for (const auto &cell : mesh.cells)
    for (unsigned k = 0; k < cell.n_vertices; ++k)
      ++n_cells[std::minmax(cell.vertices[k], cell.vertices[(k + 1) % cell.n_vertices])];
  std::vector<Point2> points;
  for (const auto &[ends, n] : n_cells) {
    if (n != 2)
      continue;
    const Point2 &a = mesh.vertices[ends.first], &b = mesh.vertices[ends.second];
    const Vector2 along{b[0] - a[0], b[1] - a[1]};
    for (const double t : {.2, .5, .8})
      for (const double side : {-5e-7, 5e-7})
        points.push_back({a[0] + t * along[0] - side * along[1], a[1] + t * along[1] + side * along[0]});
  }
  std::vector<double> s(3 * points.size());
  solution.evaluate("stress", points, s);
  double jump = 0, size = 0;
  for (std::size_t i = 0; i < s.size(); i += 6)
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = k == 2 ? 2 : 1, difference = s[i + 3 + k] - s[i + k], mean = .5 * (s[i + 3 + k] + s[i + k]);
      jump += weight * difference * difference;
      size += weight * mean * mean;
    }
  return size > 0 ? std::sqrt(jump / size) : 0;
}

/// Largest error of a prescribed displacement over the largest displacement on these boundaries.
std::optional<double> essential_error(const methods::Solution &solution, const problems::PlaneStatement &statement) {
  double error = 0, size = 0;
  for (const auto &[id, boundary] : problems::boundary_quadrature(statement)) {
    const auto &condition = statement.conditions.at(id);
    if (!condition.displacement_prescribed[0] && !condition.displacement_prescribed[1])
      continue;
    std::vector<double> u(2 * boundary.points.size());
    std::vector<Vector2> given(boundary.points.size());
    solution.evaluate("displacement", boundary.points, u);
    condition.displacement(boundary.points, given);
    for (std::size_t i = 0; i < given.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        size = std::max(size, std::abs(u[2 * i + k]));
        if (condition.displacement_prescribed[k])
          error = std::max(error, std::abs(u[2 * i + k] - given[i][k]));
      }
  }
  return size > 0 ? std::optional(error / size) : std::nullopt;
}

/// The method's own sum over its cells, or an integral over the quadrature of the error norms as background mesh.
void add_energy(const methods::Solution &solution, const problems::PlaneStatement &statement,
                const problems::Quadrature &quadrature, Facts &facts) {
  Stopwatch watch;
  double energy = 0;
  if (const auto own = solution.own_strain_energy()) {
    energy = *own;
    facts["fact_energy_background_points"] = 0;
  } else {
    std::vector<double> s(3 * quadrature.points.size());
    solution.evaluate("stress", quadrature.points, s);
    for (std::size_t q = 0; q < quadrature.points.size(); ++q) {
      const auto region = quadrature.regions.empty() ? 0 : static_cast<std::size_t>(quadrature.regions[q]);
      energy +=
          .5 * quadrature.weights[q] *
          metrics::twice_energy_density({s[3 * q], s[3 * q + 1], s[3 * q + 2]}, statement.regions[region].material);
    }
    facts["fact_energy_background_points"] = static_cast<double>(quadrature.points.size());
  }
  facts["fact_energy_seconds"] = watch.lap();
  put(facts, "fact_strain_energy", energy);
}

/// Where the stress is largest, by the exact solution if there is one: then all methods add points at the same place.
Point2 most_stressed(const methods::Solution &solution, const problems::PlaneProblem &problem,
                     const problems::Quadrature &quadrature) {
  std::vector<Stress2> s(quadrature.points.size());
  if (const auto &exact = problem.exact(); exact.stress && !exact.only_at)
    exact.stress(quadrature.points, s);
  else {
    std::vector<double> flat(3 * s.size());
    solution.evaluate("stress", quadrature.points, flat);
    for (std::size_t q = 0; q < s.size(); ++q)
      s[q] = {flat[3 * q], flat[3 * q + 1], flat[3 * q + 2]};
  }
  const auto size = [](const Stress2 &t) { return t[0] * t[0] + t[1] * t[1] + 2 * t[2] * t[2]; };
  std::size_t largest = 0;
  for (std::size_t q = 0; q < s.size(); ++q)
    if (size(s[q]) > size(s[largest]))
      largest = q;
  return quadrature.points[largest];
}

/// A tenth more points there, and the problem solved again; the errors by the same quadrature.
void add_insertion(const methods::Method &method, const methods::SolveRequest &request, const Point2 &place,
                   const problems::PlaneProblem &problem, const problems::Quadrature &quadrature, Facts &facts) {
  problems::Cloud cloud;
  problems::Mesh mesh;
  std::size_t n_before = 0, n_after = 0;
  double insertion = 0;
  if (is_elements(request)) {
    mesh = request.mesh();
    n_before = mesh.vertices.size();
    Stopwatch watch;
    mesh = problems::with_points_near(place, (n_before + 5) / 10, std::move(mesh));
    insertion = watch.lap();
    n_after = mesh.vertices.size();
  } else {
    cloud = request.cloud();
    n_before = cloud.positions.size();
    Stopwatch watch;
    cloud = problems::with_points_near(place, (n_before + 5) / 10, std::move(cloud), request.statement);
    insertion = watch.lap();
    n_after = cloud.positions.size();
  }
  facts["fact_points_added"] = static_cast<double>(n_after - n_before);
  facts["fact_insertion_seconds"] = insertion;
  const methods::SolveRequest again{request.statement, [&] { return cloud; }, [&] { return mesh; }, request.parameters};
  Stopwatch watch;
  const auto solution = method.solve(again);
  facts["fact_insertion_solve_seconds"] = watch.lap();
  const auto errors = metrics::error_norms(*solution, problem, quadrature);
  if (const auto found = errors.find("stress_l2_relative"); found != errors.end())
    put(facts, "fact_insertion_stress_error", found->second);
}

} // namespace

std::map<std::string, double> measured_facts(const methods::Method &method, const methods::SolveRequest &request,
                                             const methods::Solution &solution, const problems::PlaneProblem &problem,
                                             const problems::Quadrature &quadrature,
                                             std::vector<std::string> &warnings) {
  Facts facts;
  add_input(request, facts);
  const double spacing =
      std::sqrt(area_of(quadrature) / static_cast<double>(std::max<std::int64_t>(1, solution.record().n_points)));
  add_method_facts(methods::method_facts(request, method.description.name, quadrature.points), request.statement,
                   spacing, facts, warnings);
  const auto &seconds = solution.record().seconds;
  double assembly = 0;
  for (const char *phase : {"neighbours", "basis", "assembly"})
    if (const auto found = seconds.find(phase); found != seconds.end())
      assembly += found->second;
  facts["fact_assembly_seconds"] = assembly;
  facts["fact_stress_jump"] = stress_jump(solution, request.mesh());
  put(facts, "fact_essential_error", essential_error(solution, request.statement));
  add_energy(solution, request.statement, quadrature, facts);
  try {
    add_insertion(method, request, most_stressed(solution, problem, quadrature), problem, quadrature, facts);
  } catch (const std::exception &error) {
    warnings.push_back(fmt::format("points were added, but the problem was not solved again: {}", error.what()));
  }
  return facts;
}

} // namespace comparisons::study
