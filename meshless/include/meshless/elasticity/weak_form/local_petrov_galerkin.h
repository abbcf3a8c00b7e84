#pragma once

#include "meshless/elasticity/equations_of_motion.h"
#include "meshless/elasticity/linear_system.h"
#include "meshless/elasticity/particle_solution.h"
#include "meshless/elasticity/plane_problem.h"
#include "meshless/elasticity/row_sample.h"
#include "meshless/kernels/kernel_table.h"
#include "meshless/linear_algebra/system_solver.h"

#include <memory>
#include <optional>

namespace meshless::elasticity::weak_form {

/// Which local subdomains are used.
enum class Subdomains {
  whole, ///< of the radius test_radius h_I, cut by the boundary (Batra & Zhang 2008)
  /// A particle inside has a disc that reaches no farther than the boundary; one on the boundary a disc that reaches
  /// no farther than another part of the boundary across the domain. On irregular clouds a particle may lie much closer
  /// to the boundary than its h: its cut disc would be all but that of a particle on the boundary, and the distance to
  /// the boundary as seen from it a function that Gauss points integrate badly.
  shrunk,
};

/// The rows of particles inside.
enum class InteriorRows {
  weak,
  collocated, ///< equilibrium at the particle, as in the strong form; boundary rows remain weak
};

/// How subdomains are integrated.
enum class IntegrationRule {
  paper, ///< nG x 4 nG Gauss points (Batra & Zhang 2008)
  /// Few points, with the gradient of the test function made consistent with them (ConsistentGradient): the patch test
  /// holds for polynomials of the basis's order on any cloud.
  consistent,
};

/// Length in the penalty alpha = penalty E0 / length.
enum class PenaltyLength {
  domain,    ///< of the domain, L; Batra & Zhang 2008 take 1e5 E0 / L
  smoothing, ///< h of the particle that is nearest to the boundary point, in its region
};

/// Rows of particles inside whose subdomain and neighbours lie as those of another one, moved, as on a grid most do.
enum class RepeatedRows {
  copied,   ///< the same coefficients in other columns: equal to rounding
  computed, ///< every row by its own quadrature
};

/// Parameters of the meshless local Petrov-Galerkin method (MLPG), Batra & Zhang 2008, section 3.2.
struct Parameters {
  DerivativeRule derivatives = DerivativeRule::direct; ///< direct: weak1, differentiated: weak2
  /// Test function W_I; it must vanish at the edge of its support. Empty: the Heaviside function W_I = 1 (MLPG5, Atluri
  /// & Shen 2002), for which the weak form has integrals over the edge of the subdomain alone.
  std::optional<kernels::Kernel> test_function = kernels::Gauss(1.0);
  /// Radius of the local subdomain in units of h_I: the kernel is stretched so that its support ends there.
  double test_radius = 1;
  Subdomains subdomains = Subdomains::whole;
  InteriorRows interior_rows = InteriorRows::weak;
  IntegrationRule integration = IntegrationRule::paper;
  /// Only in one convex region with round supports, without body force and thermal strain; elsewhere all are computed.
  RepeatedRows repeated_rows = RepeatedRows::copied;
  /// nG: radial Gauss points; 4 nG in the angle, nG on every boundary part; with the Heaviside function nG + 2 on a
  /// whole circle, nG on every arc of one. The consistent rule has those of consistent_points.
  int quadrature_points = 10;
  /// alpha / (E0 / length): the penalty on essential conditions over plane modulus and length. With the flux through
  /// these boundaries in the form, alpha need not be large for accuracy; a large one leaves the equilibrium of the
  /// particles around to differences of large numbers, which on irregular particles may all but vanish.
  double penalty = 1e5;
  PenaltyLength penalty_length = PenaltyLength::domain;
  /// L of the domain, m.
  double characteristic_length = 1;
  linear_algebra::SolverRequest solver;
};

/// A penalty that suits every cloud with PenaltyLength::smoothing. On clouds jittered by 30 % around a hole, orders 1
/// to 4, 7 to 70 do, 700 has outliers in one of thirty clouds (hundreds of times the error of the cloud as it is).
inline constexpr double moderate_penalty = 20;

/// alpha, Pa/m: on prescribed displacement the body is held by the traction sigma n - alpha (u - ubar).
/// @param smoothing_length h of the nearest particle, m
double penalty_factor(const Parameters &parameters, const Material &material, double smoothing_length);

/// h of that of the candidates that is nearest to x; of several that are equally near, to a relative 5e-10, the
/// largest, so that rounding does not choose (the middle point of a rule between a particle and a corner).
/// @param candidates at least one
double nearest_smoothing_length(const cloud::Particles<2> &particles, std::span<const cloud::Index> candidates,
                                const Point2 &x);

/// Solves the problem by the weak form (3.19) on the local subdomains of all particles:
///   int sigma_ij W,j + alpha int_u u_i W - int_u sigma_ij n_j W - int_c sigma_ij n_j W
///     = int_t t_i W + alpha int_u ubar_i W + int b_i W,
/// where int_u and int_t run over the parts of the boundary on which component i of displacement
/// or traction is prescribed (conditions are mixed per component), and int_c over what else W does not vanish on: cuts
/// through the domain, where what lies behind is hidden (domain::Visibility), and with the Heaviside function the
/// circle.
///
/// Shape functions at the points of a subdomain are made of particles of its own region that its particle sees. On an
/// interface the displacement of the softer region a follows that of the other, b (see Interfaces): rows of a get
///   alpha int (u_a - u_b) W - int sigma_a n_a W, those of b - int sigma_a n_b W.
///
/// Rows are divided by their largest entry before the system is solved.
///
/// @throws basis::SingularMomentMatrix if the basis does not exist at a particle or quadrature
///   point; linear_algebra::SolveError; std::invalid_argument for an ill-posed problem
ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis, const Parameters &parameters);

/// The system that `solve` solves.
/// @throws as solve
LinearSystem linear_system(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                           const basis::ShapeFunctions<2> &basis, const Parameters &parameters);

/// The field of coefficients found elsewhere from this system.
ParticleSolution solution_of(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                             std::shared_ptr<const basis::ShapeFunctions<2>> basis, const Parameters &parameters,
                             std::vector<double> coefficients);

/// Assembles the rows of `n_sampled` particles, evenly spread over their numbers, and multiplies up.
/// @throws as solve
RowSample sample_rows(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                      const basis::ShapeFunctions<2> &basis, const Parameters &parameters, std::size_t n_sampled);

/// The same rows as equations of motion, with the mass rho int W_I phi_J over the subdomains (of collocated rows
/// -rho phi_J at the particle). Rows are not divided by anything. A body without supports is allowed.
///
/// @param densities of the regions, kg/m^3
/// @throws as `solve`; std::invalid_argument for a density that is not positive
EquationsOfMotion equations_of_motion(const PlaneProblem &problem, std::span<const double> densities,
                                      std::shared_ptr<const cloud::Particles<2>> particles,
                                      std::shared_ptr<const basis::ShapeFunctions<2>> basis,
                                      const Parameters &parameters);

} // namespace meshless::elasticity::weak_form
