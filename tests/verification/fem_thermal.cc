// Thermal expansion by the reference: free, held, and a temperature that is no polynomial.

#include "verification/fem_support.h"

#include <cmath>

namespace {

using namespace fem_test;

constexpr double rise = 1e-3; ///< free strain

struct Case {
  PlaneModel model;
  double held;     ///< E / (1 - nu), E / (1 - 2 nu) by theory, for E = 210, nu = .3
  double in_plane; ///< 1 + nu in plane strain, where the thickness is held
};
const Case cases[] = {{PlaneModel::plane_stress, 210 / .7, 1}, {PlaneModel::plane_strain, 210 / .4, 1.3}};

using Strain = std::function<double(Point)>;

ScalarField scalar(const Strain &f) {
  return [f](std::span<const Point> points, std::span<double> values) {
    for (std::size_t k = 0; k < points.size(); ++k)
      values[k] = f(points[k]);
  };
}

TEST(FemThermal, FreeExpansionIsWithoutStressAndHeldOneHasTheoryStress) {
  for (const auto &[model, held, in_plane] : cases)
    for (int degree = 1; degree <= 4; ++degree)
      for (const bool triangles : {false, true}) {
        const Material material(210, .3, model);
        auto mesh = jittered({0, 0}, {2, 1}, 5, 4);
        if (triangles)
          mesh = mesh::split_into_triangles(mesh);
        const double e = rise * in_plane;
        const Exact free{[=](Point x) { return Vector{e * x[0], e * x[1]}; }, [](Point) { return Stress{}; }};
        auto problem = left_fixed(mesh, material, free);
        problem.thermal_strain = scalar([](Point) { return rise; });
        const auto found = solve(problem, {.degree = degree});
        const std::vector<Point> points{{.3, .2}, {1.1, .6}, {1.9, .9}};
        std::vector<Vector> u(3);
        std::vector<Stress> s(3), recovered(3);
        found.displacement(points, u);
        found.stress(points, s);
        found.recovered_stress(points, recovered);
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t d = 0; d < 3; ++d) {
            if (d < 2) {
              EXPECT_NEAR(u[k][d], e * points[k][d], 1e-12 * rise);
            }
            EXPECT_NEAR(s[k][d], 0, 1e-10 * rise * held);
            EXPECT_NEAR(recovered[k][d], 0, 1e-10 * rise * held);
          }
        for (auto &[id, condition] : problem.boundary)
          condition = {{fixed, fixed}, batch([](Point) { return Vector{}; }), {}};
        solve(problem, {.degree = degree}).stress(points, s);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(s[k][0], -rise * held, 1e-11 * rise * held);
          EXPECT_NEAR(s[k][1], -rise * held, 1e-11 * rise * held);
          EXPECT_NEAR(s[k][2], 0, 1e-11 * rise * held);
        }
      }
}

TEST(FemThermal, ATemperatureThatIsNoPolynomialConvergesAsTheTheoryOfElementsSays) {
  const Strain strain = [](Point x) { return rise * std::exp(x[0] / 2) * std::cos(2 * x[1]); };
  for (const auto &[model, held, in_plane] : cases) {
    const Material material(210, .3, model);
    const double lambda = material.lambda();
    const double mu = material.mu();
    Exact exact;
    exact.displacement = [](Point x) { return Vector{rise * std::sin(x[0]) * x[1], rise * std::cos(x[0] + x[1])}; };
    exact.stress = [=](Point x) {
      const double e11 = rise * std::cos(x[0]) * x[1];
      const double e22 = -rise * std::sin(x[0] + x[1]);
      const double gamma = rise * std::sin(x[0]) - rise * std::sin(x[0] + x[1]);
      const double thermal = held * strain(x);
      return Stress{lambda * (e11 + e22) + 2 * mu * e11 - thermal, lambda * (e11 + e22) + 2 * mu * e22 - thermal,
                    mu * gamma};
    };
    // b = - sigma_ij,j by central differences of the stress: their error is 1e-10 of the slopes.
    exact.body_force = [stress = exact.stress](Point x) {
      const double h = 1e-5;
      const auto right = stress({x[0] + h, x[1]}), left = stress({x[0] - h, x[1]});
      const auto up = stress({x[0], x[1] + h}), down = stress({x[0], x[1] - h});
      return Vector{-(right[0] - left[0] + up[2] - down[2]) / (2 * h),
                    -(right[2] - left[2] + up[1] - down[1]) / (2 * h)};
    };
    for (int degree = 1; degree <= 3; ++degree) {
      Errors previous{};
      for (const unsigned n : {5U, 9U}) {
        auto problem = left_fixed(mesh::rectangle({0, 0}, {2, 1}, 2 * n - 1, n), material, exact);
        problem.thermal_strain = scalar(strain);
        const auto found = errors(solve(problem, {.degree = degree}), exact, {0, 0}, {2, 1});
        if (n == 9) {
          EXPECT_GT(std::log2(previous.displacement / found.displacement), degree + .7) << degree;
          EXPECT_GT(std::log2(previous.stress / found.stress), degree - .3) << degree;
        }
        previous = found;
      }
    }
  }
}

TEST(FemThermal, AnExpansionThatIsNotFiniteIsRefused) {
  const Exact nothing{[](Point) { return Vector{}; }, [](Point) { return Stress{}; }};
  auto problem =
      left_fixed(mesh::rectangle({0, 0}, {2, 1}, 3, 3), Material(210, .3, PlaneModel::plane_stress), nothing);
  problem.thermal_strain = scalar([](Point) { return NAN; });
  EXPECT_THROW(solve(problem, {}), InvalidInput);
}

} // namespace
