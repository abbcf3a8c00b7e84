#pragma once

#include "../elasticity/discretisation.h"
#include "fem_reference/elasticity/material.h"

#include <memory>
#include <span>
#include <vector>

namespace fem_reference::multigrid {
/// Geometric multigrid for quadrilaterals Q1 to Q4, without a matrix: conjugate gradients in double precision,
/// preconditioned by one V-cycle in single precision.
///
/// Levels: Qp, then Q(p/2) ... Q1 on the same mesh, then Q1 on the meshes it came from by refinement, as far as they
/// can be found (`coarsen_mesh`) and as the prescribed unknowns allow: where a coarse function would move one, a level
/// would not be a subspace. The coarsest is solved by Cholesky. The smoother is Chebyshev's of the fourth kind with the
/// diagonal (Lottes, "Optimal polynomial smoothers for multigrid V-cycles", 2023): it needs the largest eigenvalue
/// alone, which the power iteration estimates.
class Multigrid {
public:
  /// `prescribed` marks the unknowns 2 node + component. All arguments have to outlive the object. Throws InvalidInput
  /// for triangles and for a Jacobian that is not positive.
  Multigrid(const elasticity::Discretisation &space, std::span<const elasticity::Material> materials,
            std::span<const char> prescribed);
  ~Multigrid();
  Multigrid(const Multigrid &) = delete;
  Multigrid &operator=(const Multigrid &) = delete;

  struct Result {
    int iterations = 0;
    double relative_residual = 0; ///< of the iteration's own residual
  };

  /// Solve K x = right_hand_side with zeros where prescribed (there the right-hand side is not read). Ends when the
  /// norm of the residual is `tolerance` of that of the right-hand side. Throws SolveFailure after 200 iterations, or
  /// if the matrix shows itself not positive definite.
  Result solve(std::span<const double> right_hand_side, double tolerance, std::span<double> x);

  /// A lower bound of the largest row sum of |K|.
  double largest_diagonal() const;
  int n_levels() const;
  std::size_t n_coarsest_unknowns() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};
} // namespace fem_reference::multigrid
