#include "meshless/kernels/kernel_table.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace meshless::kernels {

namespace {

constexpr KernelDescription table[] = {
    {.name = "gauss",
     .meaning = "e^(-s^2) - e^(-rho^2), Batra & Zhang 2008 (3.15)",
     .free_support = true,
     .parameter = "",
     .default_parameter = 0,
     .support = 4,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 0,
     .kink = false,
     .gaussian = true},
    {.name = "revised_super_gauss",
     .meaning = "(rho^2 - s^2) e^(-a s^2), Zhang & Batra 2008 (6.17)",
     .free_support = true,
     .parameter = "decay a",
     .default_parameter = 1.6,
     .support = 2,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 0,
     .kink = false,
     .gaussian = true},
    {.name = "revised_gauss",
     .meaning = "e^(-s^2) - e^(-4), Zhang & Batra 2008 (6.8)",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 2,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 0,
     .kink = false,
     .gaussian = true},
    {.name = "super_gauss",
     .meaning = "(5/2 - s^2) e^(-s^2), cut off at rho, Zhang & Batra 2008 (6.9)",
     .free_support = true,
     .parameter = "",
     .default_parameter = 0,
     .support = 4,
     .non_negative = false,
     .monotone = false,
     .edge_smoothness = -1,
     .kink = false,
     .gaussian = true},
    {.name = "linear",
     .meaning = "(2 - s) / 4, Zhang & Batra 2008 (6.4)",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 2,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 0,
     .kink = true,
     .gaussian = false},
    {.name = "quadratic",
     .meaning = "(1 - s/2)^2, Zhang & Batra 2008 (6.5)",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 2,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 1,
     .kink = true,
     .gaussian = false},
    {.name = "cubic_spline",
     .meaning = "cubic B-spline, Zhang & Batra 2008 (6.6), Liu, Liu & Lam 2003 (41)",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 2,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 2,
     .kink = false,
     .gaussian = false},
    {.name = "quartic",
     .meaning = "(1 - s/2)^3 (1 + 3 s/2), Zhang & Batra 2008 (6.7)",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 2,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 2,
     .kink = false,
     .gaussian = false},
    {.name = "dome",
     .meaning = "1 - s^2, Liu, Liu & Lam 2003, section 3.3.1",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 1,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 0,
     .kink = false,
     .gaussian = false},
    {.name = "quintic",
     .meaning = "quintic B-spline, Liu, Liu & Lam 2003 (42)",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 3,
     .non_negative = true,
     .monotone = true,
     .edge_smoothness = 4,
     .kink = false,
     .gaussian = false},
    {.name = "new_quartic",
     .meaning = "(2 - s)^2 (1/6 + s/6 - 5 s^2/32), Liu, Liu & Lam 2003 (43)",
     .free_support = false,
     .parameter = "",
     .default_parameter = 0,
     .support = 2,
     .non_negative = false,
     .monotone = false,
     .edge_smoothness = 1,
     .kink = false,
     .gaussian = false},
};
static_assert(std::size(table) == std::variant_size_v<Kernel>);

const KernelDescription &entry_of(std::string_view name) {
  std::string names;
  for (const auto &entry : table) {
    if (entry.name == name)
      return entry;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  }
  throw std::invalid_argument(fmt::format("no kernel '{}'; there are {}", name, names));
}

/// The kernel on line `index` of the table.
template <std::size_t index = 0>
Kernel construct(std::size_t wanted, double support, double parameter) {
  if constexpr (index < std::variant_size_v<Kernel>) {
    using K = std::variant_alternative_t<index, Kernel>;
    if (index != wanted)
      return construct<index + 1>(wanted, support, parameter);
    if constexpr (std::is_constructible_v<K, double, double>)
      return K(support, parameter);
    else if constexpr (std::is_constructible_v<K, double>)
      return K(support);
    else
      return K();
  }
  throw std::logic_error("the table of kernels is longer than the variant");
}

} // namespace

std::span<const KernelDescription> kernel_table() { return table; }

const KernelDescription &describe(const Kernel &kernel) { return table[kernel.index()]; }

Kernel make_kernel(std::string_view name, std::optional<double> support, std::optional<double> parameter) {
  const auto &entry = entry_of(name);
  if (support && !(*support > 0 && std::isfinite(*support)))
    throw std::invalid_argument(fmt::format("kernel {}: its support {} is not positive", name, *support));
  if (support && !entry.free_support && *support != entry.support)
    throw std::invalid_argument(fmt::format("kernel {}: its support is {} h and cannot be {} h; leave it out or "
                                            "choose a kernel with a free cut-off, such as gauss",
                                            name, entry.support, *support));
  if (parameter && entry.parameter.empty())
    throw std::invalid_argument(fmt::format("kernel {}: it has no parameter, but {} is given", name, *parameter));
  if (parameter && !(*parameter > 0 && std::isfinite(*parameter)))
    throw std::invalid_argument(
        fmt::format("kernel {}: its {} = {} is not positive", name, entry.parameter, *parameter));
  const auto index = static_cast<std::size_t>(&entry - table);
  return construct(index, support.value_or(entry.support), parameter.value_or(entry.default_parameter));
}

double support_of(const Kernel &kernel) {
  return std::visit([](const auto &k) { return k.support(); }, kernel);
}

double normalisation_of(const Kernel &kernel, int dim) {
  return std::visit([dim](const auto &k) { return k.normalisation(dim); }, kernel);
}

double published_normalisation_of(const Kernel &kernel, int dim) {
  const double factor = describe(kernel).gaussian ? std::pow(std::numbers::pi, .5 * dim) : 1;
  return factor * normalisation_of(kernel, dim);
}

std::vector<double> breaks_of(const Kernel &kernel) {
  if (std::holds_alternative<CubicSpline>(kernel))
    return {1};
  if (std::holds_alternative<Quintic>(kernel))
    return {1, 2};
  return {};
}

} // namespace meshless::kernels
