#pragma once

#include "meshless/elasticity/particle_solution.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <memory>
#include <vector>

namespace meshless::elasticity {

/// M d2u/dt2 + K u = f for the coefficients u of the shape functions, u1 and u2 of a particle after each other. The
/// matrices need not be symmetric, and rows of M may be empty: those are conditions, not equations of motion.
struct EquationsOfMotion {
  linear_algebra::SparseRows stiffness;
  linear_algebra::SparseRows mass;
  std::vector<double> force;
  std::shared_ptr<const cloud::Particles<2>> particles;
  std::shared_ptr<const basis::ShapeFunctions<2>> basis;
  std::shared_ptr<const Surroundings> surroundings;
  DerivativeRule derivatives = DerivativeRule::direct;
  SolveSeconds seconds;
};

} // namespace meshless::elasticity
