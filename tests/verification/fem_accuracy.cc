// Patch test, reproduction of polynomials, and orders of convergence of fem_reference.

#include "fem_support.h"

#include <numbers>

namespace {
using namespace fem_test;

class FemDegree : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Q, FemDegree, testing::Values(1, 2, 3, 4), testing::PrintToStringParamName());

// Machine precision with a factor 5000 for the condition number (up to 1e6), most of which the
// correction step takes away.
constexpr double rounding = 1e-12;

TEST_P(FemDegree, linear_patch_on_distorted_cells) {
  for (const auto model : {PlaneModel::plane_stress, PlaneModel::plane_strain}) {
    const Material material(210e9, .3, model);
    const auto exact = linear_field(material);
    const auto problem = left_fixed(jittered({0, 0}, {1, .7}, 6, 5), material, exact);
    const auto error = errors(solve(problem, {GetParam(), LinearSolver::cholesky}), exact, {0, 0}, {1, .7});
    EXPECT_LT(error.displacement, rounding);
    EXPECT_LT(error.stress, 10 * rounding); // a derivative: one factor 1 / h more
  }
}

TEST_P(FemDegree, rigid_motion_has_no_stress) {
  const Material material(1, .3, PlaneModel::plane_strain);
  const double angle = 1e-3;
  const Exact motion = {[angle](Point x) -> Vector {
                          return {.1 - angle * x[1], -.2 + angle * x[0]};
                        },
                        [](Point) {
                          return Stress{0, 0, 0};
                        }};
  const auto problem = left_fixed(jittered({0, 0}, {1, 1}, 5, 5), material, motion);
  const auto solution = solve(problem, {GetParam(), LinearSolver::cholesky});
  std::vector<Point> points;
  for (int k = 0; k < 200; ++k)
    points.push_back({std::fmod(.618034 * k, 1), (k + .5) / 200});
  std::vector<Stress> stress(points.size());
  solution.stress(points, stress);
  // E times the rounding of a displacement of .2 over a fraction of a cell.
  for (const auto &s : stress)
    for (const double component : s)
      EXPECT_LT(std::abs(component), 1e-12);
}

TEST(FemCantilever, cubic_elements_and_above_are_exact) {
  const Cantilever plate;
  const auto exact = plate.exact();
  for (const int degree : {3, 4})
    for (const double amount : {0., .25}) {
      const auto problem =
          left_fixed(jittered({0, 0}, {plate.length, plate.width}, 11, 4, amount), plate.material, exact);
      const auto error = errors(solve(problem, {degree, LinearSolver::cholesky}), exact, {0, 0}, {1, .2});
      EXPECT_LT(error.displacement, rounding) << degree << ' ' << amount;
      EXPECT_LT(error.stress, 100 * rounding) << degree << ' ' << amount;
    }
}

/// Orders between successive refinements of a grid of 2^k cells across.
std::vector<double> orders(const std::function<double(unsigned cells)> &error, unsigned coarsest, int levels) {
  std::vector<double> result;
  double previous = error(coarsest);
  for (int level = 1; level < levels; ++level) {
    const double current = error(coarsest << level);
    result.push_back(std::log2(previous / current));
    previous = current;
  }
  return result;
}

TEST(FemCantilever, orders_of_q1_and_q2) {
  const Cantilever plate;
  const auto exact = plate.exact();
  for (const int degree : {1, 2}) {
    const auto error = [&](unsigned cells) {
      const auto problem =
          left_fixed(mesh::rectangle({0, 0}, {1, .2}, 5 * cells + 1, cells + 1), plate.material, exact);
      return errors(solve(problem, {degree, LinearSolver::cholesky}), exact, {0, 0}, {1, .2}, 203).displacement;
    };
    for (const double order : orders(error, 4, 4))
      EXPECT_NEAR(order, degree + 1, .1) << "Q" << degree;
  }
}

/// Not a polynomial, with body force b = -div sigma, in either model.
Exact manufactured(const Material &material) {
  constexpr double k = std::numbers::pi;
  const double lambda = material.lambda();
  const double mu = material.mu();
  // u1 = sin(k x) cos(k y), u2 = x exp(y)
  return {[](Point x) -> Vector {
            return {std::sin(k * x[0]) * std::cos(k * x[1]), x[0] * std::exp(x[1])};
          },
          [material](Point x) {
            return hooke(material, k * std::cos(k * x[0]) * std::cos(k * x[1]), x[0] * std::exp(x[1]),
                         .5 * (-k * std::sin(k * x[0]) * std::sin(k * x[1]) + std::exp(x[1])));
          },
          [lambda, mu](Point x) -> Vector {
            // b = -(lambda + mu) grad div u - mu laplace u
            const double divergence_1 = -k * k * std::sin(k * x[0]) * std::cos(k * x[1]) + std::exp(x[1]);
            const double divergence_2 = -k * k * std::cos(k * x[0]) * std::sin(k * x[1]) + x[0] * std::exp(x[1]);
            const double laplace_1 = -2 * k * k * std::sin(k * x[0]) * std::cos(k * x[1]);
            const double laplace_2 = x[0] * std::exp(x[1]);
            return {-(lambda + mu) * divergence_1 - mu * laplace_1, -(lambda + mu) * divergence_2 - mu * laplace_2};
          }};
}

TEST_P(FemDegree, orders_on_a_manufactured_solution) {
  for (const auto model : {PlaneModel::plane_stress, PlaneModel::plane_strain}) {
    const Material material(2.5, .3, model);
    const auto exact = manufactured(material);
    std::vector<double> stress_errors;
    const auto error = [&](unsigned cells) {
      const auto problem = left_fixed(mesh::rectangle({0, 0}, {1, 1}, cells + 1, cells + 1), material, exact);
      const auto measured = errors(solve(problem, {GetParam(), LinearSolver::cholesky}), exact, {0, 0}, {1, 1}, 211);
      stress_errors.push_back(measured.stress);
      return measured.displacement;
    };
    for (const double order : orders(error, 8, 3))
      EXPECT_NEAR(order, GetParam() + 1, .1);
    EXPECT_NEAR(std::log2(stress_errors[1] / stress_errors[2]), GetParam(), .1);
  }
}

// Plane stress does not lock and has a finite lambda even at nu = 1/2.
TEST(FemMaterial, incompressible_plane_stress) {
  for (const double nu : {.499999, .5}) {
    Cantilever plate;
    plate.material = Material(226.9e9, nu, PlaneModel::plane_stress);
    EXPECT_NEAR(plate.material.lambda(), 226.9e9 * nu / (1 - nu * nu), 1e-15 * 226.9e9);
    const auto exact = plate.exact();
    const auto problem = left_fixed(jittered({0, 0}, {1, .2}, 11, 4), plate.material, exact);
    EXPECT_LT(errors(solve(problem, {3, LinearSolver::cholesky}), exact, {0, 0}, {1, .2}).displacement, rounding);
  }
}

TEST(FemMaterial, nearly_incompressible_plane_strain_patch) {
  const Material material(210e9, .499999, PlaneModel::plane_strain);
  const auto exact = linear_field(material);
  const auto problem = left_fixed(jittered({0, 0}, {1, .7}, 6, 5), material, exact);
  // lambda / mu = 5e5 multiplies the condition number.
  EXPECT_LT(errors(solve(problem, {2, LinearSolver::cholesky}), exact, {0, 0}, {1, .7}).displacement, 1e-8);
}

TEST(FemSolvers, cholesky_and_umfpack_agree) {
  const Cantilever plate;
  const auto exact = plate.exact();
  for (const int degree : {1, 2, 3, 4}) {
    const auto problem = left_fixed(jittered({0, 0}, {1, .2}, 21, 6), plate.material, exact);
    const auto a = solve(problem, {degree, LinearSolver::cholesky});
    const auto b = solve(problem, {degree, LinearSolver::umfpack});
    EXPECT_EQ(a.n_dofs(), 2U * (20U * degree + 1) * (5U * degree + 1));
    EXPECT_EQ(a.nonzeros(), b.nonzeros());
    const Exact as_exact = {[&a](Point x) {
                              Vector u{};
                              a.displacement({&x, 1}, {&u, 1});
                              return u;
                            },
                            [&a](Point x) {
                              Stress s{};
                              a.stress({&x, 1}, {&s, 1});
                              return s;
                            }};
    const auto difference = errors(b, as_exact, {0, 0}, {1, .2}, 31);
    EXPECT_LT(difference.displacement, rounding) << degree;
    for (const auto *solution : {&a, &b}) {
      EXPECT_LT(solution->backward_error(), 1e-14); // a backward stable direct solver
      EXPECT_LT(solution->relative_residual(), 1e-10);
    }
  }
}

// The residual by cells knows the strain to rounding, so one correction gains at least a digit on the
// error of the factorisation, which here is the condition number times machine precision.
TEST(FemSolvers, one_correction_gains_digits) {
  const Cantilever plate;
  const auto exact = plate.exact();
  const auto problem = left_fixed(jittered({0, 0}, {1, .2}, 41, 9), plate.material, exact);
  const auto error = [&](int corrections) {
    return errors(solve(problem, {4, LinearSolver::cholesky, corrections}), exact, {0, 0}, {1, .2}).displacement;
  };
  const double corrected = error(1);
  EXPECT_LT(corrected, 1e-13);
  EXPECT_LT(corrected, .1 * error(0));
}

/// The estimate is what the last correction has changed: above the error that is left, and no more than what there was
/// without it.
TEST(FemSolvers, estimate_their_algebraic_error) {
  const Cantilever plate;
  const auto exact = plate.exact();
  const auto problem = left_fixed(jittered({0, 0}, {1, .2}, 41, 9), plate.material, exact);
  EXPECT_FALSE(solve(problem, {4, LinearSolver::cholesky, 0}).algebraic_error());
  // The elements hold the exact cubic: all errors are the solver's.
  const auto error = [&](const PlaneSolution &solution) {
    return errors(solution, exact, {0, 0}, {1, .2}).displacement;
  };
  for (const auto solver : {LinearSolver::cholesky, LinearSolver::umfpack}) {
    const auto corrected = solve(problem, {4, solver, 1});
    ASSERT_TRUE(corrected.algebraic_error());
    EXPECT_GT(*corrected.algebraic_error(), error(corrected));
    // Both norms are relative ones of the same displacement, by nodes and by points.
    EXPECT_LT(*corrected.algebraic_error(), 10 * error(solve(problem, {4, solver, 0})));
  }
}

TEST(FemSolvers, repeat_bit_for_bit) {
  const Cantilever plate;
  const auto exact = plate.exact();
  const auto problem = left_fixed(jittered({0, 0}, {1, .2}, 21, 6), plate.material, exact);
  const Point x = {.77, .13};
  Vector first{};
  Vector second{};
  solve(problem).displacement({&x, 1}, {&first, 1});
  solve(problem).displacement({&x, 1}, {&second, 1});
  EXPECT_EQ(first, second);
}
} // namespace
