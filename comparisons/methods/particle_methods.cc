#include "comparisons/methods/particle_methods.h"

#include "comparisons/methods/corner_parameter.h"
#include "comparisons/methods/locking.h"
#include "comparisons/methods/lower_order.h"
#include "comparisons/methods/particle_field.h"
#include "comparisons/methods/particle_points.h"
#include "comparisons/methods/recoveries.h"
#include "comparisons/methods/solver_keys.h"

#include "meshless/basis/basis_table.h"
#include "meshless/elasticity/mixed_form/displacement_pressure.h"
#include "meshless/elasticity/strong_form/collocation.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

namespace comparisons::methods {

namespace {

namespace elasticity = meshless::elasticity;

elasticity::weak_form::Subdomains subdomains_of(const SolveRequest &request, const Prepared &p) {
  return shrinks_subdomains(request.parameters, p.regular, p.particles->has_flattenings())
             ? elasticity::weak_form::Subdomains::shrunk
             : elasticity::weak_form::Subdomains::whole;
}

elasticity::weak_form::Parameters weak_parameters(const SolveRequest &request, Form form, const Prepared &p) {
  const auto &parameters = request.parameters;
  elasticity::weak_form::Parameters weak;
  weak.derivatives =
      form == Form::weak2 ? elasticity::DerivativeRule::differentiated : elasticity::DerivativeRule::direct;
  weak.test_radius = p.test_radius;
  weak.test_function = test_function_of(parameters, p.test_radius);
  weak.subdomains = subdomains_of(request, p);
  weak.interior_rows = form == Form::hybrid ? elasticity::weak_form::InteriorRows::collocated
                                            : elasticity::weak_form::InteriorRows::weak;
  weak.integration = parameters.text("quadrature") == "consistent" ? elasticity::weak_form::IntegrationRule::consistent
                                                                   : elasticity::weak_form::IntegrationRule::paper;
  weak.repeated_rows = parameters.text("repeated_rows") == "computed" ? elasticity::weak_form::RepeatedRows::computed
                                                                      : elasticity::weak_form::RepeatedRows::copied;
  weak.quadrature_points = static_cast<int>(parameters.integer("quadrature_points"));
  if (parameters.has("penalty"))
    weak.penalty = parameters.real("penalty");
  else if (!p.regular) {
    weak.penalty = elasticity::weak_form::moderate_penalty;
    weak.penalty_length = elasticity::weak_form::PenaltyLength::smoothing;
  }
  weak.characteristic_length = request.statement.characteristic_length;
  weak.solver = solver_request(request.parameters);
  return weak;
}

elasticity::mixed_form::Parameters mixed_parameters(const SolveRequest &request, const Prepared &p) {
  elasticity::mixed_form::Parameters mixed;
  mixed.test_radius = p.test_radius;
  mixed.test_function = *test_function_of(request.parameters, p.test_radius);
  mixed.subdomains = subdomains_of(request, p);
  mixed.stabilisation = request.parameters.real("stabilisation");
  mixed.ordering = solver_request(request.parameters).ordering;
  return mixed;
}

std::shared_ptr<const meshless::basis::ShapeFunctions<2>> pressure_basis(const SolveRequest &request,
                                                                         const Prepared &p) {
  return meshless::basis::make_basis<2>(request.parameters.text("basis"), p.basis->order() - 1,
                                        pressure_kernel_of(request.parameters, p.regular));
}

std::vector<elasticity::strong_form::CornerRule> corner_rules(const SolveRequest &request) {
  return read_corner_rules(request.parameters.text("corner"), request.statement.corners);
}

/// What theory says of the cell before it is solved.
std::vector<std::string> forewarnings(const SolveRequest &request, Form form, bool regular) {
  std::vector<std::string> warnings;
  for (const auto &region : request.statement.regions)
    if (form != Form::mixed && locks(region.material)) {
      warnings.push_back(locking_warning(region.material));
      break;
    }
  if (!regular && request.parameters.integer("order") == 1)
    warnings.emplace_back("order 1 on irregular particles: its errors hardly converge; order 2 does");
  if (!regular && collocates(form) && form != Form::mixed && request.parameters.integer("order") == 2)
    warnings.emplace_back(
        "equilibrium collocated with order 2 on irregular particles: second derivatives are accurate to "
        "the first order of h only; order 3 or a weak form is safer");
  return warnings;
}

elasticity::ParticleSolution solve_form(const SolveRequest &request, Form form, const Prepared &p) {
  switch (form) {
  case Form::strong:
    return elasticity::strong_form::solve(p.problem, p.particles, p.basis, corner_rules(request),
                                          solver_request(request.parameters));
  case Form::mixed:
    return elasticity::mixed_form::solve(p.problem, p.particles, p.basis, pressure_basis(request, p),
                                         mixed_parameters(request, p));
  default:
    return elasticity::weak_form::solve(p.problem, p.particles, p.basis, weak_parameters(request, form, p));
  }
}

std::unique_ptr<Solution> solve(const SolveRequest &request, Form form) {
  return at_existing_order(request, form, [form](const SolveRequest &taken, const OrderSearch &search) {
    auto p = prepare(taken, form);
    p.order = search.taken();
    if (form == Form::weak1 || form == Form::weak2 || form == Form::hybrid)
      p.weak = weak_parameters(taken, form, p);
    auto solution = solve_form(taken, form, p);
    auto warnings = forewarnings(taken, form, p.regular);
    return std::make_unique<ParticleField>(std::move(solution), std::move(p), std::move(warnings));
  });
}

/// Collocation has no rows that are dear: two rows of a particle take what looking at its surroundings takes, and
/// half as much again.
CloudReport inspect_order(const SolveRequest &request, Form form, const OrderSearch &search) {
  constexpr std::size_t n_sampled = 40;
  auto p = prepare(request, form);
  p.order = search.taken();
  meshless::linear_algebra::Stopwatch watch;
  auto report = cloud_report(p);
  const double seconds = watch.lap();
  if (search.may_lower() && !(report.pivot_ratio > meshless::basis::singular_pivot_ratio)) // the sample may miss it
    throw meshless::basis::SingularMomentMatrix(
        fmt::format("singular moment matrix at ({:.6g}, {:.6g})", report.worst_point[0], report.worst_point[1]));
  elasticity::RowSample rows{4 * static_cast<double>(p.particles->size() * report.median_neighbours), 1.5 * seconds};
  if (form == Form::mixed)
    rows = elasticity::mixed_form::sample_rows(p.problem, *p.particles, *p.basis, *pressure_basis(request, p),
                                               mixed_parameters(request, p), n_sampled);
  else if (form != Form::strong)
    rows = elasticity::weak_form::sample_rows(p.problem, *p.particles, *p.basis, weak_parameters(request, form, p),
                                              n_sampled);
  report.nonzeros = rows.nonzeros;
  report.seconds = p.points_seconds + p.enlarge_seconds + rows.seconds;
  return report;
}

CloudReport inspect(const SolveRequest &request, Form form) {
  return at_existing_order(request, form, [form](const SolveRequest &taken, const OrderSearch &search) {
    return inspect_order(taken, form, search);
  });
}

Form form_of(const std::string &method) {
  if (method == "strong")
    return Form::strong;
  return method == "weak1" ? Form::weak1 : method == "weak2" ? Form::weak2 : Form::hybrid;
}

Method make(std::string name, std::string meaning, Form form) {
  Method method;
  method.description.name = std::move(name);
  method.description.meaning = std::move(meaning);
  method.description.parameters = particle_keys(form);
  method.description.effects = {"elasticity", "body_force"};
  if (form != Form::mixed)
    method.description.effects.emplace_back("thermal_expansion");
  method.description.check = [form](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    check_particle_keys(form, context, diagnostics);
  };
  method.solve = [form](const SolveRequest &request) { return solve(request, form); };
  method.inspect = [form](const SolveRequest &request) { return inspect(request, form); };
  return method;
}

} // namespace

Method strong() { return make("strong", "collocation of the strong form (Batra & Zhang 2008, 3.1)", Form::strong); }

Method weak1() { return make("weak1", "MLPG, derivatives found directly (3.2.1)", Form::weak1); }

Method hybrid() { return make("hybrid", "equilibrium collocated inside, MLPG rows on the boundary", Form::hybrid); }

Method weak2() { return make("weak2", "MLPG, differentiated shape functions (3.2.2)", Form::weak2); }

Method mixed() {
  return make("mixed", "MLPG for displacement and pressure, stabilised (PSPG): does not lock as nu -> 1/2",
              Form::mixed);
}

std::unique_ptr<WeakSystem> weak_system(const SolveRequest &request, const std::string &method) {
  const Form form = form_of(method);
  auto p = prepare(request, form);
  const auto parameters = weak_parameters(request, form, p);
  auto system = elasticity::weak_form::linear_system(p.problem, *p.particles, *p.basis, parameters);
  return std::make_unique<WeakSystem>(std::move(p), parameters, std::move(system));
}

std::unique_ptr<Solution> WeakSystem::solution(std::vector<double> coefficients) const {
  return std::make_unique<ParticleField>(elasticity::weak_form::solution_of(prepared_.problem, prepared_.particles,
                                                                            prepared_.basis, parameters_,
                                                                            std::move(coefficients)),
                                         prepared_, std::vector<std::string>{});
}

ParticleMotion equations_of_motion(const SolveRequest &request, const std::string &method) {
  const Form form = form_of(method);
  std::vector<double> densities;
  for (const auto &region : request.statement.regions)
    densities.push_back(region.material.density);
  return at_existing_order(request, form, [&](const SolveRequest &taken, const OrderSearch &search) {
    auto p = prepare(taken, form);
    p.order = search.taken();
    auto equations = form == Form::strong
                         ? elasticity::strong_form::equations_of_motion(p.problem, densities, p.particles, p.basis,
                                                                        corner_rules(taken))
                         : elasticity::weak_form::equations_of_motion(p.problem, densities, p.particles, p.basis,
                                                                      weak_parameters(taken, form, p));
    equations.seconds.neighbours += p.points_seconds + p.enlarge_seconds;
    equations.seconds.basis += p.order.lost_seconds;
    return ParticleMotion{std::move(equations), recoveries_of(p)};
  });
}

} // namespace comparisons::methods
