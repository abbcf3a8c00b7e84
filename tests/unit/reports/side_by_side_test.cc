// Two runs side by side: ratios, what the spread leaves open, what only one has.

#include "comparisons/reports/side_by_side.h"

#include "unit/reports/sample.h"

#include <gtest/gtest.h>

using namespace comparisons::reports;

namespace {

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

Results run(double factor) {
  Results results = reports_sample::results();
  results.not_comparable.clear();
  for (Cell &cell : results.cells)
    for (auto &[phase, spread] : cell.seconds)
      spread = {factor * spread.median, factor * spread.minimum, factor * spread.maximum};
  return results;
}

} // namespace

TEST(SideBySide, a_run_beside_itself_is_the_same) {
  const std::string text = render_text(side_by_side({"a.json", run(1)}, {"b.json", run(1)}));
  EXPECT_TRUE(contains(text, "8 of 8 cells the same within the spread; geometric mean of the ratios 1.")) << text;
  EXPECT_FALSE(contains(text, "Only in"));
}

TEST(SideBySide, ratios_are_of_the_second_over_the_first) {
  // The sample's repeats lie between 0.9 and 1.25 of the median.
  const Results a = run(1), b = run(3);
  const auto ratio = time_ratio(a.cells[0], b.cells[0]);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->ratio, 3, 1e-12);
  EXPECT_NEAR(ratio->least, 3 * 0.9 / 1.25, 1e-12);
  EXPECT_NEAR(ratio->largest, 3 * 1.25 / 0.9, 1e-12);
  EXPECT_FALSE(ratio->holds_one());
  EXPECT_TRUE(time_ratio(a.cells[0], run(1.3).cells[0])->holds_one()) << "30 % are within this spread";
  const std::string text = render_text(side_by_side({"a.json", a}, {"b.json", b}));
  EXPECT_TRUE(contains(text, "0 of 8 cells the same within the spread; geometric mean of the ratios 3.")) << text;
  EXPECT_TRUE(contains(text, "slower"));
}

TEST(SideBySide, failed_cells_have_no_ratio_and_missing_ones_are_named) {
  Results a = run(1), b = run(1);
  b.cells.erase(b.cells.begin());
  b.cells[0].errors["displacement_l2_relative"] = 0.5;
  b.machine.cpu = "Another CPU";
  EXPECT_EQ(time_ratio(a.cells[5], a.cells[5]), std::nullopt);
  const std::string text = render_text(side_by_side({"a.json", a}, {"b.json", b}));
  EXPECT_TRUE(contains(text, "Only in the first"));
  EXPECT_TRUE(contains(text, "- cantilever / convergence, strong, 16x4")) << text;
  EXPECT_TRUE(contains(text, "Another CPU"));
  EXPECT_TRUE(contains(text, "failed / failed"));
  EXPECT_TRUE(contains(text, "5.000e-01")) << "an error that changed is told";
}
