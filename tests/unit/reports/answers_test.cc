// Answers from made-up cells whose answers are known.

#include "comparisons/reports/answers.h"

#include "comparisons/metrics/machine.h"
#include "comparisons/reports/summary.h"
#include "comparisons/reports/theory.h"
#include "unit/reports/sample.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace comparisons::reports;

namespace {

constexpr const char *u = "displacement_l2_relative";

/// A cell of a grid of n x n particles with an error and a time.
Cell cell(const std::string &label, int n, double error, double seconds) {
  Cell cell;
  cell.benchmark = "made_up";
  cell.scene = "scene";
  cell.method = label.substr(0, label.find(' '));
  cell.label = label;
  cell.level = fmt::format("{0}x{0}", n);
  cell.n_points = n * n;
  cell.n_dofs = 2 * cell.n_points;
  cell.errors[u] = error;
  cell.seconds["total"] = {seconds, 0.9 * seconds, 1.2 * seconds};
  cell.repeats = 5;
  cell.memory_bytes = 2000000;
  return cell;
}

/// Errors h^2 and times h^-3 on grids of 5, 9, 17, 33 particles: the error e costs e^-1.5 seconds.
Results power_laws() {
  Results results;
  for (const int n : {33, 5, 17, 9}) // in any order
    results.cells.push_back(cell("weak1", n, std::pow(n - 1, -2.0), std::pow(n - 1, 3.0)));
  for (const int n : {5, 9, 17, 33})
    results.cells.push_back(cell("fem Q2", n, 0.1 * std::pow(n - 1, -3.0), 0.5 * std::pow(n - 1, 2.0)));
  return results;
}

MethodSeries series(const std::vector<Group> &groups, const std::string &label) {
  for (const MethodSeries &series : series_of(groups.at(0)))
    if (series.label == label)
      return series;
  throw std::runtime_error("no series " + label);
}

std::string why(const Results &results, const std::string &label, double target) {
  const auto groups = group_cells(results);
  const Cost cost = seconds_for_error(series(groups, label), u, target);
  return cost.seconds ? "a number" : cost.reason;
}

} // namespace

TEST(Answers, a_power_law_is_interpolated_exactly) {
  const Results results = power_laws();
  const auto groups = group_cells(results);
  for (const double target : {0.05, 0.01, 0.0625, 1.0 / 1024, 0.002}) {
    // log-log interpolation is exact for a power law: rounding remains.
    const auto weak1 = seconds_for_error(series(groups, "weak1"), u, target).seconds;
    ASSERT_TRUE(weak1) << target;
    EXPECT_NEAR(*weak1 / std::pow(target, -1.5), 1, 1e-12) << target;
  }
  // e = 0.1 h^3, t = 0.5 h^-2 = 0.5 (0.1 / e)^(2/3)
  const auto fem = seconds_for_error(series(groups, "fem Q2"), u, 1e-4).seconds;
  EXPECT_NEAR(fem.value() / (0.5 * std::pow(1e3, 2.0 / 3)), 1, 1e-12);
}

TEST(Answers, nothing_is_extrapolated) {
  const Results results = power_laws();
  EXPECT_EQ(why(results, "weak1", 0.07), "smaller already: 6.250e-02 at 5x5 in 64 s");
  EXPECT_EQ(why(results, "weak1", 0.0009), "not reached: 9.766e-04 at 33x33");
  EXPECT_EQ(why(results, "weak1", 0.0625), "a number") << "the ends belong to the range";
}

TEST(Answers, a_series_that_does_not_fall_has_no_equal_error) {
  Results results = power_laws();
  results.cells[3].errors[u] = 0.1; // 9x9, above 5x5
  EXPECT_EQ(why(results, "weak1", 0.01), "the error does not fall from level to level");
  EXPECT_EQ(why(results, "fem Q2", 1e-4), "a number") << "the other series is as before";
}

TEST(Answers, a_level_that_failed_is_not_bridged) {
  Results results = power_laws();
  results.cells[3].status = Status::failed; // 9x9, between 5x5 and 17x17
  results.cells[3].reason = "singular";
  EXPECT_EQ(why(results, "weak1", 0.01), "failed at 9x9 in between");
  EXPECT_EQ(why(results, "weak1", 0.002), "a number") << "17x17 to 33x33 is whole";
  for (Cell &one : results.cells)
    if (one.label == "weak1")
      one.status = Status::refused;
  EXPECT_EQ(why(results, "weak1", 0.01), "refused");
}

TEST(Answers, one_level_is_no_series) {
  Results results = power_laws();
  results.cells.resize(1);
  EXPECT_EQ(why(results, "weak1", 1.0 / 1024), "one level only");
  EXPECT_TRUE(equal_errors(results).empty());
}

TEST(Answers, equal_errors_of_all_methods_at_every_power_of_ten_within_reach) {
  const auto entries = equal_errors(power_laws());
  // weak1 reaches 1e-2 and 1e-3, fem Q2 (1.6e-3 to 3.1e-6) 1e-3, 1e-4 and 1e-5.
  ASSERT_EQ(entries.size(), 8u);
  const double targets[] = {1e-2, 1e-2, 1e-3, 1e-3, 1e-4, 1e-4, 1e-5, 1e-5};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    EXPECT_EQ(entries[i].target, targets[i]);
    EXPECT_EQ(entries[i].method, i % 2 == 0 ? "weak1" : "fem Q2");
    EXPECT_EQ(entries[i].benchmark, "made_up");
    EXPECT_NE(entries[i].seconds.has_value(), !entries[i].reason.empty());
  }
  EXPECT_NEAR(entries[0].seconds.value(), 1e3, 1e-9);
  EXPECT_EQ(entries[1].reason, "smaller already: 1.563e-03 at 5x5 in 8 s");
}

TEST(Answers, the_front_has_who_is_not_beaten) {
  Results results;
  results.cells = {cell("a", 5, 0.1, 1),  cell("b", 5, 0.2, 2),    cell("c", 5, 0.01, 3),
                   cell("d", 5, 0.01, 4), cell("e", 5, 0.001, 10), cell("f", 5, 1e-9, 0.5)};
  results.cells[5].status = Status::failed;
  const auto groups = group_cells(results);
  std::string labels;
  for (const Cell *one : pareto_front(groups[0], u))
    labels += one->label;
  EXPECT_EQ(labels, "ace");
  EXPECT_DOUBLE_EQ(efficiency(results.cells[2], u).value(), 1 / 0.03);
  EXPECT_DOUBLE_EQ(accuracy_per_megabyte(results.cells[2], u).value(), 50);
  EXPECT_EQ(efficiency(results.cells[5], u), std::nullopt);
}

TEST(Answers, least_squares_rate) {
  Results results = power_laws();
  auto groups = group_cells(results);
  EXPECT_NEAR(least_squares_rate(series(groups, "weak1"), u).value(), 2, 1e-12);
  EXPECT_NEAR(least_squares_rate(series(groups, "fem Q2"), u).value(), 3, 1e-12);
  results.cells[0].status = Status::failed;
  EXPECT_EQ(least_squares_rate(series(groups, "weak1"), u), std::nullopt);
  results.cells.resize(2);
  results.cells[0].status = Status::ok;
  groups = group_cells(results);
  EXPECT_EQ(least_squares_rate(series(groups, "weak1"), u), std::nullopt) << "two levels are a rate, not a fit";
}

TEST(Answers, on_a_line_the_spacing_is_one_over_the_intervals) {
  Results results;
  for (const int n : {11, 21, 41}) {
    results.cells.push_back(cell("collocation", n, std::pow(n - 1, -2.0), n));
    results.cells.back().level = std::to_string(n);
    results.cells.back().n_points = n;
    results.cells.back().dimension = 1;
  }
  const auto groups = group_cells(results);
  EXPECT_NEAR(least_squares_rate(series(groups, "collocation"), u).value(), 2, 1e-12);
  EXPECT_NEAR(observed_rate(groups[0], results.cells[1], u).value(), 2, 1e-12);
}

TEST(Answers, which_numbers_are_errors) {
  for (const char *name : {u, "stress_l2_relative", "stress_concentration_factor_error", "l2_sum"})
    EXPECT_TRUE(is_error_target(name)) << name;
  for (const char *name : {"displacement_log10_E", "l2_slope", "l2_seed_3", "backward_error", "solver_iterations"})
    EXPECT_FALSE(is_error_target(name)) << name;
  Results results = power_laws();
  for (Cell &one : results.cells) {
    one.errors["energy_relative"] = 0.1;
    one.errors["stress_l2_relative"] = 0.2;
    one.quantities["stress_concentration_factor"] = 3.01;
    one.quantities["stress_concentration_factor_error"] = -0.003; // signed
  }
  const auto groups = group_cells(results);
  EXPECT_EQ(headline_errors(groups[0]),
            (std::vector<std::string>{u, "stress_l2_relative", "stress_concentration_factor_error"}));
  EXPECT_DOUBLE_EQ(target_error(results.cells[0], "stress_concentration_factor_error").value(), 0.003);
}

TEST(Theory, rates_by_method_and_derivative) {
  Cell q3 = cell("fem Q3", 5, 1, 1);
  q3.parameters["element"] = "Q3";
  EXPECT_EQ(theoretical_rate(q3, u), 4.0);
  EXPECT_EQ(theoretical_rate(q3, "stress_l2_relative"), 3.0);
  EXPECT_EQ(theoretical_rate(q3, "h2"), 2.0);
  EXPECT_EQ(theoretical_rate(q3, "seconds"), std::nullopt);
  Cell particles = cell("weak2", 5, 1, 1);
  particles.parameters = {{"order", 2}, {"basis", "ssph"}};
  EXPECT_EQ(theoretical_rate(particles, u), 3.0);
  particles.method = "weak1";
  EXPECT_EQ(theoretical_rate(particles, u), 2.0);
  particles.method = "strong";
  EXPECT_EQ(theoretical_rate(particles, u), 2.0);
  particles.parameters["order"] = 3;
  EXPECT_EQ(theoretical_rate(particles, u), 2.0) << "odd orders gain nothing by collocation";
  particles.method = "estimate";
  EXPECT_EQ(theoretical_rate(particles, "h1"), 3.0);
  particles.parameters["basis"] = "sph";
  EXPECT_EQ(theoretical_rate(particles, "h1"), std::nullopt);
}

TEST(Summary, names_the_best_and_the_best_without_elements) {
  const auto summaries = summarise(power_laws());
  ASSERT_EQ(summaries.size(), 1u);
  EXPECT_EQ(summaries[0].error, u);
  // At 1 % the coarsest Q2 mesh is good enough: 8 s; weak1 takes 1000 s by interpolation.
  EXPECT_EQ(summaries[0].best[0].value().label, "fem Q2");
  EXPECT_DOUBLE_EQ(summaries[0].best[0]->seconds, 8);
  EXPECT_EQ(summaries[0].best_meshless[0].value().label, "weak1");
  EXPECT_NEAR(summaries[0].best_meshless[0]->seconds, 1e3, 1e-9);
  EXPECT_EQ(summaries[0].unexpected, 0);
}

TEST(Spread, is_flagged_above_ten_per_cent_and_unknown_for_one_run) {
  Cell one = cell("a", 5, 1, 1);
  EXPECT_NEAR(relative_spread(one).value(), 0.3, 1e-12);
  EXPECT_GT(*relative_spread(one), wide_spread);
  one.repeats = 1;
  EXPECT_EQ(relative_spread(one), std::nullopt);
}

TEST(NotComparable, debug_load_and_threads_are_stamped) {
  using comparisons::metrics::reasons_not_comparable;
  Program program;
  program.build_type = "Release";
  Machine machine;
  machine.cores = 2;
  machine.load = 0.4;
  machine.load_at_end = 1.1;
  EXPECT_TRUE(reasons_not_comparable(program, machine, {1}, 100).empty());
  EXPECT_EQ(reasons_not_comparable(program, machine, {1, 4}, 100).size(), 1u);
  machine.load_at_end = 2.0;
  EXPECT_EQ(reasons_not_comparable(program, machine, {1}, 100).size(), 1u);
  EXPECT_TRUE(reasons_not_comparable(program, machine, {1}, 10).empty()) << "too short for a load average";
  EXPECT_TRUE(reasons_not_comparable(program, machine, {2}, 100).empty()) << "two threads of our own";
  machine.competing_cores = 0.05;
  EXPECT_TRUE(reasons_not_comparable(program, machine, {1}, 100).empty()) << "measured: load averages are of the past";
  machine.competing_cores = 0.7;
  EXPECT_EQ(reasons_not_comparable(program, machine, {1}, 100).size(), 1u);
  machine.competing_cores.reset();
  machine.load = 1.9;
  EXPECT_EQ(reasons_not_comparable(program, machine, {2}, 100).size(), 1u);
  program.build_type = "Debug";
  EXPECT_EQ(reasons_not_comparable(program, machine, {2}, 100).size(), 2u);
}
