// Plane motion by particles: rigid motions, mass, integrators against exact solutions, what is refused.

#include "meshless/dynamics/plane_motion.h"
#include "meshless/dynamics/violation.h"
#include "meshless/elasticity/field_energy.h"
#include "meshless/linear_algebra/generalized_eigenvalues.h"
#include "unit/elasticity/plane_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace plane_samples;
using namespace meshless::dynamics;

constexpr double density = 2;
const Material material(10, 0.3, PlaneModel::plane_stress);

enum class Supports { none, left, all };

VectorField nothing() {
  return field([](Point2) { return Vector2{}; });
}

PlaneProblem plate(Supports supports) {
  PlaneProblem problem{{{domain::rectangle({0, 0}, {2, 1}), material}}, {}, {}};
  for (int id = 0; id < 4; ++id)
    problem.conditions[id] = supports == Supports::all || (supports == Supports::left && id == 0)
                                 ? BoundaryCondition{{fixed, fixed}, nothing(), {}}
                                 : BoundaryCondition{};
  return problem;
}

std::shared_ptr<const cloud::Particles<2>> grid(int nx, int ny) {
  std::vector<Point2> points;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      points.push_back({2.0 * i / (nx - 1), 1.0 * j / (ny - 1)});
  return std::make_shared<const cloud::Particles<2>>(points, std::vector<double>(points.size(), 2.0 / (nx - 1)));
}

std::shared_ptr<const basis::ShapeFunctions<2>> ssph() { return basis::make_ssph<2>(2, kernels::Gauss(4.0)); }

std::shared_ptr<const EquationsOfMotion> weak(const PlaneProblem &problem, DerivativeRule rule = DerivativeRule::direct,
                                              int nx = 13, int ny = 7) {
  weak_form::Parameters parameters;
  parameters.derivatives = rule;
  parameters.quadrature_points = 6;
  parameters.characteristic_length = 2;
  return std::make_shared<const EquationsOfMotion>(
      weak_form::equations_of_motion(problem, std::vector{density}, grid(nx, ny), ssph(), parameters));
}

TEST(PlaneMotion, RigidMotionsAreFreeOfForceAndOfFrequency) {
  for (const auto rule : {DerivativeRule::direct, DerivativeRule::differentiated}) {
    const auto equations = weak(plate(Supports::none), rule);
    auto squares = linear_algebra::generalized_eigenvalues(equations->stiffness, equations->mass, -1);
    std::sort(squares.begin(), squares.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
    // Rounding of K, eps times the largest square (1e5 here), times the condition of the eigenvectors.
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(std::abs(squares[k]), 1e-8) << k;
    EXPECT_GT(std::abs(squares[3]), 1);
  }
}

TEST(PlaneMotion, AUniformForceMovesAFreeBodyAsAPoint) {
  auto problem = plate(Supports::none);
  problem.body_force = field([](Point2) { return Vector2{3 * density, 0}; });
  const auto equations = weak(problem);
  for (const auto integration : {TimeIntegration::newmark, TimeIntegration::central_difference}) {
    PlaneMotion motion(equations, {.integration = integration});
    const double dt = std::min(0.01, 0.5 * motion.stable_step());
    const int n = 20;
    for (int k = 0; k <= n; ++k)
      motion.step(dt);
    // Coefficients of a constant are that constant; a t^2 / 2 is exact for both. The rounding of each step's solution
    // is amplified by the condition of the mass, about 1e3.
    const double t = integration == TimeIntegration::newmark ? (n + 1) * dt : n * dt;
    for (std::size_t i = 0; i < motion.displacement().size(); ++i)
      ASSERT_NEAR(motion.displacement()[i], i % 2 == 0 ? 1.5 * t * t : 0, 1e-9 * t * t) << i;
  }
}

TEST(PlaneMotion, EnergiesAreThoseOfAKnownField) {
  const auto equations = weak(plate(Supports::none));
  FieldEnergy::Quadrature quadrature;
  const auto rule = linear_algebra::gauss_legendre(4);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      quadrature.points.push_back({2 * rule.points[i], rule.points[j]});
      quadrature.weights.push_back(2 * rule.weights[i] * rule.weights[j]);
    }
  quadrature.force_points = {{2, 0.5}};
  quadrature.forces = {{0, 4}};
  const FieldEnergy energy(*equations, std::vector{density}, quadrature);
  // u = (x, -y / 2): a basis that reproduces linear fields has its values as coefficients.
  std::vector<double> u;
  for (const auto &x : equations->particles->positions()) {
    u.push_back(x[0]);
    u.push_back(-x[1] / 2);
  }
  const double strain = 0.5 * 2 * (material.axial() * 1.25 - 2 * material.coupling() * 0.5);
  EXPECT_NEAR(energy.strain(u), strain, 1e-10 * strain);
  const double kinetic = 0.5 * density * (8.0 / 3 + 2.0 / 12);
  EXPECT_NEAR(energy.kinetic(u), kinetic, 1e-10 * kinetic);
  EXPECT_NEAR(energy.work(u), -1, 1e-10);
}

TEST(PlaneMotion, BothIntegratorsGiveTheSameMotionAndItSettlesWithDamping) {
  auto problem = plate(Supports::left);
  problem.conditions[1].traction = [](std::span<const Point2>, std::span<const Vector2>, std::span<Vector2> values) {
    std::fill(values.begin(), values.end(), Vector2{0, 0.01});
  };
  const auto equations = weak(problem, DerivativeRule::differentiated);
  weak_form::Parameters parameters;
  parameters.derivatives = DerivativeRule::differentiated;
  parameters.quadrature_points = 6;
  parameters.characteristic_length = 2;
  const auto still = weak_form::solve(problem, equations->particles, equations->basis, parameters);
  const std::size_t tip = 2 * (equations->particles->size() - 4) + 1;
  // omega of the first mode is about .57: over-damped, it creeps back at omega^2 / rate = .08 1/s.
  PlaneMotion motion(equations, {.damping = effects::Damping{4}});
  for (int k = 0; k < 700; ++k)
    motion.step(0.5);
  EXPECT_NEAR(motion.displacement()[tip] / still.coefficients()[tip], 1, 1e-6);

  PlaneMotion implicit(equations, {});
  PlaneMotion explicit_(equations, {.integration = TimeIntegration::central_difference});
  const double dt = 0.9 * explicit_.stable_step();
  const double end = 4; // about half of the first period
  while (implicit.time() < end)
    implicit.step(0.02);
  while (explicit_.time() < end)
    explicit_.step(dt);
  // Lumping errs by h^2 of the wave length, and both in time.
  EXPECT_NEAR(explicit_.displacement()[tip] / implicit.displacement()[tip], 1, 0.05);
}

TEST(PlaneMotion, WhatCannotMoveIsRefused) {
  const auto collocated = std::make_shared<const EquationsOfMotion>(
      strong_form::equations_of_motion(plate(Supports::left), std::vector{density}, grid(13, 7), ssph()));
  EXPECT_THROW(PlaneMotion(collocated, {}), std::invalid_argument);
  const auto equations = weak(plate(Supports::left));
  EXPECT_THROW(PlaneMotion(equations, {.damping = effects::Damping{-1}}), std::invalid_argument);
  PlaneMotion motion(equations, {.integration = TimeIntegration::central_difference});
  EXPECT_THROW(motion.step(1.01 * motion.stable_step()), Violation);
  EXPECT_THROW(weak_form::equations_of_motion(plate(Supports::left), std::vector{0.0}, grid(13, 7), ssph(), {}),
               std::invalid_argument);
}

TEST(PlaneMotion, AStateThatIsTakenOverGoesOnWithTheSameBits) {
  auto problem = plate(Supports::left);
  problem.body_force = field([](Point2 x) { return Vector2{x[1], 1}; });
  const auto equations = weak(problem, DerivativeRule::direct, 9, 5);
  PlaneMotion whole(equations, {}), part(equations, {}), other(equations, {});
  for (int k = 0; k < 20; ++k)
    whole.step(0.05);
  for (int k = 0; k < 7; ++k)
    part.step(0.05);
  const auto from = part.state();
  const auto to = other.state();
  for (std::size_t f = 0; f < from.size(); ++f)
    std::copy(from[f].values.begin(), from[f].values.end(), to[f].values.begin());
  other.adopt_state();
  for (int k = 0; k < 13; ++k)
    other.step(0.05);
  EXPECT_EQ(other.time(), whole.time());
  for (std::size_t i = 0; i < whole.displacement().size(); ++i)
    ASSERT_EQ(other.displacement()[i], whole.displacement()[i]) << i;
}

} // namespace
