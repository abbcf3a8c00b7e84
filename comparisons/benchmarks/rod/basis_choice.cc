#include "comparisons/benchmarks/rod/basis_choice.h"

#include <algorithm>
#include <optional>

namespace comparisons::benchmarks::rod {

namespace {

constexpr double default_support = 6;
constexpr int default_order = 2;

} // namespace

std::vector<std::string> basis_names() {
  std::vector<std::string> names;
  for (const auto &basis : meshless::basis::basis_table())
    names.emplace_back(basis.name);
  return names;
}

meshless::kernels::Kernel make_kernel(const scene::Parameters &method) {
  const std::string &name = method.text("kernel");
  std::optional<double> support;
  if (method.has("support"))
    support = method.real("support");
  for (const auto &kernel : meshless::kernels::kernel_table())
    if (!support && kernel.name == name && kernel.free_support)
      support = default_support;
  std::optional<double> parameter;
  if (method.has("kernel_parameter"))
    parameter = method.real("kernel_parameter");
  return meshless::kernels::make_kernel(name, support, parameter);
}

double support_of(const scene::Parameters &method) { return meshless::kernels::support_of(make_kernel(method)); }

std::unique_ptr<meshless::basis::ShapeFunctions<1>> make_basis(const scene::Parameters &method) {
  const auto &basis = meshless::basis::describe_basis(method.text("basis"));
  const int order = method.has("order") ? static_cast<int>(method.integer("order"))
                                        : std::clamp(default_order, basis.lowest_order, basis.highest_order);
  // With equal volumes it is the same as without.
  const meshless::basis::BasisOptions options{.volumes = true};
  return meshless::basis::make_basis<1>(basis.name, order, make_kernel(method), options);
}

} // namespace comparisons::benchmarks::rod
