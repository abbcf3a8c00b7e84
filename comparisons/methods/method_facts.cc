#include "comparisons/methods/method_facts.h"

#include "comparisons/methods/fem.h"
#include "comparisons/methods/particle_methods.h"
#include "comparisons/methods/particle_points.h"

#include "fem_reference/elasticity/element_facts.h"
#include "fem_reference/elasticity/plane_dynamics.h"

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/domain/local_subdomain.h"
#include "meshless/dynamics/plane_motion.h"
#include "meshless/elasticity/surroundings.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <algorithm>
#include <cmath>

namespace comparisons::methods {

namespace {

namespace reference = fem_reference::elasticity;
using meshless::linear_algebra::SparseRows;
using meshless::linear_algebra::Stopwatch;
using Index = std::size_t;

constexpr int n_repeats = 5;

/// The statement without loads, its supports at rest, and of a density of 1 kg/m^3: what a time step depends on.
problems::PlaneStatement at_rest(problems::PlaneStatement statement) {
  statement.body_force = {};
  statement.thermal_strain = {};
  for (auto &region : statement.regions)
    region.material.density = 1;
  for (auto &[id, condition] : statement.conditions) {
    condition.traction = {};
    if (condition.displacement)
      condition.displacement = [](std::span<const problems::Point2>, std::span<problems::Vector2> values) {
        std::fill(values.begin(), values.end(), problems::Vector2{});
      };
  }
  return statement;
}

double entry(const SparseRows &matrix, std::int64_t row, std::int64_t column) {
  const auto begin = matrix.columns().begin() + matrix.offsets()[static_cast<Index>(row)];
  const auto end = matrix.columns().begin() + matrix.offsets()[static_cast<Index>(row) + 1];
  const auto found = std::lower_bound(begin, end, column);
  return found != end && *found == column ? matrix.values()[static_cast<Index>(found - matrix.columns().begin())] : 0;
}

/// Over the rows and columns of particles that are chosen.
double symmetry_defect(const SparseRows &matrix, const std::vector<bool> &chosen) {
  double difference = 0, whole = 0;
  for (std::int64_t i = 0; i < matrix.n_rows(); ++i)
    for (auto k = matrix.offsets()[static_cast<Index>(i)]; k < matrix.offsets()[static_cast<Index>(i) + 1]; ++k) {
      const auto j = matrix.columns()[static_cast<Index>(k)];
      if (!chosen[static_cast<Index>(i / 2)] || !chosen[static_cast<Index>(j / 2)])
        continue;
      const double a = matrix.values()[static_cast<Index>(k)], b = entry(matrix, j, i);
      // An entry without its mirror image is met once, the others twice.
      difference += (b == 0 ? 2 : 1) * (a - b) * (a - b);
      whole += a * a;
    }
  return whole > 0 ? std::sqrt(difference / whole) : 0;
}

void add_pattern(const SparseRows &matrix, MethodFacts &facts) {
  facts.row_start = {0};
  std::vector<std::int64_t> row;
  for (std::int64_t i = 0; i < matrix.n_rows(); i += 2) {
    row.clear();
    for (auto k = matrix.offsets()[static_cast<Index>(i)]; k < matrix.offsets()[static_cast<Index>(i) + 2]; ++k)
      row.push_back(matrix.columns()[static_cast<Index>(k)] / 2);
    std::sort(row.begin(), row.end());
    facts.columns.insert(facts.columns.end(), row.begin(), std::unique(row.begin(), row.end()));
    facts.row_start.push_back(static_cast<std::int64_t>(facts.columns.size()));
  }
}

double median(std::vector<double> samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

/// Of one region: those of several are cut off from each other, point by point.
void add_shape_functions(const Prepared &p, bool differentiated, std::span<const problems::Point2> points,
                         MethodFacts &facts) {
  const meshless::elasticity::Surroundings surroundings(p.problem.regions);
  if (surroundings.n_regions() > 1 || points.empty())
    return;
  const meshless::cloud::CandidateSearch<2> search(*p.particles, p.basis->support());
  meshless::elasticity::RegionFilter filter(surroundings, *p.particles, 0);
  const meshless::basis::GroupedEvaluation<2> evaluation(*p.basis, search, surroundings.simple() ? nullptr : &filter);
  double n_functions = 0;
  evaluation.visit(points, {.value = true}, [&](const auto &group) {
    for (Index i = 0; i < group.points.size(); ++i)
      for (Index j = 0; j < group.n_neighbours(i); ++j)
        n_functions += group.values.value(j)[i] != 0 ? 1 : 0;
  });
  const auto n = static_cast<double>(points.size());
  facts.functions_per_point = n_functions / n;
  double n_supports = 0;
  std::vector<meshless::cloud::Index> near;
  for (const auto &x : points) {
    search.collect(x, 0, near);
    n_supports += static_cast<double>(near.size());
  }
  facts.subdomains_per_point = n_supports / n;
  const auto seconds = [&](const meshless::basis::Wanted &wanted) {
    std::vector<double> samples;
    for (int k = 0; k < n_repeats; ++k) {
      Stopwatch watch;
      evaluation.visit(points, wanted, [](const auto &) {});
      samples.push_back(watch.lap());
    }
    return median(samples) / n_functions;
  };
  facts.value_seconds = seconds({.value = true});
  facts.gradient_seconds =
      seconds({.value = true, .gradient = !differentiated, .differentiated_gradient = differentiated});
}

/// Of the papers' rule; the consistent one has points of its own.
void add_quadrature(const SolveRequest &request, const Prepared &p, MethodFacts &facts) {
  facts.n_integrated_domains = static_cast<double>(p.particles->size());
  const meshless::elasticity::Surroundings surroundings(p.problem.regions);
  if (request.parameters.text("quadrature") != "paper" ||
      shrinks_subdomains(request.parameters, p.regular, p.particles->has_flattenings()) || surroundings.n_regions() > 1)
    return;
  meshless::domain::SubdomainRule rule(surroundings.boundary(0),
                                       static_cast<int>(request.parameters.integer("quadrature_points")),
                                       &surroundings.visibility(0));
  meshless::domain::SubdomainQuadrature quadrature;
  double n = 0;
  for (Index i = 0; i < p.particles->size(); ++i) {
    rule.build(p.particles->position(i), {p.test_radius * p.particles->smoothing_length(i), p.particles->flattening(i)},
               quadrature);
    n += static_cast<double>(quadrature.JxW.size() + quadrature.boundary_JxW.size());
  }
  facts.n_quadrature_points = n;
}

void add_particle_step(const std::shared_ptr<const meshless::elasticity::EquationsOfMotion> &equations,
                       MethodFacts &facts) {
  Stopwatch watch;
  try {
    const meshless::dynamics::PlaneMotion motion(
        equations, {.integration = meshless::dynamics::TimeIntegration::central_difference});
    facts.critical_step = motion.stable_step();
    facts.critical_step_seconds = watch.lap();
  } catch (const std::exception &error) {
    facts.no_critical_step = error.what();
  }
}

Form form_of(const std::string &method) {
  return method == "strong"   ? Form::strong
         : method == "weak1"  ? Form::weak1
         : method == "weak2"  ? Form::weak2
         : method == "hybrid" ? Form::hybrid
                              : Form::mixed;
}

MethodFacts particle_facts(const SolveRequest &request, const std::string &method,
                           std::span<const problems::Point2> points) {
  const auto statement = at_rest(request.statement);
  const SolveRequest still{statement, request.cloud, request.mesh, request.parameters};
  const Form form = form_of(method);
  const auto p = prepare(still, form);
  MethodFacts facts;
  facts.n_subdomains = static_cast<double>(p.particles->size());
  if (form == Form::strong)
    facts.n_integrated_domains = facts.n_quadrature_points = 0;
  else if (form == Form::weak1 || form == Form::weak2)
    add_quadrature(still, p, facts);
  add_shape_functions(p, form == Form::weak2, points, facts);
  if (form == Form::mixed) { // its equations of motion are not written
    facts.no_critical_step = "mixed has no equations of motion";
    return facts;
  }
  const auto equations =
      std::make_shared<const meshless::elasticity::EquationsOfMotion>(equations_of_motion(still, method).equations);
  add_pattern(equations->stiffness, facts);
  std::vector<bool> chosen(p.particles->size(), true);
  facts.symmetry_defect = symmetry_defect(equations->stiffness, chosen);
  for (Index i = 0; i < chosen.size(); ++i)
    chosen[i] = p.problem.regions[static_cast<Index>(p.particles->region(i))]
                    .boundary.pieces_at(p.particles->position(i))
                    .empty();
  facts.symmetry_defect_inside = symmetry_defect(equations->stiffness, chosen);
  add_particle_step(equations, facts);
  return facts;
}

MethodFacts element_facts(const SolveRequest &request) {
  const auto statement = at_rest(request.statement);
  const auto problem = reference_problem(statement, request.mesh());
  const std::string &element = request.parameters.text("element");
  const int degree = element[1] - '0';
  const auto measured = reference::element_facts(problem, degree, n_repeats);
  MethodFacts facts;
  facts.row_start = measured.row_start;
  facts.columns = measured.columns;
  facts.symmetry_defect = reference::symmetry_defect(problem, degree);
  facts.n_subdomains = static_cast<double>(problem.mesh.cells.size());
  facts.n_integrated_domains = facts.n_subdomains;
  const auto n = static_cast<double>(measured.n_quadrature_points);
  facts.n_quadrature_points = n;
  double area = 0; // of the polygon through the boundary, by the divergence theorem, arcs as arcs
  for (const auto &region : request.statement.regions)
    for (const auto &piece : region.boundary) {
      area += .5 * (piece.begin[0] * piece.end[1] - piece.end[0] * piece.begin[1]);
      if (piece.arc) { // the segment between chord and arc
        const double radius = std::hypot(piece.begin[0] - piece.arc->centre[0], piece.begin[1] - piece.arc->centre[1]);
        const double chord = std::hypot(piece.end[0] - piece.begin[0], piece.end[1] - piece.begin[1]);
        const double angle = 2 * std::asin(std::min(1.0, chord / (2 * radius)));
        area += (piece.arc->counter_clockwise ? .5 : -.5) * radius * radius * (angle - std::sin(angle));
      }
    }
  facts.subdomains_per_point = measured.area / area;
  facts.functions_per_point = measured.functions_per_point;
  facts.value_seconds = measured.value_seconds / (n * measured.functions_per_point);
  facts.gradient_seconds = measured.gradient_seconds / (n * measured.functions_per_point);
  Stopwatch watch;
  try {
    const reference::PlaneMotion motion(problem,
                                        {.degree = degree,
                                         .mass = reference::Mass::lumped,
                                         .densities = std::vector<double>(request.statement.regions.size(), 1)},
                                        reference::TimeIntegration::central_difference);
    const auto prepared = motion.seconds();
    facts.critical_step_seconds = watch.lap() - prepared.mesh - prepared.degrees_of_freedom - prepared.assembly;
    facts.critical_step = motion.stable_step();
  } catch (const std::exception &error) {
    facts.no_critical_step = error.what();
  }
  return facts;
}

} // namespace

MethodFacts method_facts(const SolveRequest &request, const std::string &method,
                         std::span<const problems::Point2> points) {
  return method == "fem" ? element_facts(request) : particle_facts(request, method, points);
}

} // namespace comparisons::methods
