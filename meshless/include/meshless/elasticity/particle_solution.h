#pragma once

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/shape_functions.h"
#include "meshless/cloud/candidate_search.h"
#include "meshless/elasticity/surroundings.h"
#include "meshless/linear_algebra/system_solver.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace meshless::elasticity {

/// How first derivatives of the trial solution are found.
enum class DerivativeRule {
  direct,         ///< rows 2, 3 of K, without differentiating (weak1, strong), Eq. (3.21)
  differentiated, ///< derivatives of the shape function (weak2), Eq. (3.26)
};

/// Wall-clock seconds of the phases of one solve.
struct SolveSeconds {
  double neighbours = 0;
  double basis = 0;
  double assembly = 0;
  double solve = 0;
};

/// The pressure of a mixed method: p = sum psi_J p_J with a basis of its own.
struct PressureField {
  std::shared_ptr<const basis::ShapeFunctions<2>> basis;
  std::vector<double> coefficients; ///< p_J of every particle, Pa
};

/// A discrete displacement field: coefficients u_J of the shape functions (not the displacement at
/// the particles: the basis is not interpolating). Evaluates anywhere in the cloud.
class ParticleSolution {
public:
  /// @param coefficients u1, u2 of every particle, interleaved, m
  ParticleSolution(std::shared_ptr<const cloud::Particles<2>> particles,
                   std::shared_ptr<const basis::ShapeFunctions<2>> basis, DerivativeRule rule,
                   std::shared_ptr<const Surroundings> surroundings, std::vector<double> coefficients);

  /// Of a mixed method: stress is then 2 mu eps + p I.
  void set_pressure(PressureField pressure);
  bool has_pressure() const { return pressure_.basis != nullptr; }
  /// p = lambda div u at points, Pa, positive in tension, with the lambda of plane strain or plane stress.
  /// @throws std::logic_error unless has_pressure()
  void pressure(std::span<const Point2> points, std::span<double> values, std::span<const int> regions = {}) const;

  /// Displacement at points, m.
  /// @param regions of every point, for points on an interface; if empty each is taken to be in the first region that
  ///   it lies in
  void displacement(std::span<const Point2> points, std::span<Vector2> values, std::span<const int> regions = {}) const;
  /// Stress at points, Pa, with the derivatives that the method itself uses.
  void stress(std::span<const Point2> points, std::span<Stress2> values, std::span<const int> regions = {}) const;

  /// The free strain that `stress` takes off; empty: none.
  void set_thermal_strain(ScalarField thermal_strain) { thermal_strain_ = std::move(thermal_strain); }

  const cloud::Particles<2> &particles() const { return *particles_; }
  const Surroundings &surroundings() const { return *surroundings_; }
  std::span<const double> coefficients() const { return coefficients_; }

  /// Takes over what is known of the solve.
  void set_figures(const SolveSeconds &spent, std::int64_t entries, const linear_algebra::SystemSolution &system);

  // Figures of the solve.
  SolveSeconds seconds;
  std::int64_t nonzeros = 0;
  std::size_t n_repeated = 0; ///< particles whose rows are copies of another's, moved
  double backward_error = 0;
  double algebraic_error = 0; ///< of the coefficients, relative: SystemSolution::algebraic_error
  double reciprocal_condition = 0;
  linear_algebra::SolverChoice solver;
  int iterations = 0;           ///< of the linear solver; 0: sparse LU
  bool fell_back = false;       ///< to sparse LU
  int n_restarts = 0;           ///< of the iteration: SystemSolution::n_restarts
  bool coarse_left_out = false; ///< of its preconditioner: SystemSolution::coarse_left_out

private:
  using Visitor = std::function<void(const basis::GroupedEvaluation<2>::Group &, std::size_t region,
                                     std::span<const std::size_t> points)>;
  /// Visits all points, those of one region after those of another.
  void visit(const basis::ShapeFunctions<2> &basis, const cloud::CandidateSearch<2> &search,
             std::span<const Point2> points, std::span<const int> regions, const basis::Wanted &wanted,
             const Visitor &visitor) const;

  void subtract_thermal(std::span<const Point2> points, std::span<Stress2> values, std::span<const int> regions) const;

  std::shared_ptr<const cloud::Particles<2>> particles_;
  std::shared_ptr<const basis::ShapeFunctions<2>> basis_;
  DerivativeRule rule_;
  std::shared_ptr<const Surroundings> surroundings_;
  std::vector<double> coefficients_;
  ScalarField thermal_strain_;
  cloud::CandidateSearch<2> search_;
  PressureField pressure_;
  std::optional<cloud::CandidateSearch<2>> pressure_search_;
};

} // namespace meshless::elasticity
