#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>
#include <span>
#include <string_view>

namespace meshless::basis {

struct BasisDescription {
  std::string_view name;
  std::string_view meaning;
};

/// The one table of bases.
std::span<const BasisDescription> basis_table();

/// @param order degree of the monomials that are reproduced
/// @throws std::invalid_argument for an unknown name (listing the valid ones) or an order that the basis does not have
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_basis(std::string_view name, int order, const kernels::Kernel &kernel);

} // namespace meshless::basis
