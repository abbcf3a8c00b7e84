#include "meshless/basis/basis_table.h"

#include "meshless/basis/cspm.h"
#include "meshless/basis/fpm.h"
#include "meshless/basis/frozen_rkpm.h"
#include "meshless/basis/mls.h"
#include "meshless/basis/msph.h"
#include "meshless/basis/rkpm.h"
#include "meshless/basis/sph.h"
#include "meshless/basis/ssph.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::basis {

namespace {

constexpr auto always = VolumeUse::always;
constexpr BasisDescription table[] = {
    {"ssph", "symmetric smoothed particle hydrodynamics (Batra & Zhang 2008, section 2)", 1, 4, VolumeUse::optional, 3,
     true, true},
    {"mls", "moving least squares (Zhang & Batra 2008, section 5)", 1, 4, VolumeUse::optional, 3, true, true},
    {"rkpm", "reproducing kernel particles, corrected kernel differentiated (Zhang & Batra 2008, section 4)", 1, 4,
     always, 3, true, true},
    {"msph", "modified smoothed particle hydrodynamics (Zhang & Batra 2008, section 2)", 1, 2, always, 3, true, false},
    {"sph", "original smoothed particle hydrodynamics (Asprone et al. 2010, section 3.1)", 0, 0, always, 3, true, true},
    {"cspm", "corrective smoothed particle method (Chen & Beraun 2000; Asprone et al. 2010, section 3.2)", 2, 2, always,
     3, true, false},
    {"rkpm1_frozen", "RKPM of first order, coefficients frozen (Asprone et al. 2010, section 3.3)", 1, 1, always, 1,
     false, false},
    {"rkpm2_frozen", "RKPM of second order, coefficients frozen (Asprone et al. 2010, section 3.3)", 2, 2, always, 1,
     false, false},
    {"fpm", "finite particle method, reiterated (Asprone et al. 2010, section 3.4)", 1, 1, always, 1, false, false},
    {"modified_fpm", "modified finite particle method (Asprone et al. 2010, section 3.5)", 2, 2, always, 1, true,
     false},
    {"fpm2", "second-order finite particle method (Asprone et al. 2010, section 4)", 2, 2, always, 1, true, false},
};

std::unique_ptr<ShapeFunctions<1>> make_one_dimensional(std::string_view name, int order, const kernels::Kernel &kernel,
                                                        const BasisOptions &options) {
  if (name == "fpm")
    return make_fpm(kernel, options);
  if (name == "modified_fpm")
    return make_modified_fpm(kernel, options);
  if (name == "fpm2")
    return make_fpm2(kernel, options);
  return make_frozen_rkpm(order, kernel, options);
}

} // namespace

std::span<const BasisDescription> basis_table() { return table; }

const BasisDescription &describe_basis(std::string_view name) {
  std::string names;
  for (const auto &entry : table) {
    if (entry.name == name)
      return entry;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  }
  throw std::invalid_argument(fmt::format("no basis '{}'; there are {}", name, names));
}

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_basis(std::string_view name, int order, const kernels::Kernel &kernel,
                                                const BasisOptions &options) {
  const auto &entry = describe_basis(name);
  if (dim > entry.highest_dimension)
    throw std::invalid_argument(fmt::format("basis {} exists in one dimension only, not in {}", name, dim));
  if (order < entry.lowest_order || order > entry.highest_order)
    throw std::invalid_argument(entry.lowest_order == entry.highest_order
                                    ? fmt::format("basis {} is of order {}, not {}", name, entry.lowest_order, order)
                                    : fmt::format("basis {} of order {}; its orders are {} to {}", name, order,
                                                  entry.lowest_order, entry.highest_order));
  if (name == "ssph")
    return make_ssph<dim>(order, kernel, options);
  if (name == "mls")
    return make_mls<dim>(order, kernel, options);
  if (name == "rkpm")
    return make_rkpm<dim>(order, kernel, options);
  if (name == "msph")
    return make_msph<dim>(order, kernel, options);
  if (name == "sph")
    return make_sph<dim>(kernel, options);
  if (name == "cspm")
    return make_cspm<dim>(kernel, options);
  if constexpr (dim == 1)
    return make_one_dimensional(name, order, kernel, options);
  throw std::logic_error(fmt::format("basis {} is in the table and cannot be made", name));
}

#define INSTANTIATE(dim)                                                                                               \
  template std::unique_ptr<ShapeFunctions<dim>> make_basis<dim>(std::string_view, int, const kernels::Kernel &,        \
                                                                const BasisOptions &);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::basis
