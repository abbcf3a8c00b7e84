#pragma once

#include "comparisons/scene/vocabulary.h"

#include "meshless/basis/basis_table.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>
#include <string>
#include <vector>

namespace comparisons::benchmarks::rod {

/// All bases, for the key `basis`.
std::vector<std::string> basis_names();

/// The kernel of a method. Its support is the key `support`, for a kernel with a free cut-off 6 if that is absent: the
/// Gauss function is 2e-16 there.
/// @throws std::invalid_argument for a support or parameter that the kernel does not have
meshless::kernels::Kernel make_kernel(const scene::Parameters &method);

/// Radius of the support in units of h.
double support_of(const scene::Parameters &method);

/// @throws std::invalid_argument for a kernel or order that the basis cannot use
std::unique_ptr<meshless::basis::ShapeFunctions<1>> make_basis(const scene::Parameters &method);

} // namespace comparisons::benchmarks::rod
