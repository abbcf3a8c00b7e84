#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>
#include <span>
#include <string_view>

namespace meshless::basis {

/// Whether a basis weighs particles with their volumes.
enum class VolumeUse { optional, always };

struct BasisDescription {
  std::string_view name;
  std::string_view meaning;
  /// Degrees of the Taylor series that it can rest on.
  int lowest_order;
  int highest_order;
  VolumeUse volumes;
  /// Exists in dimensions 1 to this.
  int highest_dimension;
  /// Has shape functions of the second derivative at any point; otherwise its operators at particles have.
  bool hessian_anywhere;
  /// Gives derivatives of the shape function itself (weak2).
  bool differentiable;
};

/// The one table of bases.
std::span<const BasisDescription> basis_table();

/// The line of the table with this name.
/// @throws std::invalid_argument listing the valid names
const BasisDescription &describe_basis(std::string_view name);

/// @param order degree of the Taylor series, within the basis's own limits
/// @throws std::invalid_argument for an unknown name (listing the valid ones), an order or a dimension that the basis
///   does not have, or a kernel that it cannot use
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_basis(std::string_view name, int order, const kernels::Kernel &kernel,
                                                const BasisOptions &options = {});

} // namespace meshless::basis
