// What cells do by themselves or as asked so that they have a solution: a lower order, larger supports, another solver,
// another factorisation. Each is counted.

#include "verification/scene_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace scene_runs;

std::string scene_text(const std::string &benchmark, const std::string &level, const std::string &method) {
  return fmt::format("schema = 1\ntitle = \"recoveries\"\nbenchmark = \"{}\"\n[[method]]\n{}\n[study]\nlevels = "
                     "[{}]\nrepeats = 1\n",
                     benchmark, method, level);
}

reports::Cell cell_of(const std::string &benchmark, const std::string &level, const std::string &method) {
  return run(read(scene_text(benchmark, level, method))).at(0);
}

reports::Cell strip(const std::string &method, const std::string &level = "\"16x4\"") {
  return cell_of("cantilever", level, method);
}

bool warns(const reports::Cell &cell, const std::string &part) {
  return std::any_of(cell.warnings.begin(), cell.warnings.end(),
                     [&](const std::string &warning) { return warning.find(part) != std::string::npos; });
}

/// The same bits, but for the count of orders.
void expect_same_solution(reports::Cell lowered, const reports::Cell &asked) {
  ASSERT_EQ(lowered.status, reports::Status::ok) << name_of(lowered);
  ASSERT_EQ(asked.status, reports::Status::ok) << name_of(asked);
  lowered.quantities.erase("n_orders_lowered");
  EXPECT_EQ(lowered.errors, asked.errors) << name_of(lowered);
  EXPECT_EQ(lowered.quantities, asked.quantities) << name_of(lowered);
  EXPECT_EQ(lowered.nonzeros, asked.nonzeros) << name_of(lowered);
}

/// Four lines of particles carry order 3, not 4.
TEST(LowerOrder, is_the_solution_of_that_order_counted_and_said) {
  for (const char *method : {"strong", "weak1", "weak2", "hybrid", "mixed"}) {
    const auto of_order = [&](int order, const char *key) {
      return strip(fmt::format("name = \"{}\"\norder = {}\n{}", method, order, key));
    };
    const auto refused = of_order(4, "");
    EXPECT_EQ(refused.status, reports::Status::refused) << method;
    EXPECT_NE(refused.reason.find("5 distinct lines"), std::string::npos) << refused.reason;
    EXPECT_NE(refused.reason.find("lower_order = \"on\""), std::string::npos) << refused.reason;
    const auto lowered = of_order(4, "lower_order = \"on\"");
    expect_same_solution(lowered, of_order(3, ""));
    EXPECT_EQ(lowered.quantities.at("n_orders_lowered"), 1) << method;
    EXPECT_TRUE(warns(lowered, "order 4 does not exist on these particles (")) << method;
    EXPECT_TRUE(warns(lowered, "5 distinct lines")) << method;
    EXPECT_TRUE(warns(lowered, "; solved with order 3")) << method;
  }
}

TEST(LowerOrder, is_the_highest_that_exists) {
  const auto lowered = strip("name = \"weak1\"\norder = 4\nlower_order = \"on\"", "\"16x3\"");
  EXPECT_EQ(lowered.quantities.at("n_orders_lowered"), 2);
  expect_same_solution(lowered, strip("name = \"weak1\"\norder = 2", "\"16x3\""));
}

TEST(LowerOrder, changes_nothing_where_the_order_exists) {
  const auto on = strip("name = \"weak1\"\norder = 3\nlower_order = \"on\"");
  EXPECT_FALSE(on.quantities.contains("n_orders_lowered"));
  EXPECT_TRUE(on.warnings.empty());
  expect_same_solution(on, strip("name = \"weak1\"\norder = 3"));
}

/// Second derivatives need order 2, two lines do not carry it.
TEST(LowerOrder, is_refused_where_none_exists) {
  const auto cell = strip("name = \"strong\"\norder = 3\nlower_order = \"on\"", "\"16x2\"");
  EXPECT_EQ(cell.status, reports::Status::refused);
  EXPECT_NE(cell.reason.find("4 distinct lines"), std::string::npos) << cell.reason;
  EXPECT_NE(cell.reason.find("nor does a lower order exist, down to 2"), std::string::npos) << cell.reason;
  const auto least = strip("name = \"strong\"\norder = 2", "\"16x2\"");
  EXPECT_EQ(least.reason.find("lower_order"), std::string::npos) << "nothing to suggest: " << least.reason;
}

/// On irregular particles the smoothing length, the test radius and the support follow from the order.
TEST(LowerOrder, takes_all_that_follows_from_the_order) {
  const std::string keys = "name = \"weak1\"\nsupport = 2.2\nsmoothing_rule = \"nearest\"\nenlarge = \"off\"\n";
  const auto lowered = cell_of("plate_with_hole", "188", keys + "order = 4\nlower_order = \"on\"");
  ASSERT_EQ(lowered.status, reports::Status::ok) << name_of(lowered);
  const auto n_lowered = static_cast<int>(lowered.quantities.at("n_orders_lowered"));
  EXPECT_GE(n_lowered, 1);
  expect_same_solution(lowered, cell_of("plate_with_hole", "188", keys + fmt::format("order = {}", 4 - n_lowered)));
}

TEST(LowerOrder, is_told_before_anything_is_solved) {
  std::string methods;
  for (const char *method : {"strong", "weak1", "mixed"})
    methods += fmt::format("{}name = \"{}\"\norder = 4\nlower_order = \"on\"\n", methods.empty() ? "" : "[[method]]\n",
                           method);
  const auto scene = read(scene_text("cantilever", "\"16x4\"", methods));
  const auto &catalogue = study::shipped_catalogue();
  const auto experiment = study::find_benchmark(catalogue, scene.benchmark)
                              .make_experiment(scene, scene.problems.front(), catalogue.methods);
  ASSERT_EQ(scene.methods.size(), 3u);
  for (const auto &request : scene.methods) {
    const auto report = experiment->inspect(request, request.levels.front());
    ASSERT_TRUE(report) << request.label;
    EXPECT_EQ(report->order, 3) << request.label;
    EXPECT_EQ(report->n_orders_lowered, 1) << request.label;
  }
}

TEST(LowerOrder, is_counted_for_plates_in_motion) {
  const auto lowered = cell_of("plate_vibration", "\"9x4\"", "name = \"weak1\"\norder = 4\nlower_order = \"on\"");
  expect_same_solution(lowered, cell_of("plate_vibration", "\"9x4\"", "name = \"weak1\"\norder = 3"));
  EXPECT_EQ(lowered.quantities.at("n_orders_lowered"), 1);
  EXPECT_TRUE(warns(lowered, "solved with order 3"));
}

TEST(Recoveries, sparse_lu_instead_of_an_iteration_is_counted) {
  // Collocation with order 4 on irregular particles, where automatic would not iterate.
  const std::string keys = "name = \"strong\"\norder = 4\nsolver = ";
  const auto instead = cell_of("plate_with_hole", "188", keys + "\"bicgstab\"");
  ASSERT_EQ(instead.status, reports::Status::ok) << name_of(instead);
  EXPECT_EQ(instead.quantities.at("n_direct_instead"), 1);
  EXPECT_TRUE(warns(instead, "solved by sparse LU"));
  EXPECT_EQ(instead.linear_solver.at("method"), "umfpack");
  const auto direct = cell_of("plate_with_hole", "188", keys + "\"umfpack\"");
  EXPECT_FALSE(direct.quantities.contains("n_direct_instead"));
  EXPECT_EQ(instead.errors, direct.errors);
}

TEST(Recoveries, enlarged_supports_are_counted) {
  const std::string keys = "name = \"weak1\"\nsmoothing_length = 0.5\nenlarge = ";
  const auto enlarged = cell_of("plate_with_hole", "188", keys + "\"on\"");
  ASSERT_EQ(enlarged.status, reports::Status::ok) << name_of(enlarged);
  EXPECT_GT(enlarged.quantities.at("n_enlarged"), 0);
  EXPECT_GT(enlarged.quantities.at("largest_enlargement"), 1);
  EXPECT_TRUE(warns(enlarged, "enlarged, at most by"));
}

/// The super Gauss function is negative in places, and some of its moment matrices are not positive definite.
TEST(Recoveries, pivoted_moment_matrices_are_counted) {
  const auto negative = strip("name = \"weak1\"\nkernel = \"super_gauss\"\nsupport = 4");
  ASSERT_EQ(negative.status, reports::Status::ok) << name_of(negative);
  EXPECT_GT(negative.quantities.at("n_pivoted"), 0);
  EXPECT_TRUE(warns(negative, "not positive definite"));
  EXPECT_FALSE(strip("name = \"weak1\"\nsupport = 4").quantities.contains("n_pivoted"));
}

TEST(Recoveries, pivoted_moment_matrices_of_rods_are_counted) {
  const std::string keys = "name = \"collocation\"\nbasis = \"ssph\"\nkernel = ";
  const auto negative = cell_of("rod_static", "21", keys + "\"super_gauss\"\nsupport = 4.0");
  ASSERT_EQ(negative.status, reports::Status::ok) << name_of(negative);
  EXPECT_GT(negative.quantities.at("n_pivoted"), 0);
  EXPECT_FALSE(cell_of("rod_static", "21", keys + "\"gauss\"\nsupport = 4.0").quantities.contains("n_pivoted"));
}

} // namespace
