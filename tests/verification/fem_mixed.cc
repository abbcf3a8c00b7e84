// Taylor-Hood elements: patch tests and orders up to nu = 1/2, Cook's membrane, and pressures that jump between
// regions.

#include "fem_exact.h"
#include "fem_support.h"

#include <numbers>

namespace {
using namespace fem_test;

constexpr double quarter = std::numbers::pi / 2;

Options taylor_hood() {
  Options options;
  options.mixed = true;
  return options;
}

TEST(TaylorHood, linear_patch_on_distorted_cells) {
  // Rounding times the condition of the mixed system, 1e4.
  for (const double nu : {.3, .4999}) {
    const Material material(210e9, nu, PlaneModel::plane_strain);
    const auto exact = linear_field(material);
    const auto problem = left_fixed(jittered({0, 0}, {1, .7}, 6, 5), material, exact);
    const auto solution = solve(problem, taylor_hood());
    const auto error = errors(solution, exact, {0, 0}, {1, .7});
    EXPECT_LT(error.displacement, 1e-11) << nu;
    EXPECT_LT(error.stress, 1e-10) << nu;
    const std::vector<Point> at{{.3, .2}};
    std::vector<double> pressure(1);
    solution.pressure(at, pressure);
    EXPECT_NEAR(pressure[0] / (material.lambda() * 6e-3), 1, 1e-10); // div u = .002 + .004
  }
}

TEST(TaylorHood, cook_on_64_by_64_cells) {
  // Computed independently for the same elements and mesh: u2(48, 52) to the digits given.
  const std::pair<double, double> tips[] = {{.3, 21.94}, {.49, 18.73}, {.4999, 18.50}, {.499999, 18.50}};
  constexpr unsigned n = 65;
  std::vector<Point> vertices;
  for (unsigned j = 0; j < n; ++j)
    for (unsigned i = 0; i < n; ++i) {
      const double s = i / (n - 1.), t = j / (n - 1.);
      vertices.push_back({48 * s, (1 - t) * 44 * s + t * (44 + 16 * s)});
    }
  for (const auto &[nu, tip] : tips) {
    const auto zero = batch([](Point) { return Vector{0, 0}; });
    PlaneProblem problem{mesh::rectangle(vertices, n, n), {Material(1, nu, PlaneModel::plane_strain)}, {}};
    problem.boundary = {{0, {{fixed, fixed}, zero, {}}}, {1, {}}, {2, {}}, {3, {}}};
    problem.boundary[1].traction = [](std::span<const Point>, std::span<const Vector>, std::span<Vector> t) {
      std::fill(t.begin(), t.end(), Vector{0, 1. / 16});
    };
    const auto solution = solve(problem, taylor_hood());
    const std::vector<Point> at{{48, 52}};
    std::vector<Vector> u(1);
    solution.displacement(at, u);
    EXPECT_NEAR(u[0][1], tip, .0051) << nu;
    EXPECT_LT(imbalance(solution), 1e-8) << nu;
  }
}

TEST(TaylorHood, pressed_rings_do_not_depend_on_nu_and_pressures_jump_between_materials) {
  for (const double nu : {.49, .499999}) {
    const Material soft(70e9, nu, PlaneModel::plane_strain), steel(210e9, .3, PlaneModel::plane_strain);
    const auto exact = lame(pressed_double_ring(soft, steel, 1, 1.4, 2, 5e6));
    const auto sampling = sample_ring(1, 2, quarter);
    double last = 0;
    for (const unsigned n : {8U, 16U}) {
      const std::vector<mesh::RingLayer> layers{{1.4, n / 4}, {2, n / 4}};
      const auto solution =
          solve(ring_problem(mesh::ring_sector(1, layers, n, quarter), {soft, steel}, exact), taylor_hood());
      const auto found = norms(solution, exact, sampling);
      EXPECT_LT(found.stress, .01) << nu;
      if (last > 0) // order 3, not yet asymptotic
      {
        EXPECT_GT(std::log2(last / found.displacement), 2.6) << nu;
      }
      last = found.displacement;
    }
    EXPECT_LT(last, 5e-5);
  }
}

TEST(TaylorHood, other_degrees_and_questions_for_a_pressure_are_refused) {
  const Material material(1, .3, PlaneModel::plane_strain);
  const auto problem = left_fixed(jittered({0, 0}, {1, .7}, 4, 4), material, linear_field(material));
  auto options = taylor_hood();
  options.degree = 3;
  EXPECT_THROW(solve(problem, options), InvalidInput);
  const std::vector<Point> at{{.3, .2}};
  std::vector<double> pressure(1);
  EXPECT_THROW(solve(problem).pressure(at, pressure), InvalidInput);
}
} // namespace
