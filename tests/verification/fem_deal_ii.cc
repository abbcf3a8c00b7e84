// The finite-element reference against a second program that uses deal.II's own mesh, numbering, elements, mappings,
// assembly and solver: two implementations of one discrete problem must agree to rounding.

#include "deal_ii/plain_solver.h"
#include "fem_exact.h"

namespace {

using namespace fem_test;

/// Largest difference of the two programs at vertices, relative to the largest displacement.
double difference(const PlaneProblem &problem, int degree) {
  const auto other = plain_deal_ii::displacement_at_vertices(problem, static_cast<unsigned>(degree));
  const auto solution = solve(problem, {.degree = degree});
  std::vector<Vector> own(problem.mesh.vertices.size());
  solution.displacement(problem.mesh.vertices, own);
  double largest = 0, worst = 0;
  for (std::size_t v = 0; v < own.size(); ++v)
    for (std::size_t k = 0; k < 2; ++k) {
      largest = std::max(largest, std::abs(other[v][k]));
      worst = std::max(worst, std::abs(own[v][k] - other[v][k]));
    }
  return worst / largest;
}

/// A field that no element has, with its body force: u = (sin x1 cosh x2, cos x1 e^x2).
Exact not_polynomial(const Material &material) {
  const double lambda = material.lambda(), mu = material.mu();
  return {[](Point x) {
            return Vector{std::sin(x[0]) * std::cosh(x[1]), std::cos(x[0]) * std::exp(x[1])};
          },
          [=](Point x) {
            const double e11 = std::cos(x[0]) * std::cosh(x[1]), e22 = std::cos(x[0]) * std::exp(x[1]);
            const double gamma = std::sin(x[0]) * (std::sinh(x[1]) - std::exp(x[1]));
            return Stress{lambda * (e11 + e22) + 2 * mu * e11, lambda * (e11 + e22) + 2 * mu * e22, mu * gamma};
          },
          [=](Point x) {
            const double s = std::sin(x[0]), c = std::cos(x[0]);
            return Vector{(lambda + mu) * s * (std::cosh(x[1]) + std::exp(x[1])),
                          -(lambda + mu) * c * (std::sinh(x[1]) + std::exp(x[1]))};
          }};
}

// Condition numbers here are below 1e7; both programs factorise once: 1e-10 is three digits above eps * condition.
constexpr double rounding = 1e-10;

TEST(FemDealII, distorted_quadrilaterals) {
  const Material material(100, .3, PlaneModel::plane_strain);
  const auto problem = left_fixed(jittered({0, 0}, {2, 1}, 9, 6), material, not_polynomial(material));
  for (int degree = 1; degree <= 4; ++degree)
    EXPECT_LT(difference(problem, degree), rounding) << "Q" << degree;
}

TEST(FemDealII, distorted_triangles) {
  const Material material(100, .3, PlaneModel::plane_stress);
  // A field without body force: the rules that integrate one on triangles differ.
  const auto mesh = mesh::split_into_triangles(jittered({1.2, .3}, {3.2, 1.3}, 9, 6));
  const auto problem = left_fixed(mesh, material, kirsch(material, 1, 1));
  for (int degree = 1; degree <= 2; ++degree)
    EXPECT_LT(difference(problem, degree), rounding) << "P" << degree;
}

TEST(FemDealII, plate_with_a_hole_on_curved_cells) {
  const Material material(226.9e9, .33, PlaneModel::plane_strain);
  const auto exact = kirsch(material, 1, 1e9);
  PlaneProblem problem{mesh::quarter_plate_with_hole(1, 3, 6, 8, 8), {material}, {}};
  problem.boundary = {{0, condition(exact, fixed, loaded)},
                      {1, condition(exact, loaded, fixed)},
                      {2, condition(exact, loaded, loaded)},
                      {3, condition(exact, loaded, loaded)},
                      {4, {}}};
  for (int degree = 1; degree <= 4; ++degree)
    EXPECT_LT(difference(problem, degree), rounding) << "Q" << degree;
}

} // namespace
