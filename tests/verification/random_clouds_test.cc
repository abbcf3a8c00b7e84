// Properties of bases and weak forms on random clouds: what they reproduce, and what must not change a solution. The
// seeds are fixed; a failure prints its cloud.

#include "verification/random_clouds.h"

#include "meshless/basis/basis_table.h"
#include "meshless/elasticity/mixed_form/displacement_pressure.h"
#include "meshless/elasticity/strong_form/collocation.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "unit/basis/evaluate_basis.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace {

using namespace random_clouds;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

class RandomClouds : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomClouds, testing::Range<std::uint64_t>(1, 9));
class BasesOnRandomClouds : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, BasesOnRandomClouds, testing::Range<std::uint64_t>(1, 31));

/// What a sum over particles lacks of a derivative of a monomial about a point, over the sizes that are summed.
double defect(const evaluate_basis::Result<2> &result, int quantity, std::size_t q,
              const cloud::Particles<2> &particles, const Point2 &x, std::array<int, 2> derivative,
              std::array<int, 2> alpha) {
  const int degree = derivative[0] + derivative[1];
  const double exact = alpha != derivative ? 0 : alpha[0] == 2 || alpha[1] == 2 ? 2 : 1;
  double sum = 0;
  double size = 1;
  for (std::size_t j = 0; j < particles.size(); ++j) {
    const auto &xi = particles.position(j);
    const double term = std::pow(result.scale, degree) * result.values.row(quantity, j)[q] *
                        std::pow((xi[0] - x[0]) / result.scale, alpha[0]) *
                        std::pow((xi[1] - x[1]) / result.scale, alpha[1]);
    sum += term;
    size += std::abs(term);
  }
  return std::abs(sum - exact) / size;
}

/// Bases in the plane with the orders that they have, and the largest defect of all monomials that each reproduces.
TEST_P(BasesOnRandomClouds, are_partitions_of_unity_and_reproduce_polynomials) {
  RandomCloud cloud(GetParam());
  SCOPED_TRACE(cloud.text());
  const Motion motion{.cosine = 1, .sine = 0, .scale = std::pow(10, cloud.random().between(-3, 3)), .shift = {0, 0}};
  const auto particles = cloud.particles(motion);
  auto points = cloud.probes(12);
  for (auto &x : points)
    x = motion.place(x);
  int n_checked = 0;
  for (const auto &entry : basis::basis_table())
    for (int order = std::max(entry.lowest_order, 1); entry.highest_dimension >= 2 && order <= entry.highest_order;
         ++order) {
      SCOPED_TRACE(fmt::format("{}, order {}", entry.name, order));
      const auto shape = basis::make_basis<2>(entry.name, order, kernels::Gauss(order + 2));
      std::optional<evaluate_basis::Result<2>> result;
      try {
        result =
            evaluate_basis::at<2>(*shape, particles, points, {.value = true, .gradient = true, .hessian = order >= 2});
      } catch (const basis::SingularMomentMatrix &error) {
        EXPECT_GT(std::string(error.what()).size(), 20u);
        continue;
      }
      ++n_checked;
      constexpr std::array<int, 2> derivatives[] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
      for (int quantity = 0; quantity < (order >= 2 ? 6 : 3); ++quantity) {
        const int degree = std::min(shape->reproduced_degree(quantity == 0 ? 0 : quantity < 3 ? 1 : 2), order);
        double worst = 0;
        for (std::size_t q = 0; q < points.size(); ++q)
          for (int a = 0; a <= degree; ++a)
            for (int b = 0; a + b <= degree; ++b)
              worst =
                  std::max(worst, defect(*result, quantity, q, particles, points[q], derivatives[quantity], {a, b}));
        // A sum of some hundred terms; the system is refined, so that its condition enters squared.
        const double refined = epsilon / result->regularity.smallest_pivot_ratio;
        EXPECT_LT(worst, 250 * epsilon + refined * refined) << "quantity " << quantity;
      }
    }
  EXPECT_GE(n_checked, 10) << "most bases exist on most clouds";
}

enum class Form { strong, hybrid, consistent, mixed, weak1, weak2, heaviside };
constexpr Form forms[] = {Form::strong, Form::hybrid, Form::consistent, Form::mixed,
                          Form::weak1,  Form::weak2,  Form::heaviside};
const char *name_of(Form form) {
  constexpr const char *names[] = {"strong", "hybrid", "weak1 consistent", "mixed", "weak1", "weak2", "heaviside"};
  return names[static_cast<int>(form)];
}

struct Choice {
  Form form = Form::weak1;
  std::string basis = "ssph";
  int order = 2;
  int quadrature_points = 10;
};

struct Outcome {
  std::vector<Vector2> displacement; ///< at the probes, turned and scaled back
  double reciprocal_condition = 0;
};

Outcome solve(const Choice &choice, const RandomCloud &cloud, const std::vector<Point2> &probes,
              const Motion &motion = {}, const std::vector<std::size_t> &numbers = {}) {
  const auto problem = cloud.problem(motion);
  const auto particles = std::make_shared<const cloud::Particles<2>>(cloud.particles(motion, numbers));
  const auto make = [&](int order) -> std::shared_ptr<const basis::ShapeFunctions<2>> {
    return basis::make_basis<2>(choice.basis, order, kernels::Gauss(order + 2));
  };
  const double radius = choice.order > 2 ? .9 : 1;
  // An iteration ends at a backward error, not at rounding.
  const linear_algebra::SolverRequest direct = linear_algebra::SystemSolver::direct;
  const auto solution = [&] {
    if (choice.form == Form::strong)
      return strong_form::solve(problem, particles, make(choice.order), {}, direct);
    if (choice.form == Form::mixed) {
      mixed_form::Parameters mixed;
      mixed.test_function = kernels::Gauss(radius);
      mixed.test_radius = radius;
      mixed.subdomains = weak_form::Subdomains::shrunk;
      return mixed_form::solve(problem, particles, make(choice.order), make(choice.order - 1), mixed);
    }
    weak_form::Parameters weak;
    weak.solver = direct;
    weak.derivatives = choice.form == Form::weak2 ? DerivativeRule::differentiated : DerivativeRule::direct;
    weak.test_function = kernels::Gauss(radius);
    if (choice.form == Form::heaviside)
      weak.test_function.reset();
    weak.test_radius = radius;
    weak.subdomains = weak_form::Subdomains::shrunk;
    if (choice.form == Form::hybrid)
      weak.interior_rows = weak_form::InteriorRows::collocated;
    if (choice.form == Form::consistent)
      weak.integration = weak_form::IntegrationRule::consistent;
    weak.quadrature_points = choice.quadrature_points;
    weak.penalty = weak_form::moderate_penalty;
    weak.penalty_length = weak_form::PenaltyLength::smoothing;
    weak.characteristic_length = motion.scale;
    return weak_form::solve(problem, particles, make(choice.order), weak);
  }();
  std::vector<Point2> points;
  for (const auto &x : probes)
    points.push_back(motion.place(x));
  Outcome outcome{std::vector<Vector2>(points.size()), solution.reciprocal_condition};
  solution.displacement(points, outcome.displacement);
  for (auto &u : outcome.displacement) {
    u = motion.rotate_back(u);
    u = {u[0] / motion.scale, u[1] / motion.scale};
  }
  return outcome;
}

/// Of displacements of the size of 1.
double largest_difference(const Outcome &a, const Outcome &b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.displacement.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      largest = std::max(largest, std::abs(a.displacement[i][k] - b.displacement[i][k]));
  return largest;
}

/// What leaves a form as it is to rounding: any turn, if its points follow the boundary (collocated particles, discs
/// that the boundary cuts); a quarter turn, if there are equispaced points on whole discs or circles; else none, for
/// Gauss points in the angle start on the x1 axis.
enum class Turns { any, quarter, none };
Turns turns_of(Form form) {
  switch (form) {
  case Form::strong:
  case Form::hybrid:
    return Turns::any;
  case Form::consistent:
  case Form::mixed:
  case Form::heaviside:
    return Turns::quarter;
  case Form::weak1:
  case Form::weak2:
    break;
  }
  return Turns::none;
}

TEST_P(RandomClouds, solutions_do_not_depend_on_place_size_direction_and_numbering) {
  RandomCloud cloud(GetParam());
  SCOPED_TRACE(cloud.text());
  const auto probes = cloud.probes(40);
  const auto numbers = cloud.shuffled();
  const Motion turn = Motion::turn(cloud.random().between(0, 6));
  const Motion quarter{.cosine = 0, .sine = 1};
  const Motion larger_elsewhere{.scale = std::pow(10, cloud.random().between(-3, 3)),
                                .shift = {cloud.random().between(-3, 3), cloud.random().between(-3, 3)}};
  int n_solved = 0;
  for (const Form form : forms) {
    Choice choice{form};
    choice.order = cloud.whole(2, 3);
    const char *bases[] = {"ssph", "mls", "rkpm", "msph"};
    choice.basis = bases[cloud.whole(0, choice.order > 2 || form == Form::weak2 || form == Form::mixed ? 2 : 3)];
    SCOPED_TRACE(fmt::format("{}, {}, order {}", name_of(form), choice.basis, choice.order));
    try {
      const auto plain = solve(choice, cloud, probes);
      ++n_solved;
      for (const auto &u : plain.displacement)
        ASSERT_TRUE(std::isfinite(u[0]) && std::isfinite(u[1]));
      // Rounding of sums of as many terms as there are unknowns, times the condition number.
      const double rounding = 2 * static_cast<double>(cloud.size()) * epsilon / plain.reciprocal_condition;
      ASSERT_LT(rounding, 1e-8) << "or the test would not see much";
      EXPECT_LT(largest_difference(plain, solve(choice, cloud, probes, {}, numbers)), rounding) << "renumbered";
      EXPECT_LT(largest_difference(plain, solve(choice, cloud, probes, larger_elsewhere)), rounding) << "scaled, moved";
      const auto turns = turns_of(form);
      double allowed = rounding;
      if (turns == Turns::none) { // what quadrature leaves, as more points show
        Choice finer = choice;
        finer.quadrature_points = 14;
        allowed += largest_difference(plain, solve(finer, cloud, probes));
      }
      const auto turned = solve(choice, cloud, probes, turns == Turns::quarter ? quarter : turn);
      EXPECT_LT(largest_difference(plain, turned), allowed) << "turned";
    } catch (const basis::SingularMomentMatrix &error) {
      EXPECT_GT(std::string(error.what()).size(), 20u);
    } catch (const linear_algebra::SolveError &error) {
      EXPECT_GT(std::string(error.what()).size(), 20u);
    }
  }
  EXPECT_GE(n_solved, 6) << "most forms exist on most clouds";
}

/// The tests above must be able to fail.
TEST(TurnedCloud, differs_where_its_points_do) {
  RandomCloud cloud(1);
  const auto probes = cloud.probes(40);
  const Choice choice{Form::consistent};
  const auto plain = solve(choice, cloud, probes);
  EXPECT_GT(largest_difference(plain, solve(choice, cloud, probes, Motion::turn(.3))), 1e-10) << "no quarter turn";
}

} // namespace
