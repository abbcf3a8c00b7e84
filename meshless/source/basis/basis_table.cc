#include "meshless/basis/basis_table.h"

#include "meshless/basis/ssph.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::basis {

namespace {

constexpr BasisDescription table[] = {
    {"ssph", "symmetric smoothed particle hydrodynamics (Batra & Zhang 2008, section 2)"},
};

} // namespace

std::span<const BasisDescription> basis_table() { return table; }

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_basis(std::string_view name, int order, const kernels::Kernel &kernel)
{
  if (name == "ssph")
    return make_ssph<dim>(order, kernel);
  std::string names;
  for (const auto &entry : table)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  throw std::invalid_argument(fmt::format("no basis '{}'; there are {}", name, names));
}

template std::unique_ptr<ShapeFunctions<1>> make_basis<1>(std::string_view, int, const kernels::Kernel &);
template std::unique_ptr<ShapeFunctions<2>> make_basis<2>(std::string_view, int, const kernels::Kernel &);
template std::unique_ptr<ShapeFunctions<3>> make_basis<3>(std::string_view, int, const kernels::Kernel &);

} // namespace meshless::basis
