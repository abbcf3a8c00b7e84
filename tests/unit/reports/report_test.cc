#include "comparisons/reports/reports.h"

#include "comparisons/reports/groups.h"
#include "comparisons/reports/json.h"
#include "comparisons/reports/ledger_section.h"
#include "comparisons/reports/page/page.h"
#include "comparisons/reports/table.h"
#include "unit/reports/sample.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace comparisons::reports;

namespace {

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

std::vector<std::string> lines_of(const std::string &text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

} // namespace

TEST(Reports, SameResultsSameBytes) {
  const Results results = reports_sample::results();
  const Results again = parse_results(json_text(results));
  EXPECT_EQ(text_report(again), text_report(results));
  EXPECT_EQ(markdown_report(again), markdown_report(results));
  EXPECT_EQ(csv_report(again), csv_report(results));
  EXPECT_EQ(csv_published(again), csv_published(results));
  EXPECT_EQ(latex_report(again), latex_report(results));
  EXPECT_EQ(html_page(again, {}), html_page(results, {}));
}

TEST(Reports, HeaderSaysWhatWasRunWhere) {
  for (const std::string &report : {text_report(reports_sample::results()), markdown_report(reports_sample::results())})
    for (const char *part : {"petrov 0.1.0", "commit 0123abc", "Release build", "Some CPU", "threads: 1",
                             "OpenBLAS 0.3.21", "deal.II 9.4.1", "elasticity", "inertia, damping",
                             "NOT COMPARABLE: the machine was loaded", "INTERRUPTED", "excludes the evaluation"})
      EXPECT_TRUE(contains(report, part)) << part;
}

TEST(Reports, TerminalLinesAreAtMost120Wide) {
  for (const std::string &line : lines_of(text_report(reports_sample::results())))
    EXPECT_LE(display_width(line), 120u) << line;
}

TEST(Reports, MainComparisonFirstUnexpectedLast) {
  const std::string text = text_report(reports_sample::results());
  const auto main = text.find("cantilever / scene, 16x4\n");
  const auto other = text.find("cantilever / convergence\n");
  const auto ledger = text.find("Published numbers and claims");
  const auto unexpected = text.find("UNEXPECTED OUTCOMES (2)");
  EXPECT_LT(main, other);
  EXPECT_LT(other, ledger);
  EXPECT_LT(ledger, unexpected);
  EXPECT_LT(unexpected, text.find("Summary\n"));
  EXPECT_TRUE(text.ends_with("2 unexpected outcomes, named above.\n"));
  EXPECT_TRUE(contains(text.substr(unexpected), "*** cantilever / convergence, broken"));
  EXPECT_TRUE(contains(text.substr(unexpected), "Table 10 (weak1, 16x4): differs (UNEXPECTED)"));
}

TEST(Reports, NothingUnexpectedIsSaid) {
  Results results = reports_sample::results();
  std::erase_if(results.cells, [](const Cell &cell) { return !cell.expected; });
  std::erase_if(results.published, [](const Published &entry) { return !entry.expected; });
  EXPECT_TRUE(unexpected_outcomes(results).empty());
  results.not_comparable.clear();
  EXPECT_TRUE(text_report(results).ends_with("No unexpected outcomes.\n"));
  EXPECT_FALSE(contains(text_report(results), "UNEXPECTED"));
}

TEST(Reports, ACellThatIsNotOkShowsItsReasonAndNoNumbers) {
  const std::string text = text_report(reports_sample::results());
  EXPECT_TRUE(contains(text, "refused (expected)"));
  EXPECT_TRUE(contains(text, "failed (UNEXPECTED)"));
  EXPECT_TRUE(contains(text, "- weak1 order=4, 16x4: refused (expected): singular moment matrix at particle 7"));
  EXPECT_FALSE(contains(text, "2.500e-01")); // the error that the sample's bad cells hold
  EXPECT_FALSE(contains(text, "nan"));
  EXPECT_FALSE(contains(text, "inf\n"));
}

TEST(Reports, AnOkThatShouldHaveBeenARefusalIsUnexpected) {
  Results results;
  results.cells.push_back(reports_sample::cell("scene", "weak1", "16x4", 0.1));
  results.cells[0].expected = false;
  EXPECT_TRUE(contains(text_report(results), "ok (UNEXPECTED)"));
  EXPECT_EQ(unexpected_outcomes(results).size(), 1u);
}

TEST(Reports, LedgerSummary) {
  Results results = reports_sample::results();
  EXPECT_EQ(ledger_summary(results),
            "1 of 3 published numbers reproduced; 1 claims hold, 1 do not (expected); 1 outcomes UNEXPECTED.");
  results.published[2].expected = true;
  EXPECT_EQ(ledger_summary(results), "1 of 3 published numbers reproduced; 1 claims hold, 1 do not (expected).");
  results.published[3].expected = false;
  EXPECT_EQ(ledger_summary(results), "1 of 3 published numbers reproduced; 1 claims hold, 0 do not (expected), "
                                     "1 do not (UNEXPECTED); 1 outcomes UNEXPECTED.");
}

TEST(Reports, VerdictsAsTheyAreShown) {
  using reports_sample::claim, reports_sample::value;
  EXPECT_EQ(verdict_text(value("", 1, 1, Verdict::reproduced, true)), "reproduced");
  EXPECT_EQ(verdict_text(value("", 1, 1, Verdict::reproduced, false)), "reproduced (UNEXPECTED)");
  EXPECT_EQ(verdict_text(value("", 1, 2, Verdict::differs, true)), "differs (expected)");
  EXPECT_EQ(verdict_text(value("", 1, 2, Verdict::differs, false)), "differs (UNEXPECTED)");
  EXPECT_EQ(verdict_text(value("", 1, 2, Verdict::not_reproducible, true)), "not reproducible (expected)");
  EXPECT_EQ(verdict_text(claim("", Verdict::holds, true)), "holds");
  EXPECT_EQ(verdict_text(claim("", Verdict::holds, false)), "holds (UNEXPECTED)");
  EXPECT_EQ(verdict_text(claim("", Verdict::does_not_hold, true)), "does not hold (expected)");
  EXPECT_EQ(verdict_text(claim("", Verdict::does_not_hold, false)), "does not hold (UNEXPECTED)");
}

TEST(Reports, EmptyResultsStillMakeAReport) {
  EXPECT_TRUE(contains(text_report(Results()), "No cells were computed."));
  EXPECT_FALSE(markdown_report(Results()).empty());
  EXPECT_EQ(lines_of(csv_report(Results())).size(), 1u);
}

TEST(ObservedRate, IsTheSlopeBetweenLevels) {
  Results results;
  // Errors h^2.5 on grids with 15 and 30 intervals: the rate is 2.5 up to rounding.
  results.cells.push_back(reports_sample::cell("convergence", "weak1", "16x4", std::pow(1.0 / 15, 2.5)));
  results.cells.push_back(reports_sample::cell("convergence", "strong", "16x4", 0.5));
  results.cells.push_back(reports_sample::cell("convergence", "weak1", "31x7", std::pow(1.0 / 30, 2.5)));
  const std::vector<Group> groups = group_cells(results);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].cells[1]->level, "31x7"); // labels stand together
  EXPECT_NEAR(observed_rate(groups[0], results.cells[2], "displacement_l2_relative").value(), 2.5, 1e-12);
  EXPECT_EQ(observed_rate(groups[0], results.cells[0], "displacement_l2_relative"), std::nullopt);
  EXPECT_EQ(observed_rate(groups[0], results.cells[1], "displacement_l2_relative"), std::nullopt);
}

TEST(ObservedRate, IsNotGivenWhereItMeansNothing) {
  Results results;
  results.cells.push_back(reports_sample::cell("convergence", "weak1", "16x4", 1e-13));
  results.cells.push_back(reports_sample::cell("convergence", "weak1", "31x7", 1e-14));
  results.cells.push_back(reports_sample::cell("convergence", "strong", "16x4", 0.1));
  results.cells.push_back(reports_sample::cell("convergence", "strong", "31x7", 0.01));
  results.cells[2].status = Status::failed;
  const std::vector<Group> groups = group_cells(results);
  EXPECT_EQ(observed_rate(groups[0], results.cells[1], "displacement_l2_relative"), std::nullopt);
  EXPECT_EQ(observed_rate(groups[0], results.cells[3], "displacement_l2_relative"), std::nullopt);
}

namespace {

/// A cell of the matrix of hard cases.
Cell hard_cell(const std::string &name, const std::string &method, const char *verdict, Status status) {
  Cell cell;
  cell.benchmark = "hard_cases";
  cell.scene = "patch";
  cell.variant = name;
  cell.method = cell.label = method;
  cell.level = "-";
  cell.status = status;
  cell.expected = status != Status::failed;
  cell.parameters = {{"verdict", verdict}, {"threshold", 1e-8}, {"reference", "the field itself"}};
  cell.errors["error_of_case"] = 2.5e-11;
  if (status != Status::ok)
    cell.reason = "said by name";
  return cell;
}

} // namespace

TEST(HardCases, AreATableOfTheirOwnAndNoComparison) {
  Results results = reports_sample::results();
  const std::size_t n_groups = group_cells(results).size();
  results.cells.push_back(hard_cell("linear, grid", "weak1", "holds", Status::ok));
  results.cells.push_back(hard_cell("linear, grid", "weak2", "refused", Status::refused));
  results.cells.push_back(hard_cell("linear, graded", "weak2", "fails", Status::failed));
  EXPECT_EQ(group_cells(results).size(), n_groups);
  results = parse_results(json_text(results));
  for (const std::string &report :
       {text_report(results), markdown_report(results), latex_report(results), html_page(results, {})})
    for (const char *part : {"Hard cases: patch", "3 cells; 1 hold, 0 degrade, 1 are refused by name, 1 fail",
                             "linear, grid", "the field itself", "said by name"})
      EXPECT_TRUE(contains(report, part)) << part;
  EXPECT_TRUE(contains(text_report(results), "2.500e-11"));
  EXPECT_TRUE(contains(html_page(results, {}), "href='#explore'"));
  const std::string brief = brief_report(results);
  EXPECT_TRUE(contains(brief, "Hard cases: 3 cells"));
  EXPECT_FALSE(contains(brief, "linear, grid"));                      // the terminal gets the counts alone
  EXPECT_TRUE(contains(brief, "hard_cases / patch, linear, graded")); // and what fails
}

namespace {

/// An alternative for one linear system.
Cell solver_cell(const std::string &method, const std::string &preconditioner, double seconds, double part) {
  Cell cell;
  cell.benchmark = "solvers";
  cell.scene = "scene";
  cell.variant = "system=cantilever";
  cell.method = method;
  cell.label = method + " preconditioner=" + preconditioner;
  cell.level = "2600";
  cell.n_dofs = 5106;
  cell.nonzeros = 632692;
  cell.parameters = {{"chosen", preconditioner == "thinned+coarse"}};
  cell.linear_solver = {{"method", method}, {"ordering", "rcm"}, {"preconditioner", preconditioner}};
  cell.errors["algebraic_error"] = 1e-2 * part;
  cell.quantities = {{"discretisation_error", 1e-2},
                     {"algebraic_over_discretisation", part},
                     {"backward_error", 1.25e-16},
                     {"solver_iterations", 26},
                     {"factor_bytes", 2.4e6}};
  cell.seconds["setup"] = {.25 * seconds, .25 * seconds, .25 * seconds};
  cell.seconds["solve"] = {.75 * seconds, .75 * seconds, .75 * seconds};
  cell.seconds["total"] = {seconds, seconds, seconds};
  return cell;
}

} // namespace

TEST(LinearSolvers, AreATableOfTheirOwnAndNoComparison) {
  Results results = reports_sample::results();
  const std::size_t n_groups = group_cells(results).size();
  results.cells.push_back(solver_cell("bicgstab", "thinned+coarse", .04, 1e-8));
  results.cells.push_back(solver_cell("gmres", "ilut+coarse", .032, 2e-8));
  results.cells.push_back(solver_cell("gmres", "ilu0", .02, .5)); // the fastest, but it breaks the rule
  results.cells.push_back(solver_cell("bicgstab", "ilut", .01, 1));
  results.cells.back().status = Status::failed;
  results.cells.back().reason = "no convergence: a backward error of 1.0e-02 after 500 iterations";
  EXPECT_EQ(group_cells(results).size(), n_groups);
  results = parse_results(json_text(results));
  EXPECT_EQ(results.cells.back().linear_solver.at("preconditioner"), "ilut");
  for (const std::string &report :
       {text_report(results), markdown_report(results), latex_report(results), html_page(results, {})})
    for (const char *part : {"Linear solvers, system=cantilever, 2600", "too loose", "no convergence",
                             "fastest of those that keep the rule: gmres, rcm, ilut+coarse: 0.032 s",
                             "by themselves at this size: bicgstab, rcm, thinned+coarse: 0.04 s"})
      EXPECT_TRUE(contains(report, part)) << part;
  EXPECT_TRUE(contains(brief_report(results), "bicgstab *"));
  EXPECT_FALSE(contains(brief_report(reports_sample::results()), "Linear solvers"));
}

TEST(LinearSolvers, OfAFileFromElsewhereMayLackEverything) {
  Results results;
  results.scene = nlohmann::ordered_json::array();
  results.cells.push_back(solver_cell("umfpack", "", .1, 1e-9));
  auto &cell = results.cells.back();
  cell.linear_solver.clear();
  cell.quantities.clear();
  cell.errors.clear();
  cell.seconds.clear();
  cell.parameters = {{"chosen", "yes"}, {"backward_error", "none"}};
  EXPECT_TRUE(contains(text_report(results), "Linear solvers, system=cantilever, 2600"));
}

TEST(LinearSolvers, OfOtherBenchmarksAreNamed) {
  Results results = reports_sample::results();
  for (const std::string &report : {text_report(results), markdown_report(results), latex_report(results)})
    for (const char *part : {"Linear solvers used", "bicgstab", "rcm", "thinned+coarse", "3.5e-16", "2.5e-12"})
      EXPECT_TRUE(contains(report, part)) << part;
  for (Cell &cell : results.cells)
    cell.linear_solver.clear();
  EXPECT_FALSE(contains(text_report(results), "Linear solvers used"));
}

TEST(HardCases, OfAFileFromElsewhereMayLackEverything) {
  Results results;
  results.scene = nlohmann::ordered_json::array();
  results.cells.push_back(hard_cell("case", "weak1", "holds", Status::ok));
  results.cells.back().parameters = {{"verdict", 1}, {"threshold", "none"}};
  EXPECT_TRUE(contains(text_report(results), "0 hold"));
  EXPECT_FALSE(contains(html_page(results, {}), "href='#explore'")); // nothing to explore, and no link to it
  results.cells.back().parameters = nlohmann::ordered_json::array();
  EXPECT_TRUE(contains(text_report(results), "Hard cases: patch"));
}
