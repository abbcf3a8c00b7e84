// The report's section on recoveries: every cell that has one, with its rule, and no section where there is none.

#include "comparisons/reports/json.h"
#include "comparisons/reports/page/page.h"
#include "comparisons/reports/recoveries_section.h"
#include "comparisons/reports/reports.h"
#include "comparisons/reports/theory.h"
#include "unit/reports/sample.h"

#include <gtest/gtest.h>

using namespace comparisons::reports;

namespace {

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

Results recovered() {
  Results results = reports_sample::results();
  results.cells[0].quantities["n_orders_lowered"] = 1;
  results.cells[1].quantities.insert({{"n_enlarged", 12345}, {"largest_enlargement", 1.375}});
  return results;
}

std::vector<std::string> all_reports(const Results &results) {
  return {text_report(results), markdown_report(results), latex_report(results), html_page(results, {})};
}

const Table *recoveries_table(const Document &document) {
  const Table *found = nullptr;
  bool inside = false;
  for (const Block &block : document) {
    if (const auto *heading = std::get_if<Heading>(&block))
      inside = heading->text == "Recoveries";
    if (const auto *table = std::get_if<Table>(&block); table != nullptr && inside)
      found = table;
  }
  return found;
}

} // namespace

TEST(RecoveriesSection, StandInEveryReportWithTheirRules) {
  for (const auto &report : all_reports(recovered()))
    for (const char *part : {"Recoveries", "orders lowered", "particles enlarged", "12345"})
      EXPECT_TRUE(contains(report, part)) << part;
  EXPECT_TRUE(contains(markdown_report(recovered()), "solved with the highest lower one that they carry"));
  EXPECT_FALSE(contains(text_report(recovered()), "sparse LU instead")) << "a rule that was not used";
}

TEST(RecoveriesSection, HaveARowForEveryCell) {
  const Results results = recovered();
  Document document;
  append_recoveries(document, group_cells(results));
  const Table *table = recoveries_table(document);
  ASSERT_NE(table, nullptr);
  const std::vector<std::vector<std::string>> rows{
      {"cantilever / convergence", "strong, 16x4", "orders lowered", "1"},
      {"cantilever / convergence", "weak1, 16x4", "particles enlarged", "12345"}};
  EXPECT_EQ(table->rows(), rows);
}

TEST(RecoveriesSection, AreNoSectionWhereThereIsNone) {
  for (const auto &report : all_reports(reports_sample::results()))
    EXPECT_FALSE(contains(report, "Recoveries"));
  Results refused = reports_sample::results();
  for (Cell &cell : refused.cells)
    if (cell.status != Status::ok)
      cell.quantities["n_enlarged"] = 3;
  EXPECT_FALSE(contains(text_report(refused), "Recoveries")) << "a cell without a result has recovered nothing";
}

TEST(RecoveriesSection, ALoweredOrderHasTheRateOfTheOneSolved) {
  Cell cell = reports_sample::cell("scene", "weak1", "16x4", .01);
  cell.parameters["order"] = 4;
  EXPECT_EQ(theoretical_rate(cell, "stress_l2_relative"), 4);
  cell.quantities["n_orders_lowered"] = 1;
  EXPECT_EQ(theoretical_rate(cell, "stress_l2_relative"), 3);
}

TEST(RecoveriesSection, ComeBackFromTheResults) {
  const Results results = recovered();
  const Results again = parse_results(json_text(results));
  EXPECT_EQ(again.cells[0].quantities, results.cells[0].quantities);
  EXPECT_EQ(text_report(again), text_report(results));
}

TEST(RecoveriesSection, AreInNoTableOfFurtherQuantities) {
  const std::string text = text_report(recovered());
  EXPECT_FALSE(contains(text.substr(text.find("Further errors and quantities")), "orders"));
}
