// Plane dynamics of the reference against polynomials (Rayleigh and Ritz), beams, and what an integrator keeps.

#include "verification/deal_ii/ritz.h"
#include "verification/fem_support.h"

#include "fem_reference/elasticity/plane_dynamics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace fem_test;

constexpr double density = 7850;
const Material steel(210e9, .3, PlaneModel::plane_stress);

BoundaryCondition clamp() {
  return {{fixed, fixed}, batch([](Point) { return Vector{}; }), {}};
}

enum class Supports { none, left, all };

PlaneProblem plate(PlaneMesh mesh, Supports supports, const Material &material = steel) {
  PlaneProblem problem{std::move(mesh), {material}, {}};
  for (int id = 0; id < 4; ++id)
    problem.boundary[id] =
        supports == Supports::all || (supports == Supports::left && id == 0) ? clamp() : BoundaryCondition{};
  return problem;
}

PlaneProblem plate(unsigned nx, unsigned ny, Supports supports) {
  return plate(mesh::rectangle({0, 0}, {2, 1}, nx, ny), supports);
}

PlaneDynamicsOptions options(int degree, Mass mass = Mass::consistent) {
  return {.degree = degree, .mass = mass, .densities = {density}};
}

TEST(FemDynamics, FreePlateHasThreeRigidMotionsAndThePolynomialsFrequencies) {
  const auto exact = ritz_squares(14, false, steel.lambda(), steel.mu(), density);
  const auto modes = natural_frequencies(plate(17, 9, Supports::none), options(4), 12);
  // Rigid motions: rounding of K, eps |K| / |M|, that is about eps of the largest square, here 1e4 times the first.
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(std::abs(modes.squares[k]), 1e-9 * modes.squares[3]) << k;
  // Both bounds from above of a smooth problem; elements of h = 1/8 and degree 4 err by about h^8.
  for (int k = 3; k < 9; ++k)
    EXPECT_NEAR(modes.squares[k] / exact[k], 1, 1e-7) << k;
}

TEST(FemDynamics, ClampedPlateHasThePolynomialsFrequencies) {
  const auto exact = ritz_squares(17, true, steel.lambda(), steel.mu(), density);
  const auto modes = natural_frequencies(plate(17, 9, Supports::all), options(4), 9);
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(modes.squares[k] / exact[k], 1, 2e-6) << k; // singular corners: both converge algebraically
}

TEST(FemDynamics, FrequenciesConvergeTwiceAsFastAsStrains) {
  const auto exact = natural_frequencies(plate(17, 9, Supports::none), options(4), 12).squares;
  for (const auto mass : {Mass::consistent, Mass::lumped})
    for (int degree = 1; degree <= 2; ++degree) {
      double previous = 0;
      for (const unsigned n : {5U, 9U, 17U}) {
        const auto squares = natural_frequencies(plate(2 * n - 1, n, Supports::none), options(degree, mass), 8).squares;
        const double error = std::abs(squares[3] / exact[3] - 1);
        if (n == 17) {
          EXPECT_GT(std::log2(previous / error), 2 * degree - .25) << degree;
        }
        previous = error;
      }
    }
}

TEST(FemDynamics, LumpedMassMovesAFreeBodyAsAPoint) {
  // Where the lumped mass of a node is the integral of its shape function (quadrilaterals, linear triangles) a body
  // under a uniform force stays undeformed.
  for (const bool triangles : {false, true}) {
    const auto quadrilaterals = mesh::rectangle({0, 0}, {2, 1}, 5, 3);
    auto problem = plate(triangles ? mesh::split_into_triangles(quadrilaterals) : quadrilaterals, Supports::none);
    problem.body_force = batch([](Point) { return Vector{3 * density, 0}; });
    for (int degree = 1; degree <= (triangles ? 1 : 3); ++degree) {
      PlaneMotion motion(problem, options(degree, Mass::lumped), TimeIntegration::central_difference);
      const double dt = .5 * motion.stable_step();
      motion.step(dt);
      motion.step(dt);
      // The work is force times a t^2 / 2 at t = 1.5 dt, the time of the velocity, on an area of 2.
      EXPECT_NEAR(motion.work() / (2 * 3 * density * 3 * 1.125 * dt * dt), 1, 1e-12) << degree;
    }
  }
}

PlaneProblem cantilever(PlaneMesh mesh) {
  auto problem = plate(std::move(mesh), Supports::left);
  problem.boundary[1].traction = [](std::span<const Point>, std::span<const Vector>, std::span<Vector> values) {
    std::fill(values.begin(), values.end(), Vector{0, 1e6});
  };
  return problem;
}

PlaneProblem cantilever() { return cantilever(mesh::rectangle({0, 0}, {1, .2}, 21, 5)); }

double tip(const PlaneMotion &motion) {
  const Point at{1, .1};
  Vector u{};
  motion.displacement({&at, 1}, {&u, 1});
  return u[1];
}

TEST(FemDynamics, NewmarkKeepsEnergyAndSwingsAboutTheStaticDeflection) {
  const auto problem = cantilever();
  const auto first = std::sqrt(natural_frequencies(problem, options(2), 3).squares[0]);
  const double period = 2 * std::numbers::pi / first;
  // Euler and Bernoulli: 3.516 sqrt(E I / (rho A L^4)); shear and rotation lower it by about 3 % at L / W = 5.
  const double beam = 3.51602 * std::sqrt(210e9 / density / 12) * .2;
  EXPECT_LT(first, beam);
  EXPECT_NEAR(first / beam, 1, .06);
  PlaneMotion motion(problem, options(2), TimeIntegration::newmark);
  const int n = 200;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    motion.step(period / n);
    sum += tip(motion);
    const double all = motion.kinetic_energy() + motion.strain_energy();
    ASSERT_NEAR(all, motion.work(), 1e-10 * 2 * std::abs(motion.work()) + 1e-12) << k;
  }
  const auto still = solve(problem, {});
  const Point at{1, .1};
  Vector u{};
  still.displacement({&at, 1}, {&u, 1});
  // Over one period the first mode has the mean of its static part, 97 % of all; the others' rests are a few per cent.
  EXPECT_NEAR(sum / n / u[1], 1, .02);
}

TEST(FemDynamics, CentralDifferencesKeepTheirEnergyAndRefuseAStepTooLong) {
  PlaneMotion motion(cantilever(), options(2, Mass::lumped), TimeIntegration::central_difference);
  EXPECT_THROW(PlaneMotion(cantilever(), options(2), TimeIntegration::central_difference), InvalidInput);
  EXPECT_THROW(motion.step(1.01 * motion.stable_step()), InvalidInput);
  double largest = 0;
  double error = 0;
  for (int k = 0; k < 2000; ++k) {
    motion.step(.95 * motion.stable_step());
    largest = std::max(largest, motion.work());
    error = std::max(error, std::abs(motion.kinetic_energy() + motion.strain_energy() - motion.work()));
  }
  EXPECT_LT(error, 1e-10 * largest);
}

TEST(FemDynamics, DampingTakesTwiceTheKineticEnergyTimesItsRate) {
  const auto problem = cantilever();
  const double first = std::sqrt(natural_frequencies(problem, options(2), 3).squares[0]);
  const double rate = .2 * first;
  const double dt = 2 * std::numbers::pi / first / 400;
  PlaneMotion motion(problem, options(2), TimeIntegration::newmark, rate);
  double lost = 0;
  double before = 0;
  for (int k = 0; k < 800; ++k) {
    motion.step(dt);
    const double kinetic = motion.kinetic_energy();
    lost += rate * dt * (before + kinetic); // 2 rate times the mean of both
    before = kinetic;
  }
  // The steps lose rate dt v M v with the mean velocity of a step, which differs by (omega dt)^2 / 4 of each mode's
  // part.
  const double measured = motion.work() - motion.kinetic_energy() - motion.strain_energy();
  EXPECT_NEAR(measured / lost, 1, 5e-3);
  EXPECT_GT(measured, .2 * std::abs(motion.work()));
}

TEST(FemDynamics, AStateThatIsTakenOverGoesOnWithTheSameBits) {
  for (const bool newmark : {true, false}) {
    const auto make = [&] {
      return PlaneMotion(cantilever(), options(1, newmark ? Mass::consistent : Mass::lumped),
                         newmark ? TimeIntegration::newmark : TimeIntegration::central_difference);
    };
    auto whole = make();
    auto part = make();
    auto other = make();
    const double dt = 1e-6;
    for (int k = 0; k < 40; ++k)
      whole.step(dt);
    for (int k = 0; k < 15; ++k)
      part.step(dt);
    const auto from = part.state();
    const auto to = other.state();
    for (std::size_t f = 0; f < from.size(); ++f)
      std::copy(from[f].second.begin(), from[f].second.end(), to[f].second.begin());
    other.adopt_state();
    for (int k = 0; k < 25; ++k)
      other.step(dt);
    EXPECT_EQ(other.steps(), whole.steps());
    EXPECT_EQ(tip(other), tip(whole));
    EXPECT_EQ(other.kinetic_energy(), whole.kinetic_energy());
  }
}

TEST(FemDynamics, BadInputIsRefused) {
  auto problem = plate(5, 3, Supports::none);
  EXPECT_THROW(natural_frequencies(problem, {.degree = 2, .densities = {}}, 3), InvalidInput);
  EXPECT_THROW(natural_frequencies(problem, {.degree = 2, .densities = {-1}}, 3), InvalidInput);
  EXPECT_THROW(natural_frequencies(problem, options(1), 20), InvalidInput);
  problem.boundary[0] = {{fixed, fixed}, batch([](Point) { return Vector{1e-3, 0}; }), {}};
  EXPECT_THROW(natural_frequencies(problem, options(2), 3), InvalidInput);
}

} // namespace
