#pragma once

#include "../elasticity/discretisation.h"
#include "fem_reference/elasticity/material.h"

#include <memory>
#include <span>

namespace fem_reference::multigrid {
/// The stiffness of quadrilaterals applied without a matrix, in single or double precision: Q1, Q2, Q3 and Q4 by
/// sum factorization at (p + 1)^2 Gauss points, as many cells at once as the machine has lanes.
///
/// Unknown = 2 node + component. The moduli are divided by `scale`, to stay within the range of single precision. Of
/// prescribed unknowns x is taken as given (zero, in a correction), and y comes out as zero.
///
/// As many threads as were set when it was made, fewer for small spaces; the results do not depend on them.
template <typename Number>
class StiffnessOperator {
public:
  virtual ~StiffnessOperator() = default;

  /// y = K x
  virtual void apply(std::span<const Number> x, std::span<Number> y) const = 0;
  /// The diagonal of K; one where the unknown is prescribed.
  virtual std::vector<Number> diagonal() const = 0;
  /// What apply reads of the geometry, in bytes.
  virtual std::size_t bytes() const = 0;
};

/// `prescribed` marks the unknowns; it has to outlive the operator, as the space has. Throws InvalidInput if a Jacobian
/// is not positive at a Gauss point.
template <typename Number>
std::unique_ptr<StiffnessOperator<Number>> make_stiffness_operator(const elasticity::Discretisation &space,
                                                                   std::span<const elasticity::Material> materials,
                                                                   std::span<const char> prescribed, double scale);
} // namespace fem_reference::multigrid
