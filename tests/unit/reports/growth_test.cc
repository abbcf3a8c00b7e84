// Exponents of cost: exact for power laws, and none where there is nothing to fit.

#include "comparisons/reports/growth.h"
#include "comparisons/reports/reports.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace comparisons::reports;

namespace {

Cell cell(const std::string &label, int n, double seconds, double bytes) {
  Cell cell;
  cell.benchmark = "cantilever";
  cell.scene = "scaling";
  cell.label = cell.method = label;
  cell.level = std::to_string(n);
  cell.n_points = n;
  cell.n_dofs = 2 * n;
  cell.seconds["solve"] = {seconds, seconds, seconds};
  cell.seconds["basis"] = {1e-6 * n, 1e-6 * n, 1e-6 * n};
  cell.memory_bytes = static_cast<std::int64_t>(bytes);
  return cell;
}

Results power_laws() {
  Results results;
  for (const int n : {10000, 1000, 100000})
    results.cells.push_back(cell("weak1", n, 1e-7 * std::pow(n, 1.5), 6000. * n));
  return results;
}

std::optional<double> exponent(const Results &results, const char *cost) {
  const auto groups = group_cells(results);
  return growth_exponent(series_of(groups.at(0)).at(0), cost);
}

TEST(Growth, power_laws_are_found_exactly) {
  const Results results = power_laws();
  EXPECT_NEAR(exponent(results, "solve").value(), 1.5, 1e-12);
  EXPECT_NEAR(exponent(results, "basis").value(), 1, 1e-12);
  EXPECT_NEAR(exponent(results, "memory").value(), 1, 1e-12);
}

TEST(Growth, nothing_is_fitted_to_too_little) {
  EXPECT_FALSE(exponent(power_laws(), "assembly")) << "a phase that no cell has";
  Results two = power_laws();
  two.cells.pop_back();
  EXPECT_FALSE(exponent(two, "solve")) << "two levels";
  Results near;
  for (const int n : {1000, 2000, 4000})
    near.cells.push_back(cell("weak1", n, n, n));
  EXPECT_FALSE(exponent(near, "solve")) << "fourfold";
  Results quick = power_laws();
  for (auto &c : quick.cells)
    for (auto &[phase, seconds] : c.seconds)
      seconds.median *= 1e-6;
  EXPECT_FALSE(exponent(quick, "solve")) << "microseconds";
  EXPECT_TRUE(exponent(quick, "memory"));
  Results failed = power_laws();
  failed.cells[2].status = Status::failed;
  EXPECT_FALSE(exponent(failed, "solve")) << "two ok levels";
}

TEST(Growth, the_table_stands_in_the_report) {
  Document document;
  const Results results = power_laws();
  append_growth(document, group_cells(results));
  ASSERT_EQ(document.size(), 4u); // two headings, what the numbers are, the table
  const auto &table = std::get<Table>(document.back());
  ASSERT_EQ(table.rows().size(), 1u);
  EXPECT_EQ(table.rows()[0], (std::vector<std::string>{"weak1", "1.00", "1.50", "1.00"}));
  Document nothing;
  append_growth(nothing, {});
  EXPECT_TRUE(nothing.empty());
}

} // namespace
