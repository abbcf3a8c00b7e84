#include "comparisons/benchmarks/rod/methods.h"

#include "comparisons/benchmarks/rod/basis_choice.h"

#include <fmt/format.h>

#include <stdexcept>

namespace comparisons::benchmarks::rod {

using scene::Type;

namespace {

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const auto &kernel : meshless::kernels::kernel_table())
    names.emplace_back(kernel.name);
  return names;
}

std::vector<scene::Declaration> collocation_keys() {
  const scene::Range positive{.lower = 0, .lower_open = true};
  return {
      {.name = "basis",
       .type = Type::choice,
       .choices = basis_names(),
       .required = true,
       .meaning = "how derivatives are made"},
      {.name = "order",
       .type = Type::integer,
       .range = {.lower = 1, .upper = 4},
       .meaning = "degree of the monomials, for a basis that leaves it free; if absent, its own or 2"},
      {.name = "kernel",
       .type = Type::choice,
       .choices = kernel_names(),
       .default_value = "gauss",
       .meaning = "kernel W of the basis"},
      {.name = "kernel_parameter", .range = positive, .meaning = "the kernel's own parameter, such as the decay a"},
      {.name = "smoothing_length",
       .range = {.lower = 0.1, .upper = 20},
       .default_value = 1.0,
       .meaning = "h over the mean spacing"},
      {.name = "support",
       .range = {.lower = 1, .upper = 20, .lower_open = true},
       .meaning =
           "cut-off of the kernel in units of h; if absent, 6 (no effect on the Gauss function) or the kernel's own"},
      {.name = "volumes",
       .type = Type::choice,
       .choices = {"equal", "voronoi"},
       .default_value = "equal",
       .meaning = "volume of a particle: the mean spacing everywhere, or its part of the rod (half at the ends)"},
  };
}

void check_basis(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &method = context.method;
  try {
    make_basis(method);
  } catch (const std::invalid_argument &error) {
    const char *key = "kernel";
    for (const char *candidate : {"order", "kernel_parameter", "support"})
      if (method.is_given(candidate))
        key = candidate;
    diagnostics.error(method.location(key), context.method_key + "." + key, error.what());
  }
}

} // namespace

scene::MethodDescription collocation(std::vector<std::string> effects) {
  scene::MethodDescription method;
  method.name = "collocation";
  method.meaning = "derivatives at particles from the values of their neighbours";
  method.parameters = collocation_keys();
  method.effects = std::move(effects);
  method.check = check_basis;
  return method;
}

scene::MethodDescription finite_elements(const ElementKeys &keys, std::vector<std::string> effects) {
  constexpr int highest_degree = 3;
  scene::MethodDescription method;
  method.name = "fem";
  method.meaning = "finite elements by deal.II with the particles as vertices";
  std::vector<std::string> elements;
  for (int degree = keys.lowest_degree; degree <= highest_degree; ++degree)
    elements.push_back(fmt::format("Q{}", degree));
  method.parameters = {{.name = "element",
                        .type = Type::choice,
                        .choices = elements,
                        .default_value = elements.front(),
                        .meaning = "degree of the elements"}};
  if (keys.mass)
    method.parameters.push_back({.name = "mass",
                                 .type = Type::choice,
                                 .choices = {"lumped", "consistent"},
                                 .default_value = "lumped",
                                 .meaning = "mass matrix: by the Gauss-Lobatto rule of the nodes, or exact"});
  method.effects = std::move(effects);
  return method;
}

int degree_of(const scene::Parameters &method) { return method.text("element").back() - '0'; }

/// A band of a few dozen entries a row; the constants were measured on one core of a 2 GHz server.
study::Estimate estimate(const scene::MethodRequest &request, int n, std::size_t n_arrangements) {
  study::Estimate e;
  e.n_points = n;
  const bool fem = request.name == "fem";
  e.n_dofs = fem ? 1 + (n - 1.) * degree_of(request.parameters) : n;
  const double width = fem ? 5 : 1 + 4 * support_of(request.parameters) * request.parameters.real("smoothing_length");
  e.bytes = 100 * width * e.n_dofs;
  e.seconds = static_cast<double>(n_arrangements) * width * e.n_dofs * 3e-7;
  return e;
}

} // namespace comparisons::benchmarks::rod
