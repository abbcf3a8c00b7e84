#pragma once

#include "meshless/kernels/gauss.h"
#include "meshless/kernels/revised_super_gauss.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace meshless::kernels {

/// Any kernel; outer code chooses once, inner loops are instantiated for each.
using Kernel = std::variant<Gauss, RevisedSuperGauss>;

struct KernelDescription {
  std::string_view name;
  std::string_view meaning;
  /// The support radius is a free parameter.
  bool free_support;
  /// Meaning of the kernel's own parameter; empty if it has none.
  std::string_view parameter;
  double default_parameter;
};

/// The one table of kernels.
std::span<const KernelDescription> kernel_table();

/// @param support radius in units of h, > 0
/// @param parameter the kernel's own parameter; the default of the table if absent
/// @throws std::invalid_argument listing the valid names if there is no such kernel; for a support
///   or a parameter that is not positive
Kernel make_kernel(std::string_view name, double support, std::optional<double> parameter = {});

/// Radius of the support in units of h.
double support_of(const Kernel &kernel);

} // namespace meshless::kernels
