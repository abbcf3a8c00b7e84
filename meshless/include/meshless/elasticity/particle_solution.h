#pragma once

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/shape_functions.h"
#include "meshless/cloud/candidate_search.h"
#include "meshless/elasticity/plane_problem.h"

#include <memory>
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

/// A discrete displacement field: coefficients u_J of the shape functions (not the displacement at
/// the particles: the basis is not interpolating). Evaluates anywhere in the cloud.
class ParticleSolution {
public:
  /// @param coefficients u1, u2 of every particle, interleaved, m
  ParticleSolution(std::shared_ptr<const cloud::Particles<2>> particles,
                   std::shared_ptr<const basis::ShapeFunctions<2>> basis, DerivativeRule rule, Material material,
                   std::vector<double> coefficients);

  /// Displacement at points, m.
  void displacement(std::span<const Point2> points, std::span<Vector2> values) const;
  /// Stress at points, Pa, with the derivatives that the method itself uses.
  void stress(std::span<const Point2> points, std::span<Stress2> values) const;

  const cloud::Particles<2> &particles() const { return *particles_; }
  std::span<const double> coefficients() const { return coefficients_; }

  // Figures of the solve.
  SolveSeconds seconds;
  std::int64_t nonzeros = 0;
  double backward_error = 0;
  double reciprocal_condition = 0;

private:
  std::shared_ptr<const cloud::Particles<2>> particles_;
  std::shared_ptr<const basis::ShapeFunctions<2>> basis_;
  DerivativeRule rule_;
  Material material_;
  std::vector<double> coefficients_;
  cloud::CandidateSearch<2> search_;
};

} // namespace meshless::elasticity
