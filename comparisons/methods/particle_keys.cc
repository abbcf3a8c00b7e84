#include "comparisons/methods/particle_keys.h"

#include "comparisons/methods/corner_parameter.h"
#include "comparisons/methods/locking.h"
#include "comparisons/methods/solver_keys.h"

#include "meshless/basis/basis_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace comparisons::methods {

namespace {

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

/// Bases that a form can use: in two dimensions, at least of order 1, with the derivatives that it asks for.
std::vector<std::string> basis_names(Form form) {
  std::vector<std::string> names;
  for (const auto &basis : meshless::basis::basis_table()) {
    const bool able = collocates(form) ? basis.hessian_anywhere : form == Form::weak1 || basis.differentiable;
    if (able && basis.highest_dimension >= 2 && basis.highest_order >= least_order(form))
      names.emplace_back(basis.name);
  }
  return names;
}

/// Of the particles' supports and with them the subdomains.
Declaration supports_key(Form form) {
  const std::string meaning =
      "elliptic: h along and across as the cells of the particles are long and wide, in place of "
      "smoothing_rule, and subdomains likewise, with ssph";
  if (form == Form::mixed)
    return {.name = "supports",
            .type = Type::choice,
            .choices = {"auto", "round", "elliptic"},
            .default_value = "auto",
            .meaning = meaning +
                       "; auto: elliptic on irregular clouds where one in ten cells is longer than 1.35 times "
                       "its width"};
  return {.name = "supports",
          .type = Type::choice,
          .choices = {"round", "elliptic"},
          .default_value = "round",
          .meaning = meaning};
}

bool has_supports_key(Form form) { return form == Form::mixed || form == Form::weak1; }

/// Keys that every particle method has.
std::vector<Declaration> basis_declarations(Form form) {
  const auto positive = scene::Range{.lower = 0, .lower_open = true};
  return {
      {.name = "basis",
       .type = Type::choice,
       .choices = basis_names(form),
       .default_value = "ssph",
       .meaning = "how shape functions are made; those that weigh with volumes take the square of the spacing"},
      {.name = "order",
       .type = Type::integer,
       .range = {.lower = static_cast<double>(least_order(form)), .upper = 4},
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
      {.name = "lower_order",
       .type = Type::choice,
       .choices = {"off", "on"},
       .default_value = "off",
       .meaning = "on: where the particles do not carry the order even so, the cell is solved with the highest lower "
                  "one that they carry, with a warning; off: refused"},
  };
}

Declaration test_function_key(std::vector<std::string> names, const char *meaning) {
  return {.name = "test_function",
          .type = Type::choice,
          .choices = std::move(names),
          .default_value = "gauss",
          .meaning = meaning};
}

Declaration test_radius_key(const char *meaning) {
  return {.name = "test_radius", .range = {.lower = 0.05, .upper = 10}, .meaning = meaning};
}

Declaration subdomains_key() {
  return {.name = "subdomains",
          .type = Type::choice,
          .choices = {"auto", "whole", "shrunk"},
          .default_value = "auto",
          .meaning = "whole: cut by the boundary; shrunk: those inside reach no farther than it; auto: whole on "
                     "regular clouds and ellipses, shrunk on others"};
}

std::vector<Declaration> weak_declarations() {
  return {test_function_key(test_function_names(),
                            "test function of the local weak form; heaviside: W = 1, integrals over edges alone"),
          test_radius_key("radius of the local subdomain in units of h; if absent, h on regular clouds and ellipses, "
                          ".75 spacings on others, .9 from order 3 on, .6 for heaviside"),
          subdomains_key(),
          {.name = "quadrature",
           .type = Type::choice,
           .choices = {"paper", "consistent"},
           .default_value = "paper",
           .meaning = "paper: nG x 4 nG Gauss points; consistent: 3 x 8 points for order 1 and 2, 3 x 12 for 3, "
                      "4 x 16 for 4, twice as many along a ray where the boundary cuts, and a gradient of the test "
                      "function made consistent with them"},
          {.name = "quadrature_points",
           .type = Type::integer,
           .range = {.lower = 1, .upper = 64},
           .default_value = std::int64_t{10},
           .meaning = "nG: radial points; 4 nG in the angle, nG on a boundary part, nG + 2 on the circle of "
                      "heaviside; without effect with quadrature = consistent"},
          {.name = "repeated_rows",
           .type = Type::choice,
           .choices = {"copied", "computed"},
           .default_value = "copied",
           .meaning = "copied: rows of particles that lie like another one, as on a grid most do, are taken from it, "
                      "equal to rounding; computed: all by their own quadrature, to time what particles anywhere take"},
          {.name = "penalty",
           .range = {.lower = 0, .lower_open = true},
           .meaning =
               "penalty alpha on prescribed displacement, in units of E0 over the domain's length; if absent 1e5 "
               "on regular clouds, on others 20 E0 / h"}};
}

/// The mixed method's integration is always consistent and its essential conditions are collocated.
std::vector<Declaration> mixed_declarations() {
  return {{.name = "pressure_support",
           .range = {.lower = 1, .upper = 20, .lower_open = true},
           .meaning = "rho of the basis of the pressure, of order - 1; if absent one less than the support"},
          {.name = "stabilisation",
           .range = {.lower = 0, .upper = 10},
           .default_value = 0.2,
           .meaning = "alpha of tau = alpha h^2 / (2 mu) (PSPG); .05 to 1 is usable, 0 lets the pressure oscillate"},
          supports_key(Form::mixed),
          test_function_key(smooth_test_functions(), "test function of the local weak form"),
          test_radius_key("radius of the local subdomain in units of h; if absent 1 spacing"),
          subdomains_key()};
}

std::vector<Declaration> strong_declarations() {
  return {{.name = "corner",
           .type = Type::text,
           .default_value = "",
           .meaning = "conditions at corners, as \"NE: s11 s22, SW: u1 t2\"; the default is essential conditions "
                      "first, else s11 and s12"}};
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

/// The basis of the pressure must exist: its order is one less, and so are its lines of particles.
void check_pressure_support(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
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

/// Ellipses need the one basis that has them, whole subdomains and a test function that vanishes on their edge.
void check_supports(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &method = context.method;
  if (method.text("supports") != "elliptic")
    return;
  const auto refuse = [&](const std::string &what, const char *remedy) {
    diagnostics.error(method.location("supports"), context.method_key + ".supports", "elliptic supports with " + what,
                      remedy);
  };
  if (method.text("basis") != "ssph")
    refuse(fmt::format("the basis {}, whose supports are round", method.text("basis")), "basis = \"ssph\"");
  if (method.text("subdomains") == "shrunk")
    refuse("shrunk subdomains: ellipses are not shrunk", "subdomains = \"whole\"");
  if (method.text("test_function") == heaviside)
    refuse("the test function heaviside, which is integrated over the edge of discs", "test_function = \"gauss\"");
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

} // namespace

std::vector<Declaration> particle_keys(Form form) {
  auto keys = basis_declarations(form);
  auto own = form == Form::strong  ? strong_declarations()
             : form == Form::mixed ? mixed_declarations()
                                   : weak_declarations();
  keys.insert(keys.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  if (form == Form::weak1)
    keys.push_back(supports_key(form));
  auto solver = form == Form::mixed ? mixed_solver_keys() : solver_keys();
  keys.insert(keys.end(), std::make_move_iterator(solver.begin()), std::make_move_iterator(solver.end()));
  return keys;
}

void check_particle_keys(Form form, const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  check_order(context, diagnostics);
  check_support(context, diagnostics);
  if (form != Form::mixed)
    check_locking(context, diagnostics);
  else
    check_pressure_support(context, diagnostics);
  if (has_supports_key(form))
    check_supports(context, diagnostics);
  if (form == Form::strong)
    check_corner(context, diagnostics);
  check_solver_keys(context, diagnostics);
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
/// hole. Orders 3 and 4 lose accuracy below .8. Heaviside: .5 to .65 for all orders. Ellipses, which are whole, have
/// the radius of regular clouds: on Cook's membrane (mapped, jittered by 25 %) the worst of twenty is wrong by .6 %
/// with it, by 1.8 % with .75.
double test_radius_of(const Parameters &parameters, Form form, bool regular, double smoothing_length) {
  if (parameters.has("test_radius"))
    return parameters.real("test_radius");
  if (form == Form::mixed)
    return 1 / smoothing_length;
  if (parameters.text("test_function") == heaviside)
    return 0.6 / smoothing_length;
  constexpr double spacings[] = {0.75, 0.75, 0.9, 0.9}; // by order
  return regular ? 1 : spacings[parameters.integer("order") - 1] / smoothing_length;
}

/// Of the order one less: a kernel with a free cut-off reaches h less, another has its own support.
meshless::kernels::Kernel pressure_kernel_of(const Parameters &parameters, bool regular) {
  const auto kernel = kernel_of(parameters, regular);
  for (const auto &entry : meshless::kernels::kernel_table())
    if (entry.name == parameters.text("kernel") && entry.free_support)
      return meshless::kernels::make_kernel(
          entry.name,
          parameters.has("pressure_support") ? parameters.real("pressure_support")
                                             : meshless::kernels::support_of(kernel) - 1,
          parameters.has("kernel_parameter") ? std::optional(parameters.real("kernel_parameter")) : std::nullopt);
  return kernel;
}

bool shrinks_subdomains(const Parameters &parameters, bool regular, bool elliptic) {
  const std::string &subdomains = parameters.text("subdomains");
  return subdomains == "shrunk" || (subdomains == "auto" && !regular && !elliptic);
}

Supports supports_of(const Parameters &parameters, Form form, bool regular) {
  if (!has_supports_key(form) || parameters.text("supports") == "round")
    return Supports::round;
  if (parameters.text("supports") == "elliptic")
    return Supports::elliptic;
  const bool possible = parameters.text("basis") == "ssph" && parameters.text("smoothing_rule") == "given" &&
                        parameters.text("subdomains") != "shrunk";
  return !regular && possible ? Supports::by_cells : Supports::round;
}

} // namespace comparisons::methods
