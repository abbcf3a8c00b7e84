// Facts of a discretisation by elements against counts by hand.

#include "verification/fem_support.h"

#include "fem_reference/elasticity/element_facts.h"

#include <algorithm>

namespace {

using namespace fem_test;

PlaneProblem plate(unsigned nx, unsigned ny) {
  PlaneProblem problem{mesh::rectangle({0, 0}, {2, 1}, nx, ny), {Material(210e9, .3, PlaneModel::plane_stress)}, {}};
  for (int id = 0; id < 4; ++id)
    problem.boundary[id] = {};
  return problem;
}

} // namespace

TEST(FemFacts, OfSquaresAreThoseCountedByHand) {
  for (const int degree : {1, 2, 4}) {
    const auto problem = plate(9, 5); // 8 x 4 cells
    const auto facts = element_facts(problem, degree, 1);
    const std::size_t p = degree, n_nodes = (8 * p + 1) * (4 * p + 1);
    ASSERT_EQ(facts.row_start.size(), n_nodes + 1);
    EXPECT_EQ(facts.n_quadrature_points, 32 * (p + 1) * (p + 1));
    EXPECT_EQ(facts.functions_per_point, (p + 1) * (p + 1));
    EXPECT_NEAR(facts.area, 2, 1e-12);
    EXPECT_GT(facts.value_seconds, 0);
    // A tensor product: along a line of m cells, ends couple with p + 1 nodes, vertices with 2 p + 1, others with p
    // + 1.
    const auto on_line = [p](std::size_t m) { return (m - 1) * (2 * p + 1) + (m * (p - 1) + 2) * (p + 1); };
    EXPECT_EQ(facts.columns.size(), on_line(8) * on_line(4));
    for (std::size_t i = 0; i < n_nodes; ++i)
      EXPECT_TRUE(
          std::is_sorted(facts.columns.begin() + facts.row_start[i], facts.columns.begin() + facts.row_start[i + 1]));
  }
}

/// Sums of some hundred products, rounded: far above eps times their number it would be a defect.
TEST(FemFacts, TheStiffnessIsSymmetricToRounding) {
  for (const int degree : {1, 2, 3})
    EXPECT_LT(symmetry_defect(plate(9, 5), degree), 1e-13) << degree;
}

TEST(FemFacts, RefuseDegreesThatThereAreNot) {
  EXPECT_THROW(element_facts(plate(3, 3), 5), InvalidInput);
  EXPECT_THROW(symmetry_defect(plate(3, 3), 0), InvalidInput);
}
