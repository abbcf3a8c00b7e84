#pragma once

#include "meshless/elasticity/particle_solution.h"
#include "meshless/elasticity/plane_problem.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::elasticity::weak_form {

/// Parameters of the meshless local Petrov-Galerkin method (MLPG), Batra & Zhang 2008, section 3.2.
struct Parameters {
  DerivativeRule derivatives = DerivativeRule::direct; ///< direct: weak1, differentiated: weak2
  /// Test function W_I; it must vanish at the edge of its support.
  kernels::Kernel test_function = kernels::Gauss(1.0);
  /// Radius of the local subdomain in units of h_I: the kernel is stretched so that its support ends there.
  double test_radius = 1;
  /// nG: radial Gauss points; 4 nG in the angle, nG on every boundary part.
  int quadrature_points = 10;
  /// alpha / (E0 / L): the penalty on essential conditions over plane modulus and length.
  double penalty = 1e5;
  /// L in alpha = penalty E0 / L, m.
  double characteristic_length = 1;
};

/// Solves the problem by the weak form (3.19) on the local subdomains of all particles:
///   int sigma_ij W,j + alpha int_u u_i W - int_u sigma_ij n_j W
///     = int_t t_i W + alpha int_u ubar_i W + int b_i W,
/// where int_u and int_t run over the parts of the boundary on which component i of displacement
/// or traction is prescribed: conditions are mixed per component.
///
/// Rows are divided by their largest entry before the sparse LU.
///
/// @throws basis::SingularMomentMatrix if the basis does not exist at a particle or quadrature
///   point; linear_algebra::SolveError; std::invalid_argument for an ill-posed problem
ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis, const Parameters &parameters);

} // namespace meshless::elasticity::weak_form
