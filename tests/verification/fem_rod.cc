// The elastic rod of fem_reference: patch tests, exactness at vertices, orders, spectra against closed forms.

#include "fem_reference/rod/elastic_rod.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace {
using namespace fem_reference;
using namespace fem_reference::rod;
constexpr double pi = std::numbers::pi;

std::vector<double> uniform(unsigned n, double length = 1, double origin = 0) {
  std::vector<double> vertices(n);
  for (unsigned i = 0; i < n; ++i)
    vertices[i] = origin + length * i / (n - 1);
  return vertices;
}

std::vector<double> graded(unsigned n) {
  auto vertices = uniform(n);
  for (double &x : vertices)
    x *= (1 + x) / 2;
  return vertices;
}

Field field(const std::function<double(double)> &function) {
  return [function](std::span<const double> points, std::span<double> values) {
    for (std::size_t k = 0; k < points.size(); ++k)
      values[k] = function(points[k]);
  };
}

/// The rod of Asprone et al. (2010), section 5.2: -u'' = e^x, u(0) = 0, u'(1) = 0.
Rod exponential_rod(std::vector<double> vertices) {
  Rod rod{.vertices = std::move(vertices), .body_force = field([](double x) { return std::exp(x); })};
  rod.ends[1].kind = EndKind::traction;
  return rod;
}
double exponential_solution(double x) { return -std::exp(x) + std::numbers::e * x + 1; }

double displacement_error(const Solution &solution, const std::vector<double> &points) {
  std::vector<double> values(points.size());
  solution.displacement(points, values);
  double largest = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    largest = std::max(largest, std::abs(values[k] - exponential_solution(points[k])));
  return largest;
}

class FemRod : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Q, FemRod, testing::Values(1, 2, 3), testing::PrintToStringParamName());

TEST_P(FemRod, a_uniform_strain_is_exact_far_from_the_origin_and_in_other_units) {
  // Steel, 1 mm long, 1 km away: the places themselves have lost six digits.
  Rod rod{.vertices = uniform(8, 1e-3, 1000), .youngs_modulus = 210e9};
  rod.ends = {EndCondition{EndKind::displacement, 2e-6}, EndCondition{EndKind::traction, 210e6}};
  const auto solution = solve(rod, {GetParam(), Mass::lumped});
  const std::vector<double> points{rod.vertices[0], rod.vertices[3], 1000.00077, rod.vertices[7]};
  std::vector<double> u(4), strain(4);
  solution.displacement(points, u);
  solution.strain(points, strain);
  const double place = 1000 * std::numeric_limits<double>::epsilon();
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(u[k], 2e-6 + 1e-3 * (points[k] - 1000), 10 * 1e-3 * place);
    // Cells of 1.4e-4 m are known to `place`.
    EXPECT_NEAR(strain[k], 1e-3, 1e-3 * 10 * place / 1.4e-4);
  }
  EXPECT_LT(solution.backward_error(), 1e-15);
}

// A Green's function of the rod is piecewise linear with its kink at the vertex, so that it lies in the space of every
// degree (Tong 1969).
TEST_P(FemRod, vertices_are_exact_on_any_mesh) {
  const auto vertices = graded(12);
  EXPECT_LT(displacement_error(solve(exponential_rod(vertices), {GetParam(), Mass::lumped}), vertices), 1e-13);
}

TEST_P(FemRod, refinement_keeps_rounding_small_on_a_fine_mesh) {
  // Condition 6e6 for cubic elements: without the residual by cells 3e-10 of the displacement were lost. What remains
  // are 640 cells with the rounding of their two values.
  const auto vertices = uniform(641);
  EXPECT_LT(displacement_error(solve(exponential_rod(vertices), {GetParam(), Mass::lumped}), vertices),
            640 * 4 * std::numeric_limits<double>::epsilon());
}

TEST_P(FemRod, order_between_vertices_is_the_degree_plus_one) {
  const int degree = GetParam();
  std::vector<double> points(997);
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k] = (static_cast<double>(k) + .5) / 997;
  double previous = 0;
  for (const unsigned n : {5U, 9U, 17U, 33U}) {
    const double error = displacement_error(solve(exponential_rod(uniform(n)), {degree, Mass::lumped}), points);
    if (previous > 0) { // pre-asymptotic by O(h)
      EXPECT_NEAR(std::log2(previous / error), degree + 1, .12);
    }
    previous = error;
  }
}

TEST_P(FemRod, an_interpolant_reproduces_its_degree_with_derivatives) {
  const int p = GetParam();
  const auto vertices = graded(6);
  const auto solution = interpolate(vertices, field([p](double x) { return std::pow(x, p) - 2 * x; }), p);
  const std::vector<double> points{0, .123, .5, vertices[3], 1};
  std::vector<double> u(5), strain(5);
  solution.displacement(points, u);
  solution.strain(points, strain);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(u[k], std::pow(points[k], p) - 2 * points[k], 1e-14);
    EXPECT_NEAR(strain[k], p * std::pow(points[k], p - 1) - 2, 1e-12); // one factor 1 / h
  }
  const auto second = solution.second_derivatives_at_cell_ends();
  ASSERT_EQ(second.size(), 10U);
  for (std::size_t k = 0; k < second.size(); ++k) {
    const double x = vertices[k / 2 + k % 2];
    EXPECT_NEAR(second[k], p > 1 ? p * (p - 1) * std::pow(x, p - 2) : 0, 1e-10); // two factors 1 / h
  }
}

Rod fixed_rod(unsigned n) { return {.vertices = uniform(n)}; }

TEST(FemRodFrequencies, linear_elements_have_the_closed_forms) {
  constexpr unsigned n_vertices = 100;
  constexpr double h = 1. / (n_vertices - 1);
  const auto lumped = natural_frequencies(fixed_rod(n_vertices), {1, Mass::lumped});
  const auto consistent = natural_frequencies(fixed_rod(n_vertices), {1, Mass::consistent});
  ASSERT_EQ(lumped.omega.size(), n_vertices - 2);
  ASSERT_EQ(consistent.omega.size(), n_vertices - 2);
  for (unsigned n = 1; n <= n_vertices - 2; ++n) {
    const double c = std::cos(pi * n * h);
    // Rounding of the largest eigenvalue, 1e4 times the smallest.
    EXPECT_NEAR(lumped.omega[n - 1] / (2 / h * std::sin(pi * n * h / 2)), 1, 1e-10) << n;
    EXPECT_NEAR(consistent.omega[n - 1] / (std::sqrt(6 * (1 - c) / (2 + c)) / h), 1, 1e-10) << n;
  }
}

TEST(FemRodFrequencies, consistent_mass_bounds_from_above_and_a_finer_space_is_better) {
  const auto coarse = natural_frequencies(fixed_rod(11), {2, Mass::consistent});
  const auto fine = natural_frequencies(fixed_rod(21), {2, Mass::consistent});
  for (unsigned n = 1; n <= coarse.omega.size(); ++n) {
    EXPECT_GE(fine.omega[n - 1], pi * n * (1 - 1e-12)); // Rayleigh's quotient
    EXPECT_GE(coarse.omega[n - 1], fine.omega[n - 1] * (1 - 1e-12));
  }
}

TEST_P(FemRod, first_frequency_has_twice_the_degree_as_order) {
  const int degree = GetParam();
  for (const Mass mass : {Mass::lumped, Mass::consistent}) {
    double previous = 0;
    for (const unsigned n : {3U, 5U, 9U}) {
      const auto frequencies = natural_frequencies(fixed_rod(n), {degree, mass});
      const double error = std::abs(frequencies.omega[0] / pi - 1);
      if (previous > 0) { // pre-asymptotic by O(h^2)
        EXPECT_NEAR(std::log2(previous / error), 2 * degree, .25) << n;
      }
      previous = error;
    }
  }
}

TEST(FemRodFrequencies, units_and_a_free_end) {
  Rod steel{.vertices = uniform(65, 2, -7), .youngs_modulus = 210e9, .density = 7850};
  steel.ends[1].kind = EndKind::traction;
  const auto frequencies = natural_frequencies(steel, {3, Mass::consistent});
  const double wave_speed = std::sqrt(210e9 / 7850);
  for (unsigned n = 1; n < 6; ++n)
    EXPECT_NEAR(frequencies.omega[n - 1] / ((n - .5) * pi * wave_speed / 2), 1, 1e-9); // h^6, and rounding as above
}

template <typename Function>
std::string refusal(const Function &function) {
  try {
    function();
  } catch (const InvalidInput &error) {
    return error.what();
  }
  return {};
}

TEST(FemRodRefusals, what_cannot_be_solved_is_named) {
  const auto expect = [](const Rod &rod, const Options &options, const std::string &part) {
    const std::string message = refusal([&] { solve(rod, options); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const Rod good = fixed_rod(5);
  const auto with = [&](auto change) {
    Rod rod = good;
    change(rod);
    return rod;
  };
  expect(with([](Rod &r) { r.vertices = {0}; }), {}, "a rod of 1 vertices");
  expect(with([](Rod &r) { r.vertices[2] = r.vertices[1]; }), {}, "vertex 2");
  expect(with([](Rod &r) { r.vertices[4] = NAN; }), {}, "finite place");
  expect(with([](Rod &r) { r.youngs_modulus = 0; }), {}, "Young's modulus is 0");
  expect(with([](Rod &r) { r.density = -1; }), {}, "density is -1");
  expect(with([](Rod &r) { r.ends[0].kind = r.ends[1].kind = EndKind::traction; }), {}, "move freely");
  expect(with([](Rod &r) { r.ends[1].value = INFINITY; }), {}, "finite number");
  expect(good, {4, Mass::lumped}, "degree 4");
  EXPECT_NE(refusal([] { natural_frequencies(fixed_rod(2)); }).find("no free unknown"), std::string::npos);
  const auto solution = solve(good);
  const std::vector<double> outside{1.5};
  std::vector<double> value(1);
  EXPECT_NE(refusal([&] { solution.displacement(outside, value); }).find("outside the rod"), std::string::npos);
}
} // namespace
