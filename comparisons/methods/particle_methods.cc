#include "comparisons/methods/particle_methods.h"

#include "comparisons/methods/corner_parameter.h"

#include "meshless/basis/basis_table.h"
#include "meshless/elasticity/strong_form/collocation.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"
#include "meshless/kernels/kernel_table.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comparisons::methods {

namespace {

namespace elasticity = meshless::elasticity;
using scene::Declaration;
using scene::Parameters;
using scene::Type;

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const auto &kernel : meshless::kernels::kernel_table())
    names.emplace_back(kernel.name);
  return names;
}

/// A test function must vanish where the local subdomain ends and be smooth inside: the quadrature of
/// subdomains does not stop where a spline's pieces meet.
std::vector<std::string> test_function_names() {
  std::vector<std::string> names;
  for (const auto &kernel : meshless::kernels::kernel_table())
    if (kernel.edge_smoothness >= 0 &&
        meshless::kernels::breaks_of(meshless::kernels::make_kernel(kernel.name, {})).empty())
      names.emplace_back(kernel.name);
  return names;
}

enum class Form { strong, weak1, weak2 };

/// Bases that a form can use: in two dimensions, without volumes (a scene's clouds have none), with the
/// derivatives that it asks for.
std::vector<std::string> basis_names(Form form) {
  std::vector<std::string> names;
  for (const auto &basis : meshless::basis::basis_table()) {
    const bool able = form == Form::strong ? basis.hessian_anywhere : form == Form::weak1 || basis.differentiable;
    if (able && basis.highest_dimension >= 2 && basis.volumes == meshless::basis::VolumeUse::optional)
      names.emplace_back(basis.name);
  }
  return names;
}

/// Keys that every particle method has.
std::vector<Declaration> basis_declarations(Form form, int lowest_order) {
  const auto positive = scene::Range{.lower = 0, .lower_open = true};
  return {
      {.name = "basis",
       .type = Type::choice,
       .choices = basis_names(form),
       .default_value = "ssph",
       .meaning = "how shape functions are made"},
      {.name = "order",
       .type = Type::integer,
       .range = {.lower = static_cast<double>(lowest_order), .upper = 4},
       .default_value = std::int64_t{2},
       .meaning = "m, degree of the complete monomials"},
      {.name = "kernel",
       .type = Type::choice,
       .choices = kernel_names(),
       .default_value = "gauss",
       .meaning = "kernel W of the basis"},
      {.name = "kernel_parameter", .range = positive, .meaning = "the kernel's own parameter, such as the decay a"},
      {.name = "support",
       .range = {.lower = 1, .upper = 20, .lower_open = true},
       .meaning = "rho, support of the kernel in units of h; if absent, order + 2 or the kernel's own"},
      {.name = "smoothing_length",
       .range = positive,
       .default_value = 1.0,
       .meaning = "h over the distance that smoothing_rule names"},
      {.name = "smoothing_rule",
       .type = Type::choice,
       .choices = {"given", "nearest", "mean4"},
       .default_value = "given",
       .meaning =
           "distance that h is measured in: the level's own spacing, the nearest particle, the mean of the 4 nearest"},
  };
}

std::vector<Declaration> weak_declarations(Form form) {
  auto keys = basis_declarations(form, 1);
  keys.insert(keys.end(),
              {{.name = "test_function",
                .type = Type::choice,
                .choices = test_function_names(),
                .default_value = "gauss",
                .meaning = "test function of the local weak form"},
               {.name = "test_radius",
                .range = {.lower = 0.05, .upper = 10},
                .default_value = 1.0,
                .meaning = "radius of the local subdomain in units of h"},
               {.name = "quadrature_points",
                .type = Type::integer,
                .range = {.lower = 1, .upper = 64},
                .default_value = std::int64_t{10},
                .meaning = "nG: radial points; 4 nG in the angle, nG on a boundary part"},
               {.name = "penalty",
                .range = {.lower = 0, .lower_open = true},
                .default_value = 1e5,
                .meaning = "penalty alpha on prescribed displacement, in units of E0 over the domain's length"},
               {.name = "solver",
                .type = Type::choice,
                .choices = {"umfpack"},
                .default_value = "umfpack",
                .meaning = "linear solver"}});
  return keys;
}

std::vector<Declaration> strong_declarations() {
  auto keys = basis_declarations(Form::strong, 2);
  keys.insert(keys.end(),
              {{.name = "corner",
                .type = Type::text,
                .default_value = "",
                .meaning = "conditions at corners, as \"NE: s11 s22, SW: u1 t2\"; the default is essential conditions "
                           "first, else s11 and s12"},
               {.name = "solver",
                .type = Type::choice,
                .choices = {"umfpack"},
                .default_value = "umfpack",
                .meaning = "linear solver"}});
  return keys;
}

/// The kernel of a method. The support is rho where the scene gives it, order + 2 for a kernel with a free
/// cut-off, else the kernel's own.
meshless::kernels::Kernel kernel_of(const Parameters &parameters) {
  const std::string &name = parameters.text("kernel");
  std::optional<double> support;
  if (parameters.has("support"))
    support = parameters.real("support");
  for (const auto &kernel : meshless::kernels::kernel_table())
    if (!support && kernel.name == name && kernel.free_support)
      support = static_cast<double>(parameters.integer("order")) + 2;
  std::optional<double> parameter;
  if (parameters.has("kernel_parameter"))
    parameter = parameters.real("kernel_parameter");
  return meshless::kernels::make_kernel(name, support, parameter);
}

/// The Gauss function of (3.15) has its cut-off at the radius of the subdomain; kernels with a support of
/// their own are stretched to it.
meshless::kernels::Kernel test_function_of(const Parameters &parameters) {
  const std::string &name = parameters.text("test_function");
  std::optional<double> support;
  for (const auto &kernel : meshless::kernels::kernel_table())
    if (kernel.name == name && kernel.free_support)
      support = parameters.real("test_radius");
  return meshless::kernels::make_kernel(name, support);
}

/// Errors that can be told before any computing.
void check_support(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &method = context.method;
  double support = 0;
  try {
    support = meshless::kernels::support_of(kernel_of(method));
  } catch (const std::invalid_argument &error) {
    const char *key = method.is_given("support") ? "support" : "kernel_parameter";
    diagnostics.error(method.location(key), context.method_key + "." + key, error.what());
    return;
  }
  const double reach = support * method.real("smoothing_length");
  const auto order = method.integer("order");
  if (method.text("smoothing_rule") == "given" && reach < static_cast<double>(order))
    diagnostics.error(method.location(method.is_given("support") ? "support" : "smoothing_length"),
                      context.method_key + ".support",
                      fmt::format("the support reaches {} spacings, too small for order {}: a corner of the domain "
                                  "needs {} lines of particles, so more than {}",
                                  reach, order, order + 1, order),
                      fmt::format("support = {}", order + 2));
}

void check_plane_strain(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const double nu = context.material.real("nu");
  if (context.material.text("model") == "plane strain" && nu > 0.49 && nu < 0.5)
    diagnostics.warning(
        context.material.location("nu"), "material.nu",
        fmt::format("{} is nearly incompressible: displacement methods in plane strain lock above 0.49, "
                    "and their errors grow",
                    nu));
}

void check_corner(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  // The corners' names are those of the benchmark; their positions do not matter here.
  static const std::vector<problems::Corner> corners{{"NE", {}}, {"SE", {}}, {"SW", {}}, {"NW", {}}};
  try {
    read_corner_rules(context.method.text("corner"), corners);
  } catch (const std::invalid_argument &error) {
    diagnostics.error(context.method.location("corner"), context.method_key + ".corner", error.what());
  }
}

elasticity::PlaneProblem translate(const problems::PlaneStatement &statement) {
  if (statement.regions.size() != 1)
    throw Refused("several materials are not possible yet");
  const auto &region = statement.regions.front();
  std::vector<meshless::domain::BoundaryPiece> pieces;
  for (const auto &piece : region.boundary) {
    pieces.push_back({piece.begin, piece.end, piece.id});
    if (piece.arc)
      pieces.back().arc = {piece.arc->centre, piece.arc->counter_clockwise};
  }
  elasticity::PlaneProblem problem{meshless::domain::Boundary(std::move(pieces)),
                                   elasticity::Material(region.material.youngs_modulus, region.material.poisson_ratio,
                                                        region.material.plane_strain
                                                            ? elasticity::PlaneModel::plane_strain
                                                            : elasticity::PlaneModel::plane_stress),
                                   {},
                                   statement.body_force};
  for (const auto &[id, condition] : statement.conditions) {
    elasticity::BoundaryCondition translated;
    for (std::size_t k = 0; k < 2; ++k)
      translated.kind[k] = condition.displacement_prescribed[k] ? elasticity::ConditionKind::displacement
                                                                : elasticity::ConditionKind::traction;
    translated.displacement = condition.displacement;
    translated.traction = condition.traction;
    problem.conditions[id] = std::move(translated);
  }
  return problem;
}

std::shared_ptr<const meshless::cloud::Particles<2>> make_particles(problems::Cloud cloud,
                                                                    const Parameters &parameters) {
  const double factor = parameters.real("smoothing_length");
  const std::string &rule = parameters.text("smoothing_rule");
  std::vector<double> h;
  if (rule == "given") {
    h = std::move(cloud.spacing);
    for (double &length : h)
      length *= factor;
  } else
    h = meshless::cloud::smoothing_lengths_by_mean<2>(cloud.positions, rule == "nearest" ? 1 : 4, factor);
  return std::make_shared<const meshless::cloud::Particles<2>>(std::move(cloud.positions), std::move(h));
}

class ParticleField final : public Solution {
public:
  ParticleField(elasticity::ParticleSolution solution, std::shared_ptr<const meshless::basis::ShapeFunctions<2>> basis,
                double points_seconds)
      : solution_(std::move(solution)), basis_(std::move(basis)) {
    const auto &s = solution_.seconds;
    record_.n_points = static_cast<std::int64_t>(solution_.particles().size());
    record_.n_dofs = 2 * record_.n_points;
    record_.nonzeros = solution_.nonzeros;
    record_.seconds = {{"points", points_seconds},
                       {"neighbours", s.neighbours},
                       {"basis", s.basis},
                       {"assembly", s.assembly},
                       {"solve", s.solve}};
    record_.quantities = {{"backward_error", solution_.backward_error},
                          {"reciprocal_condition", solution_.reciprocal_condition}};
    if (solution_.backward_error > 1e-10)
      record_.warnings.push_back(
          fmt::format("the linear system was solved with a backward error of {:.1e} only", solution_.backward_error));
  }

  std::vector<std::string> fields() const override { return {"displacement", "stress"}; }
  std::size_t n_components(std::string_view field) const override { return field == "displacement" ? 2 : 3; }

  void evaluate(std::string_view field, std::span<const std::array<double, 2>> points,
                std::span<double> values) const override {
    if (field == "displacement") {
      std::vector<elasticity::Vector2> u(points.size());
      solution_.displacement(points, u);
      for (std::size_t i = 0; i < u.size(); ++i)
        std::copy(u[i].begin(), u[i].end(), values.begin() + static_cast<std::ptrdiff_t>(2 * i));
    } else if (field == "stress") {
      std::vector<elasticity::Stress2> s(points.size());
      solution_.stress(points, s);
      for (std::size_t i = 0; i < s.size(); ++i)
        std::copy(s[i].begin(), s[i].end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
    } else
      throw std::invalid_argument(fmt::format("no field '{}'; there are displacement and stress", field));
  }

  std::vector<std::array<double, 2>> own_points() const override {
    const auto positions = solution_.particles().positions();
    return {positions.begin(), positions.end()};
  }

  /// Smoothing length, and neighbours and regularity of the moment matrix (smallest pivot over its diagonal entry, 1 at
  /// best) at every particle.
  std::map<std::string, std::vector<double>> own_figures() const override {
    const auto &particles = solution_.particles();
    const meshless::cloud::CandidateSearch<2> search(particles, basis_->support());
    const meshless::basis::GroupedEvaluation<2> evaluation(*basis_, search);
    std::vector<double> n_neighbours, regularity;
    for (std::size_t i = 0; i < particles.size(); ++i)
      evaluation.visit(particles.positions().subspan(i, 1), {.value = true}, [&](const auto &group) {
        n_neighbours.push_back(static_cast<double>(group.regularity.n_neighbours));
        regularity.push_back(group.regularity.smallest_pivot_ratio);
      });
    return {{"smoothing_length", {particles.smoothing_lengths().begin(), particles.smoothing_lengths().end()}},
            {"n_neighbours", std::move(n_neighbours)},
            {"moment_pivot_ratio", std::move(regularity)}};
  }

private:
  elasticity::ParticleSolution solution_;
  std::shared_ptr<const meshless::basis::ShapeFunctions<2>> basis_;
};

std::unique_ptr<Solution> solve(const SolveRequest &request, Form form) {
  const auto &parameters = request.parameters;
  meshless::linear_algebra::Stopwatch watch;
  const auto particles = make_particles(request.cloud(), parameters);
  const double points_seconds = watch.lap();
  const auto kernel = kernel_of(parameters);
  std::shared_ptr<const meshless::basis::ShapeFunctions<2>> basis =
      meshless::basis::make_basis<2>(parameters.text("basis"), static_cast<int>(parameters.integer("order")), kernel);
  const auto problem = translate(request.statement);
  try {
    if (form == Form::strong)
      return std::make_unique<ParticleField>(
          elasticity::strong_form::solve(problem, particles, basis,
                                         read_corner_rules(parameters.text("corner"), request.statement.corners)),
          basis, points_seconds);
    elasticity::weak_form::Parameters weak;
    weak.derivatives =
        form == Form::weak1 ? elasticity::DerivativeRule::direct : elasticity::DerivativeRule::differentiated;
    weak.test_radius = parameters.real("test_radius");
    weak.test_function = test_function_of(parameters);
    weak.quadrature_points = static_cast<int>(parameters.integer("quadrature_points"));
    weak.penalty = parameters.real("penalty");
    weak.characteristic_length = request.statement.characteristic_length;
    return std::make_unique<ParticleField>(elasticity::weak_form::solve(problem, particles, basis, weak), basis,
                                           points_seconds);
  } catch (const meshless::basis::SingularMomentMatrix &error) {
    throw Refused(error.what());
  }
}

Method make(std::string name, std::string meaning, std::vector<Declaration> parameters, Form form) {
  Method method;
  method.description.name = std::move(name);
  method.description.meaning = std::move(meaning);
  method.description.parameters = std::move(parameters);
  method.description.effects = {"elasticity", "body_force"};
  method.description.check = [form](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    check_support(context, diagnostics);
    check_plane_strain(context, diagnostics);
    if (form == Form::strong)
      check_corner(context, diagnostics);
  };
  method.solve = [form](const SolveRequest &request) { return solve(request, form); };
  return method;
}

} // namespace

Method strong() {
  return make("strong", "collocation of the strong form (Batra & Zhang 2008, 3.1)", strong_declarations(),
              Form::strong);
}

Method weak1() {
  return make("weak1", "MLPG, derivatives found directly (3.2.1)", weak_declarations(Form::weak1), Form::weak1);
}

Method weak2() {
  return make("weak2", "MLPG, differentiated shape functions (3.2.2)", weak_declarations(Form::weak2), Form::weak2);
}

} // namespace comparisons::methods
