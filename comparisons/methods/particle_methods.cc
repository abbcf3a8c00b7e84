#include "comparisons/methods/particle_methods.h"

#include "comparisons/methods/corner_parameter.h"
#include "comparisons/methods/locking.h"

#include "meshless/basis/basis_table.h"
#include "meshless/elasticity/cloud_quality.h"
#include "meshless/elasticity/mixed_form/displacement_pressure.h"
#include "meshless/elasticity/strong_form/collocation.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"
#include "meshless/kernels/kernel_table.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// The test function W = 1.
constexpr const char *heaviside = "heaviside";

/// A test function must vanish where the local subdomain ends and be smooth inside: the quadrature of
/// subdomains does not stop where a spline's pieces meet.
std::vector<std::string> smooth_test_functions() {
  std::vector<std::string> names;
  for (const auto &kernel : meshless::kernels::kernel_table())
    if (kernel.edge_smoothness >= 0 &&
        meshless::kernels::breaks_of(meshless::kernels::make_kernel(kernel.name, {})).empty())
      names.emplace_back(kernel.name);
  return names;
}

std::vector<std::string> test_function_names() {
  auto names = smooth_test_functions();
  names.emplace_back(heaviside);
  return names;
}

enum class Form { strong, weak1, weak2, hybrid, mixed };

bool has_subdomains(Form form) { return form != Form::strong; }
/// Needs second derivatives of the shape functions at any point.
bool collocates(Form form) { return form == Form::strong || form == Form::hybrid || form == Form::mixed; }

/// Bases that a form can use: in two dimensions, at least of order 1, with the derivatives that it asks for.
std::vector<std::string> basis_names(Form form) {
  std::vector<std::string> names;
  for (const auto &basis : meshless::basis::basis_table()) {
    const bool able = collocates(form) ? basis.hessian_anywhere : form == Form::weak1 || basis.differentiable;
    if (able && basis.highest_dimension >= 2 && basis.highest_order >= (collocates(form) ? 2 : 1))
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
       .meaning = "how shape functions are made; those that weigh with volumes take the square of the spacing"},
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
       .meaning =
           "rho, support of the kernel in units of h; if absent, order + 2 (4.5 at most on irregular clouds) or the "
           "kernel's own"},
      {.name = "smoothing_length",
       .range = positive,
       .meaning = "h over the distance that smoothing_rule names; if absent 1, on irregular clouds 1.2 for order 3 and "
                  "1.3 for order 4"},
      {.name = "smoothing_rule",
       .type = Type::choice,
       .choices = {"given", "nearest", "mean4"},
       .default_value = "given",
       .meaning = "distance that h is measured in: the level's own spacing, the nearest particle, the mean of the 4 "
                  "nearest"},
      {.name = "enlarge",
       .type = Type::choice,
       .choices = {"auto", "on", "off"},
       .default_value = "auto",
       .meaning = "enlarge h, to twice at most, where the basis would be singular or poor; auto: on irregular clouds"},
  };
}

std::vector<Declaration> weak_declarations(Form form) {
  auto keys = basis_declarations(form, collocates(form) ? 2 : 1);
  keys.insert(keys.end(),
              {{.name = "test_function",
                .type = Type::choice,
                .choices = test_function_names(),
                .default_value = "gauss",
                .meaning = "test function of the local weak form; heaviside: W = 1, integrals over edges alone"},
               {.name = "test_radius",
                .range = {.lower = 0.05, .upper = 10},
                .meaning = "radius of the local subdomain in units of h; if absent, h on regular clouds, .75 spacings "
                           "on others, .85 for order 3, .9 for 4, .6 for heaviside"},
               {.name = "subdomains",
                .type = Type::choice,
                .choices = {"auto", "whole", "shrunk"},
                .default_value = "auto",
                .meaning = "whole: cut by the boundary; shrunk: those inside reach no farther than it; auto: whole on "
                           "regular clouds, shrunk on others"},
               {.name = "quadrature",
                .type = Type::choice,
                .choices = {"paper", "consistent"},
                .default_value = "paper",
                .meaning = "paper: nG x 4 nG Gauss points; consistent: 3 x 8 points for order 1 and 2, 3 x 12 for 3, "
                           "4 x 16 for 4, and a gradient of the test function made consistent with them"},
               {.name = "quadrature_points",
                .type = Type::integer,
                .range = {.lower = 1, .upper = 64},
                .default_value = std::int64_t{10},
                .meaning = "nG: radial points; 4 nG in the angle, nG on a boundary part, nG + 2 on the circle of "
                           "heaviside; without effect with quadrature = consistent"},
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

/// Keys of the mixed method: its integration is always consistent and its essential conditions are collocated.
std::vector<Declaration> mixed_declarations() {
  auto keys = basis_declarations(Form::mixed, 2);
  keys.insert(
      keys.end(),
      {{.name = "pressure_support",
        .range = {.lower = 1, .upper = 20, .lower_open = true},
        .meaning = "rho of the basis of the pressure, of order - 1; if absent one less than the support"},
       {.name = "stabilisation",
        .range = {.lower = 0, .upper = 10},
        .default_value = 0.2,
        .meaning = "alpha of tau = alpha h^2 / (2 mu) (PSPG); .05 to 1 is usable, 0 lets the pressure oscillate"},
       {.name = "test_function",
        .type = Type::choice,
        .choices = smooth_test_functions(),
        .default_value = "gauss",
        .meaning = "test function of the local weak form"},
       {.name = "test_radius",
        .range = {.lower = 0.05, .upper = 10},
        .meaning = "radius of the local subdomain in units of h; if absent 1 spacing"},
       {.name = "subdomains",
        .type = Type::choice,
        .choices = {"auto", "whole", "shrunk"},
        .default_value = "auto",
        .meaning = "whole: cut by the boundary; shrunk: those inside reach no farther than it; auto: whole on "
                   "regular clouds, shrunk on others"},
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

/// Orders 3 and 4 need a wider weight where particles are irregular: on graded clouds of 686 with a hole, 1.3 instead
/// of 1 raises the smallest pivot ratio of order 4 from 1e-5 to 4e-4 and halves its errors.
double smoothing_length_of(const Parameters &parameters, bool regular) {
  if (parameters.has("smoothing_length"))
    return parameters.real("smoothing_length");
  const auto order = parameters.integer("order");
  return regular || order < 3 ? 1 : order == 3 ? 1.2 : 1.3;
}

/// The kernel of a method. The support is rho where the scene gives it, order + 2 for a kernel with a free
/// cut-off (4.5 at most on irregular clouds, whose smoothing lengths are larger), else the kernel's own.
meshless::kernels::Kernel kernel_of(const Parameters &parameters, bool regular) {
  const std::string &name = parameters.text("kernel");
  std::optional<double> support;
  if (parameters.has("support"))
    support = parameters.real("support");
  for (const auto &kernel : meshless::kernels::kernel_table())
    if (!support && kernel.name == name && kernel.free_support)
      support = regular ? static_cast<double>(parameters.integer("order")) + 2
                        : std::min(static_cast<double>(parameters.integer("order")) + 2, 4.5);
  std::optional<double> parameter;
  if (parameters.has("kernel_parameter"))
    parameter = parameters.real("kernel_parameter");
  return meshless::kernels::make_kernel(name, support, parameter);
}

/// The Gauss function of (3.15) has its cut-off at the radius of the subdomain; kernels with a support of
/// their own are stretched to it.
std::optional<meshless::kernels::Kernel> test_function_of(const Parameters &parameters, double test_radius) {
  const std::string &name = parameters.text("test_function");
  if (name == heaviside)
    return {};
  std::optional<double> support;
  for (const auto &kernel : meshless::kernels::kernel_table())
    if (kernel.name == name && kernel.free_support)
      support = test_radius;
  return meshless::kernels::make_kernel(name, support);
}

/// Irregular clouds, with shrunk subdomains, in spacings: on twenty graded clouds of 188 with a hole .5 to .85 are
/// stable for order 2, 1 is not; smaller ones have smaller errors of displacement, larger ones of the stress on the
/// hole. Orders 3 and 4 lose accuracy below .8. Heaviside: .5 to .65 for all orders.
/// @param smoothing_length h over the spacing
double test_radius_of(const Parameters &parameters, Form form, bool regular, double smoothing_length) {
  if (parameters.has("test_radius"))
    return parameters.real("test_radius");
  if (form == Form::mixed)
    return 1 / smoothing_length;
  if (parameters.text("test_function") == heaviside)
    return 0.6 / smoothing_length;
  constexpr double spacings[] = {0.75, 0.75, 0.85, 0.9}; // by order
  return regular ? 1 : spacings[parameters.integer("order") - 1] / smoothing_length;
}

void check_order(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &basis = meshless::basis::describe_basis(context.method.text("basis"));
  const auto order = context.method.integer("order");
  if (order < basis.lowest_order || order > basis.highest_order)
    diagnostics.error(context.method.location("order"), context.method_key + ".order",
                      fmt::format("basis {} of order {}; its orders are {} to {}", basis.name, order,
                                  basis.lowest_order, basis.highest_order));
}

/// Errors that can be told before any computing.
void check_support(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &method = context.method;
  double support = 0;
  try {
    support = meshless::kernels::support_of(kernel_of(method, true));
  } catch (const std::invalid_argument &error) {
    const char *key = method.is_given("support") ? "support" : "kernel_parameter";
    diagnostics.error(method.location(key), context.method_key + "." + key, error.what());
    return;
  }
  const double reach = support * smoothing_length_of(method, true);
  const auto order = method.integer("order");
  if (method.text("smoothing_rule") == "given" && reach < static_cast<double>(order))
    diagnostics.error(method.location(method.is_given("support") ? "support" : "smoothing_length"),
                      context.method_key + ".support",
                      fmt::format("the support reaches {} spacings, too small for order {}: a corner of the domain "
                                  "needs {} lines of particles, so more than {}",
                                  reach, order, order + 1, order),
                      fmt::format("support = {}", order + 2));
  else if (method.text("smoothing_rule") == "given" && reach < static_cast<double>(order) + 0.5)
    diagnostics.warning(
        method.location(method.is_given("support") ? "support" : "smoothing_length"), context.method_key + ".support",
        fmt::format("the support reaches {} spacings, the limit for order {}: at a boundary the {} lines "
                    "of particles that it needs are barely inside, and on irregular particles not",
                    reach, order, order + 1),
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

/// The basis of the pressure must exist: its order is one less, and so are its lines of particles.
void check_mixed(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &method = context.method;
  if (!method.has("pressure_support"))
    return;
  const double reach = method.real("pressure_support") * smoothing_length_of(method, true);
  const auto order = method.integer("order") - 1;
  if (reach < static_cast<double>(order))
    diagnostics.error(
        method.location("pressure_support"), context.method_key + ".pressure_support",
        fmt::format("the support of the pressure reaches {} spacings, too small for its order {}", reach, order),
        fmt::format("pressure_support = {}", order + 2));
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
  elasticity::PlaneProblem problem{{}, {}, statement.body_force, statement.thermal_strain};
  static_assert(elasticity::interface_id == problems::interface_id);
  for (const auto &region : statement.regions) {
    std::vector<meshless::domain::BoundaryPiece> pieces;
    for (const auto &piece : region.boundary) {
      pieces.push_back({piece.begin, piece.end, piece.id});
      if (piece.arc)
        pieces.back().arc = {piece.arc->centre, piece.arc->counter_clockwise};
    }
    problem.regions.push_back(
        {meshless::domain::Boundary(std::move(pieces)),
         elasticity::Material(region.material.youngs_modulus, region.material.poisson_ratio,
                              region.material.plane_strain ? elasticity::PlaneModel::plane_strain
                                                           : elasticity::PlaneModel::plane_stress)});
  }
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

/// Smoothing lengths by the mean of the k nearest of the same region: those on an interface have a twin at distance
/// 0.
std::vector<double> lengths_by_mean(const problems::Cloud &cloud, int k, double factor) {
  if (cloud.regions.empty())
    return meshless::cloud::smoothing_lengths_by_mean<2>(cloud.positions, k, factor);
  std::vector<double> h(cloud.positions.size());
  const int n_regions = 1 + *std::max_element(cloud.regions.begin(), cloud.regions.end());
  for (int r = 0; r < n_regions; ++r) {
    std::vector<problems::Point2> own;
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < h.size(); ++i)
      if (cloud.regions[i] == r) {
        own.push_back(cloud.positions[i]);
        indices.push_back(i);
      }
    if (own.empty())
      continue;
    const auto lengths = meshless::cloud::smoothing_lengths_by_mean<2>(own, k, factor);
    for (std::size_t i = 0; i < own.size(); ++i)
      h[indices[i]] = lengths[i];
  }
  return h;
}

std::shared_ptr<const meshless::cloud::Particles<2>> make_particles(problems::Cloud cloud,
                                                                    const Parameters &parameters) {
  const double factor = smoothing_length_of(parameters, cloud.regular);
  const std::string &rule = parameters.text("smoothing_rule");
  std::vector<double> volumes;
  if (meshless::basis::describe_basis(parameters.text("basis")).volumes == meshless::basis::VolumeUse::always)
    for (const double spacing : cloud.spacing)
      volumes.push_back(spacing * spacing);
  std::vector<double> h;
  if (rule == "given") {
    h = std::move(cloud.spacing);
    for (double &length : h)
      length *= factor;
  } else
    h = lengths_by_mean(cloud, rule == "nearest" ? 1 : 4, factor);
  return std::make_shared<const meshless::cloud::Particles<2>>(std::move(cloud.positions), std::move(h),
                                                               std::move(volumes), std::move(cloud.regions));
}

class ParticleField final : public Solution {
public:
  ParticleField(elasticity::ParticleSolution solution, std::shared_ptr<const meshless::basis::ShapeFunctions<2>> basis,
                double points_seconds, std::size_t n_enlarged, double largest_factor, std::vector<std::string> warnings)
      : solution_(std::move(solution)), basis_(std::move(basis)) {
    const auto &s = solution_.seconds;
    record_.warnings = std::move(warnings);
    record_.n_points = static_cast<std::int64_t>(solution_.particles().size());
    record_.n_dofs = (solution_.has_pressure() ? 3 : 2) * record_.n_points;
    record_.nonzeros = solution_.nonzeros;
    record_.seconds = {{"points", points_seconds},
                       {"neighbours", s.neighbours},
                       {"basis", s.basis},
                       {"assembly", s.assembly},
                       {"solve", s.solve}};
    record_.quantities = {{"backward_error", solution_.backward_error},
                          {"reciprocal_condition", solution_.reciprocal_condition}};
    if (n_enlarged > 0) {
      record_.quantities["n_enlarged"] = static_cast<double>(n_enlarged);
      record_.quantities["largest_enlargement"] = largest_factor;
      record_.warnings.push_back(
          fmt::format("smoothing lengths of {} particles enlarged, at most by {:.2f}", n_enlarged, largest_factor));
    }
    if (solution_.backward_error > 1e-10)
      record_.warnings.push_back(
          fmt::format("the linear system was solved with a backward error of {:.1e} only", solution_.backward_error));
  }

  std::vector<std::string> fields() const override {
    if (solution_.has_pressure())
      return {"displacement", "stress", "pressure"};
    return {"displacement", "stress"};
  }
  std::size_t n_components(std::string_view field) const override {
    return field == "pressure" ? 1 : field == "displacement" ? 2 : 3;
  }

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
    } else if (field == "pressure" && solution_.has_pressure())
      solution_.pressure(points, values);
    else
      throw std::invalid_argument(fmt::format("no field '{}'; there are {}", field, fmt::join(fields(), ", ")));
  }

  std::vector<std::array<double, 2>> own_points() const override {
    const auto positions = solution_.particles().positions();
    return {positions.begin(), positions.end()};
  }

  /// Smoothing length, and neighbours and regularity of the moment matrix (smallest pivot over its diagonal entry, 1
  /// at best) at every particle.
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

using ParticlesPointer = std::shared_ptr<const meshless::cloud::Particles<2>>;
using BasisPointer = std::shared_ptr<const meshless::basis::ShapeFunctions<2>>;

elasticity::weak_form::Parameters weak_parameters(const SolveRequest &request, Form form, bool regular,
                                                  double test_radius) {
  const auto &parameters = request.parameters;
  const std::string &subdomains = parameters.text("subdomains");
  elasticity::weak_form::Parameters weak;
  weak.derivatives =
      form == Form::weak2 ? elasticity::DerivativeRule::differentiated : elasticity::DerivativeRule::direct;
  weak.test_radius = test_radius;
  weak.test_function = test_function_of(parameters, test_radius);
  weak.subdomains = subdomains == "shrunk" || (subdomains == "auto" && !regular)
                        ? elasticity::weak_form::Subdomains::shrunk
                        : elasticity::weak_form::Subdomains::whole;
  weak.interior_rows = form == Form::hybrid ? elasticity::weak_form::InteriorRows::collocated
                                            : elasticity::weak_form::InteriorRows::weak;
  // The mixed method, whose rows are sampled as those of weak1, has none of these keys: it is always consistent.
  const bool consistent = !parameters.has("quadrature") || parameters.text("quadrature") == "consistent";
  weak.integration =
      consistent ? elasticity::weak_form::IntegrationRule::consistent : elasticity::weak_form::IntegrationRule::paper;
  if (parameters.has("quadrature_points"))
    weak.quadrature_points = static_cast<int>(parameters.integer("quadrature_points"));
  if (parameters.has("penalty"))
    weak.penalty = parameters.real("penalty");
  weak.characteristic_length = request.statement.characteristic_length;
  return weak;
}

elasticity::ParticleSolution solve_mixed(const SolveRequest &request, const elasticity::PlaneProblem &problem,
                                         const ParticlesPointer &particles, const BasisPointer &basis, bool regular,
                                         double test_radius) {
  const auto &parameters = request.parameters;
  const std::string &subdomains = parameters.text("subdomains");
  elasticity::mixed_form::Parameters mixed;
  mixed.test_radius = test_radius;
  mixed.test_function = *test_function_of(parameters, test_radius);
  mixed.subdomains = subdomains == "shrunk" || (subdomains == "auto" && !regular)
                         ? elasticity::weak_form::Subdomains::shrunk
                         : elasticity::weak_form::Subdomains::whole;
  mixed.stabilisation = parameters.real("stabilisation");
  const auto kernel = kernel_of(parameters, regular);
  const auto pressure_kernel = [&] {
    for (const auto &entry : meshless::kernels::kernel_table())
      if (entry.name == parameters.text("kernel") && entry.free_support)
        return meshless::kernels::make_kernel(
            entry.name,
            parameters.has("pressure_support") ? parameters.real("pressure_support")
                                               : meshless::kernels::support_of(kernel) - 1,
            parameters.has("kernel_parameter") ? std::optional(parameters.real("kernel_parameter")) : std::nullopt);
    return kernel; // its support is its own
  }();
  const auto order = static_cast<int>(parameters.integer("order"));
  return elasticity::mixed_form::solve(
      problem, particles, basis, meshless::basis::make_basis<2>(parameters.text("basis"), order - 1, pressure_kernel),
      mixed);
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

/// The particles of a cell with all that a form needs to know of them.
struct Prepared {
  elasticity::PlaneProblem problem;
  bool regular = true;
  ParticlesPointer particles;
  BasisPointer basis;
  double test_radius = 0;
  std::size_t n_enlarged = 0;
  double largest_factor = 1;
  double points_seconds = 0;
  double enlarge_seconds = 0;
};

Prepared prepare(const SolveRequest &request, Form form) {
  const auto &parameters = request.parameters;
  Prepared p;
  p.problem = translate(request.statement); // first: it refuses what particles cannot do
  meshless::linear_algebra::Stopwatch watch;
  auto cloud = request.cloud();
  p.regular = cloud.regular;
  p.particles = make_particles(std::move(cloud), parameters);
  p.points_seconds = watch.lap();
  p.basis = meshless::basis::make_basis<2>(parameters.text("basis"), static_cast<int>(parameters.integer("order")),
                                           kernel_of(parameters, p.regular));
  if (has_subdomains(form))
    p.test_radius = test_radius_of(parameters, form, p.regular, smoothing_length_of(parameters, p.regular));
  const std::string &enlarge = parameters.text("enlarge");
  if (enlarge == "on" || (enlarge == "auto" && !p.regular)) {
    p.problem.require_inside(*p.particles);
    auto enlarged = elasticity::enlarge_where_poor(elasticity::Surroundings(p.problem.regions), *p.particles, *p.basis,
                                                   p.test_radius);
    p.n_enlarged = enlarged.n_enlarged;
    p.largest_factor = enlarged.largest_factor;
    if (p.n_enlarged > 0)
      p.particles = std::make_shared<const meshless::cloud::Particles<2>>(std::move(enlarged.particles));
  }
  p.enlarge_seconds = watch.lap();
  return p;
}

std::unique_ptr<Solution> solve(const SolveRequest &request, Form form) {
  try {
    const auto p = prepare(request, form);
    auto solution =
        form == Form::strong ? elasticity::strong_form::solve(
                                   p.problem, p.particles, p.basis,
                                   read_corner_rules(request.parameters.text("corner"), request.statement.corners))
        : form == Form::mixed ? solve_mixed(request, p.problem, p.particles, p.basis, p.regular, p.test_radius)
                              : elasticity::weak_form::solve(p.problem, p.particles, p.basis,
                                                             weak_parameters(request, form, p.regular, p.test_radius));
    solution.seconds.neighbours += p.enlarge_seconds;
    return std::make_unique<ParticleField>(std::move(solution), p.basis, p.points_seconds, p.n_enlarged,
                                           p.largest_factor, forewarnings(request, form, p.regular));
  } catch (const meshless::basis::SingularMomentMatrix &error) {
    throw Refused(error.what());
  }
}

/// Collocation has no rows that are dear: two rows of a particle take what looking at its surroundings takes, and less.
/// The mixed form's three rows take about twice the weak form's two, and have 9/4 of their entries.
CloudReport inspect(const SolveRequest &request, Form form, bool sample) {
  const auto p = prepare(request, form);
  const elasticity::Surroundings surroundings(p.problem.regions);
  meshless::linear_algebra::Stopwatch watch;
  const auto quality = elasticity::cloud_quality(surroundings, *p.particles, *p.basis, p.test_radius);
  const double quality_seconds = watch.lap();
  CloudReport report{quality.fewest_neighbours,
                     quality.median_neighbours,
                     quality.most_neighbours,
                     quality.smallest_distance,
                     quality.smallest_pivot_ratio,
                     quality.worst_point,
                     p.n_enlarged,
                     p.largest_factor};
  if (!sample)
    return report;
  const auto n = static_cast<double>(p.particles->size());
  report.seconds = p.points_seconds + p.enlarge_seconds;
  if (form == Form::strong) {
    report.nonzeros = 4 * n * static_cast<double>(quality.median_neighbours);
    report.seconds += 1.5 * quality_seconds;
    return report;
  }
  constexpr std::size_t n_sampled = 40;
  const auto rows = elasticity::weak_form::sample_rows(
      p.problem, *p.particles, *p.basis,
      weak_parameters(request, form == Form::mixed ? Form::weak1 : form, p.regular, p.test_radius), n_sampled);
  report.nonzeros = (form == Form::mixed ? 2.25 : 1) * rows.nonzeros;
  report.seconds += (form == Form::mixed ? 2 : 1) * rows.seconds;
  return report;
}

Form form_of(const std::string &method) {
  if (method == "strong")
    return Form::strong;
  return method == "weak1" ? Form::weak1 : method == "weak2" ? Form::weak2 : Form::hybrid;
}

Method make(std::string name, std::string meaning, std::vector<Declaration> parameters, Form form) {
  Method method;
  method.description.name = std::move(name);
  method.description.meaning = std::move(meaning);
  method.description.parameters = std::move(parameters);
  method.description.effects = {"elasticity", "body_force"};
  if (form != Form::mixed)
    method.description.effects.emplace_back("thermal_expansion");
  method.description.check = [form](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    check_order(context, diagnostics);
    check_support(context, diagnostics);
    if (form != Form::mixed)
      check_plane_strain(context, diagnostics);
    else
      check_mixed(context, diagnostics);
    if (form == Form::strong)
      check_corner(context, diagnostics);
  };
  method.solve = [form](const SolveRequest &request) { return solve(request, form); };
  method.inspect = [form](const SolveRequest &request, bool sample) { return inspect(request, form, sample); };
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

Method hybrid() {
  return make("hybrid", "equilibrium collocated inside, MLPG rows on the boundary", weak_declarations(Form::hybrid),
              Form::hybrid);
}

Method weak2() {
  return make("weak2", "MLPG, differentiated shape functions (3.2.2)", weak_declarations(Form::weak2), Form::weak2);
}

Method mixed() {
  return make("mixed", "MLPG for displacement and pressure, stabilised (PSPG): does not lock as nu -> 1/2",
              mixed_declarations(), Form::mixed);
}

meshless::elasticity::EquationsOfMotion equations_of_motion(const SolveRequest &request, const std::string &method) {
  const Form form = form_of(method);
  const auto p = prepare(request, form);
  std::vector<double> densities;
  for (const auto &region : request.statement.regions)
    densities.push_back(region.material.density);
  try {
    auto equations =
        form == Form::strong
            ? elasticity::strong_form::equations_of_motion(
                  p.problem, densities, p.particles, p.basis,
                  read_corner_rules(request.parameters.text("corner"), request.statement.corners))
            : elasticity::weak_form::equations_of_motion(p.problem, densities, p.particles, p.basis,
                                                         weak_parameters(request, form, p.regular, p.test_radius));
    equations.seconds.neighbours += p.points_seconds + p.enlarge_seconds;
    return equations;
  } catch (const meshless::basis::SingularMomentMatrix &error) {
    throw Refused(error.what());
  }
}

} // namespace comparisons::methods
