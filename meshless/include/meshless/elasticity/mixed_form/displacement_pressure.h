#pragma once

#include "meshless/elasticity/particle_solution.h"
#include "meshless/elasticity/plane_problem.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::elasticity::mixed_form {

/// Parameters of the mixed meshless local Petrov-Galerkin method.
struct Parameters {
  /// Must vanish at the edge of its support; stretched so that this ends at the subdomain's edge.
  kernels::Kernel test_function = kernels::Gauss(1.0);
  /// Radius of the local subdomain in units of h_I.
  double test_radius = 1;
  weak_form::Subdomains subdomains = weak_form::Subdomains::whole;
  /// alpha of tau = alpha h_I^2 / (2 mu), > 0; 0 leaves the pressure free to oscillate.
  double stabilisation = 0.2;
  /// Of sparse LU; none: by size.
  std::optional<linear_algebra::Ordering> ordering;
};

/// Solves the problem for displacement u and pressure p = lambda div u, both unknown at all particles, with equal-order
/// interpolation stabilised by the residual of the momentum balance (PSPG: Hughes, Franca & Balestra 1986; local weak
/// forms: Atluri & Zhu 1998). Neither locks nor oscillates for nu -> 1/2 in plane strain.
///
/// With the test function w of particle I and its consistent gradient (weak_form::ConsistentGradient):
///   momentum    int w,j (2 mu eps_ij + p delta_ij) - int_u w (2 mu eps_ij + p delta_ij) n_j = int_t w t_i + int w b_i,
///   continuity  int w (c1 div u - c2 p) - tau int w,i (p,i + mu u_i,jj + mu u_j,ji + b_i) = 0,
/// where int_u runs over the parts of the boundary that prescribe component i of displacement, cuts through the
/// domain and interfaces, int_t over those that prescribe traction; c2 = 1 / (lambda + 2 mu), c1 = lambda c2,
/// tau = alpha h_I^2 / (2 mu). Subdomains have the shape of the particles' supports; on an ellipse tau is a tensor, so
/// that with lengths measured in h along it and across the method is that of discs. The second derivatives are the
/// basis' direct ones, so that the scheme is consistent: fields of displacement of degree m with pressures of degree m
/// - 1 are exact.
///
/// Prescribed components replace the momentum rows of particles on the boundary: sum phi_J u_J = ubar at the particle.
/// On an interface the softer side's displacement follows that of the other (see Interfaces), likewise collocated.
/// Unknowns of the pressure are p / mu, rows are divided by their largest entry.
///
/// @param displacement_basis of order m, with second derivatives
/// @param pressure_basis of order m - 1, with first derivatives; a support smaller by h is customary
/// @throws std::invalid_argument for an ill-posed problem, shrunk subdomains that are ellipses, or a basis without
/// second derivatives (order < 2);
///   basis::SingularMomentMatrix; linear_algebra::SolveError
ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> displacement_basis,
                       std::shared_ptr<const basis::ShapeFunctions<2>> pressure_basis, const Parameters &parameters);

/// Assembles the rows of `n_sampled` particles, evenly spread over their numbers, and multiplies up.
/// @throws as solve
RowSample sample_rows(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                      const basis::ShapeFunctions<2> &displacement_basis,
                      const basis::ShapeFunctions<2> &pressure_basis, const Parameters &parameters,
                      std::size_t n_sampled);

} // namespace meshless::elasticity::mixed_form
