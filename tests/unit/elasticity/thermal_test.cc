// Thermal expansion by particles: free bodies are without stress, held ones have the stress of theory, and a
// temperature that is no polynomial converges.

#include "unit/elasticity/plane_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace plane_samples;

const Point2 low{0, 0};
const Point2 high{2, 1};
constexpr double rise = 1e-3; ///< free strain

/// Twice: plane stress and plane strain.
class Thermal : public testing::TestWithParam<std::tuple<Method, PlaneModel>> {
protected:
  Method method() const { return std::get<0>(GetParam()); }
  Material material() const { return {210, 0.3, std::get<1>(GetParam())}; }
  /// In plane strain the thickness is held and its part comes out in the plane: (1 + nu) times the free strain.
  double in_plane() const { return std::get<1>(GetParam()) == PlaneModel::plane_strain ? 1.3 : 1; }
  /// Theory's, not the code's: E / (1 - nu), E / (1 - 2 nu).
  double held() const { return 210 / (std::get<1>(GetParam()) == PlaneModel::plane_strain ? 0.4 : 0.7); }

  PlaneProblem problem(const Exact &exact, const Kinds &kinds, const std::function<double(Point2)> &strain) const {
    auto result = rectangle_problem(low, high, material(), exact, kinds);
    result.thermal_strain = [strain](std::span<const Point2> points, std::span<double> values) {
      std::transform(points.begin(), points.end(), values.begin(), strain);
    };
    // The traction of all stress, the thermal part included.
    const double modulus = held();
    for (auto &[id, condition] : result.conditions)
      condition.traction = [=, elastic = condition.traction](std::span<const Point2> points,
                                                             std::span<const Vector2> normals,
                                                             std::span<Vector2> values) {
        elastic(points, normals, values);
        for (std::size_t i = 0; i < points.size(); ++i)
          for (std::size_t k = 0; k < 2; ++k)
            values[i][k] -= modulus * strain(points[i]) * normals[i][k];
      };
    return result;
  }

  /// Largest errors over points inside.
  struct Largest {
    double displacement = 0;
    double stress = 0;
  };
  Largest largest(const PlaneProblem &statement, const Exact &exact, const std::function<double(Point2)> &strain, int n,
                  int order = 2) const {
    auto points = sample_clouds::grid<2>({2 * n - 1, n}, low, high);
    const cloud::Particles<2> particles(points, std::vector<double>(points.size(), 1.0 / (n - 1)));
    const auto solution =
        solve(method(), statement, particles, {.order = order, .support = order + 2.0, .characteristic_length = 2});
    std::vector<Point2> inside;
    for (int i = 0; i < 17; ++i)
      for (int j = 0; j < 9; ++j)
        inside.push_back({2 * (i + 0.41) / 17, (j + 0.47) / 9});
    std::vector<Vector2> u(inside.size());
    std::vector<Stress2> s(inside.size());
    solution.displacement(inside, u);
    solution.stress(inside, s);
    Largest result;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const auto expected = exact.displacement(inside[i]);
      auto stress = stress_of(material(), exact.gradient(inside[i]));
      stress[0] -= held() * strain(inside[i]);
      stress[1] -= held() * strain(inside[i]);
      for (std::size_t k = 0; k < 2; ++k)
        result.displacement = std::max(result.displacement, std::abs(u[i][k] - expected[k]));
      for (std::size_t k = 0; k < 3; ++k)
        result.stress = std::max(result.stress, std::abs(s[i][k] - stress[k]));
    }
    return result;
  }
};

TEST_P(Thermal, AFreePlateExpandsWithoutStress) {
  const double e = rise * in_plane();
  const Exact exact{[=](Point2 x) {
                      return Vector2{e * x[0], e * x[1]};
                    },
                    [=](Point2) {
                      return std::array{e, 0.0, 0.0, e};
                    },
                    {}};
  const auto strain = [](Point2) { return rise; };
  const auto errors = largest(problem(exact, left_fixed, strain), exact, strain, 7);
  // Of the quadrature of the subdomains at nG = 10, about 1e-10, times the condition of the penalty.
  EXPECT_LT(errors.displacement, 1e-7 * rise);
  EXPECT_LT(errors.stress, 1e-6 * rise * held());
  // The exact stress is zero by theory: sigma = D eps - E / (1 - nu) eps_0.
  EXPECT_NEAR((material().axial() + material().coupling()) * e, held() * rise, 1e-12 * held() * rise);
}

TEST_P(Thermal, ALinearTemperatureBendsAPlateWithoutStress) {
  // eps_0 = g y has u = e (x y, -x^2 / 2 + y^2 / 2), compatible: no stress in a body that is held nowhere but as it
  // moves.
  const double e = rise * in_plane();
  const Exact exact{[=](Point2 x) {
                      return Vector2{e * x[0] * x[1], e * (x[1] * x[1] - x[0] * x[0]) / 2};
                    },
                    [=](Point2 x) {
                      return std::array{e * x[1], e * x[0], -e * x[0], e * x[1]};
                    },
                    {}};
  const auto strain = [](Point2 x) { return rise * x[1]; };
  const auto errors = largest(problem(exact, left_fixed, strain), exact, strain, 7);
  EXPECT_LT(errors.displacement, 1e-6 * rise);
  EXPECT_LT(errors.stress, 1e-5 * rise * held());
}

TEST_P(Thermal, AHeldPlateHasTheStressOfTheory) {
  const Exact exact{[](Point2) { return Vector2{}; }, [](Point2) { return std::array<double, 4>{}; }, {}};
  const auto strain = [](Point2) { return rise; };
  const auto errors = largest(problem(exact, all_fixed, strain), exact, strain, 7);
  EXPECT_LT(errors.displacement, 1e-7 * rise);
  EXPECT_LT(errors.stress, 1e-6 * rise * held());
}

TEST_P(Thermal, ATemperatureThatIsNoPolynomialConverges) {
  const Exact exact{[](Point2 x) {
                      return Vector2{rise * std::sin(x[0]) * x[1], rise * std::cos(x[0] + x[1])};
                    },
                    [](Point2 x) {
                      const double s = -rise * std::sin(x[0] + x[1]);
                      return std::array{rise * std::cos(x[0]) * x[1], rise * std::sin(x[0]), s, s};
                    },
                    {}};
  const auto strain = [](Point2 x) { return rise * std::exp(x[0] / 2) * std::cos(2 * x[1]); };
  auto statement = problem(exact, left_fixed, strain);
  const Material d = material();
  const double modulus = held();
  // b = - sigma_ij,j, by hand.
  statement.body_force = field([=](Point2 x) {
    const double c = -rise * std::cos(x[0] + x[1]); // derivatives of the slopes of u2
    const double u1_xx = -rise * std::sin(x[0]) * x[1];
    const double u1_xy = rise * std::cos(x[0]);
    const double e_x = rise * std::exp(x[0] / 2) * std::cos(2 * x[1]) / 2;
    const double e_y = -2 * rise * std::exp(x[0] / 2) * std::sin(2 * x[1]);
    return Vector2{-(d.axial() * u1_xx + d.coupling() * c + d.shear() * c) + modulus * e_x,
                   -(d.coupling() * u1_xy + d.axial() * c + d.shear() * (u1_xy + c)) + modulus * e_y};
  });
  const auto coarse = largest(statement, exact, strain, 7);
  const auto fine = largest(statement, exact, strain, 13);
  // Collocation takes the slope of the temperature from the basis, whose error of second order acts as a load.
  EXPECT_LT(fine.displacement, (method() == Method::strong ? 2 : 0.01) * rise);
  // Second order, down to the penalty's 1e-3; near edges the largest error of the stress falls by one order less.
  EXPECT_LT(fine.displacement, std::max(coarse.displacement / 2.5, 1e-3 * rise));
  EXPECT_LT(fine.stress, coarse.stress / 1.5);
}

INSTANTIATE_TEST_SUITE_P(Methods, Thermal,
                         testing::Combine(testing::Values(Method::strong, Method::weak1, Method::weak2),
                                          testing::Values(PlaneModel::plane_stress, PlaneModel::plane_strain)),
                         [](const auto &instance) {
                           return name_of(std::get<0>(instance.param)) +
                                  (std::get<1>(instance.param) == PlaneModel::plane_stress ? "_stress" : "_strain");
                         });

} // namespace
