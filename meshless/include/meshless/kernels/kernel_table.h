#pragma once

#include "meshless/kernels/cubic_spline.h"
#include "meshless/kernels/dome.h"
#include "meshless/kernels/gauss.h"
#include "meshless/kernels/linear.h"
#include "meshless/kernels/new_quartic.h"
#include "meshless/kernels/quadratic.h"
#include "meshless/kernels/quartic.h"
#include "meshless/kernels/quintic.h"
#include "meshless/kernels/revised_gauss.h"
#include "meshless/kernels/revised_super_gauss.h"
#include "meshless/kernels/super_gauss.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace meshless::kernels {

/// Any kernel, in the order of the table; outer code chooses once, inner loops are instantiated for each.
using Kernel = std::variant<Gauss, RevisedSuperGauss, RevisedGauss, SuperGauss, Linear, Quadratic, CubicSpline, Quartic,
                            Dome, Quintic, NewQuartic>;

struct KernelDescription {
  std::string_view name;
  std::string_view meaning;
  /// The support radius is a free parameter.
  bool free_support;
  /// Meaning of the kernel's own parameter; empty if it has none.
  std::string_view parameter;
  double default_parameter;
  /// Radius of the support in units of h: the only one, or where it is free the paper's.
  double support;
  bool non_negative;
  /// Falls from the centre to the edge.
  bool monotone;
  /// Order of the highest derivative that is continuous at the edge; -1: the kernel itself jumps.
  int edge_smoothness;
  /// W'(0) is not 0 but agreed to be.
  bool kink;
  /// The papers write the normalising factor as G / (h sqrt(pi))^dim, not as G / h^dim.
  bool gaussian;
};

/// The one table of kernels.
std::span<const KernelDescription> kernel_table();

/// The line of the table for this kernel.
const KernelDescription &describe(const Kernel &kernel);

/// @param support radius in units of h, > 0; the one of the table if absent
/// @param parameter the kernel's own parameter; the default of the table if absent
/// @throws std::invalid_argument listing the valid names if there is no such kernel; for a support
///   or a parameter that is not positive, or that the kernel does not have
Kernel make_kernel(std::string_view name, std::optional<double> support, std::optional<double> parameter = {});

/// Radius of the support in units of h.
double support_of(const Kernel &kernel);

/// Factor that makes the integral of W / h^dim equal to 1.
double normalisation_of(const Kernel &kernel, int dim);

/// The same as the papers give it: G, for Gaussian kernels without the factor 1 / sqrt(pi)^dim.
double published_normalisation_of(const Kernel &kernel, int dim);

/// Distances s inside the support where a higher derivative jumps: quadrature must stop there.
std::vector<double> breaks_of(const Kernel &kernel);

} // namespace meshless::kernels
