// Assembly by several threads: the same rows to the last bit, errors of the first row at fault, and a setting that is
// checked.

#include "concave_samples.h"
#include "mixed_samples.h"

#include "meshless/parallel/threads.h"
#include "unit/linear_algebra/refusal.h"
#include "unit/parallel/other_threads.h"

#include <gtest/gtest.h>

#include <thread>

namespace {

using namespace plane_samples;

/// Sets the number for one scope.
class Threads {
public:
  explicit Threads(int n) { parallel::set_threads(n); }
  ~Threads() { parallel::set_threads(1); }
};

const Material steel(1, .3, PlaneModel::plane_stress);

template <typename Solve>
void expect_same_for_any_number(const Solve &solve) {
  const ParticleSolution alone = solve();
  EXPECT_GT(alone.seconds.basis + alone.seconds.assembly, 0);
  for (const int n : {2, 3, 8}) {
    const Threads threads(n);
    const ParticleSolution together = solve();
    ASSERT_EQ(together.coefficients().size(), alone.coefficients().size());
    EXPECT_EQ(together.nonzeros, alone.nonzeros);
    for (std::size_t i = 0; i < alone.coefficients().size(); ++i)
      ASSERT_EQ(together.coefficients()[i], alone.coefficients()[i]) << n << " threads, coefficient " << i;
    EXPECT_GT(together.seconds.basis + together.seconds.assembly, 0);
  }
}

/// A concave domain, so that every thread looks for what is visible.
TEST(Threads, weak_forms_are_the_same_to_the_last_bit) {
  const auto problem = problem_on({{quarter_plate(), steel}}, quadratic_displacement(steel), {0, 3});
  const auto particles = quarter_plate_cloud(15, .2, 3);
  for (const WeakForm form : {WeakForm::weak1, WeakForm::heaviside, WeakForm::hybrid})
    expect_same_for_any_number([&] { return solve(form, problem, particles, 2); });
}

TEST(Threads, the_mixed_form_is_the_same_to_the_last_bit) {
  const auto problem = problem_on({{quarter_plate(), steel}}, quadratic_displacement(steel), {0, 3});
  const auto particles = quarter_plate_cloud(11, .2, 3);
  expect_same_for_any_number([&] { return solve_mixed(problem, particles, {}); });
}

/// More than one thread does assemble: the body force is asked from several.
TEST(Threads, several_take_part) {
  if (std::thread::hardware_concurrency() < 2)
    GTEST_SKIP() << "one core";
  auto problem = problem_on({{quarter_plate(), steel}}, quadratic_displacement(steel), {0, 3});
  const auto force = problem.body_force;
  OtherThreads others;
  problem.body_force = [&](std::span<const Point2> points, std::span<Vector2> values) {
    others.take_part();
    force(points, values);
  };
  const auto particles = quarter_plate_cloud(21, .2, 3);
  solve(WeakForm::weak1, problem, particles, 2);
  EXPECT_EQ(others.n(), 0);
  const Threads threads(2);
  others.await();
  solve(WeakForm::weak1, problem, particles, 2);
  EXPECT_GT(others.n(), 0);
}

/// The first particle that cannot be served is named, whichever thread meets it.
TEST(Threads, the_first_fault_is_reported) {
  auto problem = problem_on({{quarter_plate(), steel}}, quadratic_displacement(steel), {0, 3});
  problem.body_force = [](std::span<const Point2> points, std::span<Vector2>) {
    throw std::runtime_error("first point " + std::to_string(points[0][0]) + " " + std::to_string(points[0][1]));
  };
  const auto particles = quarter_plate_cloud(15, .2, 3);
  const auto message = [&]() -> std::string {
    try {
      solve(WeakForm::weak1, problem, particles, 2);
    } catch (const std::runtime_error &error) {
      return error.what();
    }
    return {};
  };
  const std::string alone = message();
  EXPECT_NE(alone, "");
  const Threads threads(4);
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(message(), alone);
}

/// The second of two regions has four particles, too few: one of them is named by its number in the cloud.
TEST(Threads, a_particle_without_a_basis_is_named_by_its_number) {
  const domain::Boundary left(
      {{{0, 0}, {1, 0}, 0}, {{1, 0}, {1, 1}, interface_id}, {{1, 1}, {0, 1}, 0}, {{0, 1}, {0, 0}, 0}});
  const domain::Boundary right(
      {{{1, 0}, {2, 0}, 0}, {{2, 0}, {2, 1}, 0}, {{2, 1}, {1, 1}, 0}, {{1, 1}, {1, 0}, interface_id}});
  const auto problem = problem_on({{left, steel}, {right, steel}}, linear_displacement(), {0});
  auto points = sample_clouds::grid<2>({30, 30}, {0, 0}, {1, 1});
  std::vector<int> regions(points.size(), 0);
  for (const Point2 &x : {Point2{1, 0}, Point2{2, 0}, Point2{2, 1}, Point2{1, 1}}) {
    points.push_back(x);
    regions.push_back(1);
  }
  const auto message = [&](double h) {
    return refusal::message_of<basis::SingularMomentMatrix>([&] {
      solve(WeakForm::weak1, problem, {points, std::vector<double>(points.size(), h), {}, regions}, 2);
    });
  };
  const std::string alone = message(1. / 29);
  EXPECT_TRUE(alone.starts_with("particle 90")) << alone; // 900 ... 903
  const std::string none = message(1e-3);                 // no particle has neighbours, and many threads meet one
  const Threads threads(4);
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(message(1. / 29), alone);
    EXPECT_EQ(message(1e-3), none);
  }
}

TEST(Threads, none_is_refused) {
  EXPECT_THROW(parallel::set_threads(0), std::invalid_argument);
  EXPECT_EQ(parallel::threads(), 1);
}

} // namespace
