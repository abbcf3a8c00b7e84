#include "meshless/kernels/kernel_table.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::kernels {

namespace {

constexpr KernelDescription table[] = {
    {"gauss", "e^(-s^2) - e^(-rho^2), Batra & Zhang 2008 (3.15)", true, "", 0},
    {"revised_super_gauss", "(rho^2 - s^2) e^(-a s^2), Zhang & Batra 2008 (6.17)", true, "decay a", 1.6},
};

} // namespace

std::span<const KernelDescription> kernel_table() { return table; }

Kernel make_kernel(std::string_view name, double support, std::optional<double> parameter)
{
  if (!(support > 0))
    throw std::invalid_argument(fmt::format("kernel {}: its support {} is not positive", name, support));
  if (name == "gauss")
    return Gauss(support);
  if (name == "revised_super_gauss") {
    const double decay = parameter.value_or(1.6);
    if (!(decay > 0))
      throw std::invalid_argument(fmt::format("kernel {}: its decay {} is not positive", name, decay));
    return RevisedSuperGauss(support, decay);
  }
  std::string names;
  for (const auto &entry : table)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  throw std::invalid_argument(fmt::format("no kernel '{}'; there are {}", name, names));
}

double support_of(const Kernel &kernel)
{
  return std::visit([](const auto &k) { return k.support(); }, kernel);
}

} // namespace meshless::kernels
