#pragma once

#include "kernel_weights.h"

#include <memory>

namespace meshless::basis {

/// What `gradient` and `hessian` mean.
enum class DerivativeKind {
  direct,        ///< further rows of C^-1 p W (SSPH)
  differentiated ///< derivatives of the shape function itself, coefficients included (RKPM, MLS)
};

/// SSPH, RKPM and MLS: their shape functions of f are the same, phi_J = e_1^T C^-1 p_J W_J, up to the weights.
/// @param name of the basis, for messages
/// @throws std::invalid_argument for an order other than 1 to 4
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_weighted_basis(const char *name, int order, const Weighing &weighing,
                                                         DerivativeKind kind);

} // namespace meshless::basis
