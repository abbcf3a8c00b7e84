// report.html in a real browser, and the LaTeX tables through pdflatex: what a reader gets.

#include "comparisons/program/data_files.h"
#include "comparisons/reports/json.h"
#include "comparisons/reports/reports.h"
#include "system/program_here.h"
#include "unit/reports/parsed_tables.h"
#include "unit/reports/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

using namespace system_tests;
using namespace comparisons;

/// Path of a command, empty if it is not installed.
std::string command(const std::string &name) {
  for (const char *folder : {"/usr/local/bin/", "/usr/bin/", "/bin/"})
    if (fs::exists(folder + name))
      return folder + name;
  return {};
}

/// Scenes with several levels, a refusal and published numbers.
Ended run_scenes(const Folder &folder) {
  const fs::path scenes = fs::path(PETROV_SOURCE_DIR) / "comparisons/benchmarks/cantilever";
  return run_here({"run", (scenes / "convergence.toml").string(), (scenes / "order_refused.toml").string(), "--repeats",
                   "1", "--quiet", "--output", "out"},
                  folder.path());
}

/// Playwright and axe, installed once into the build folder.
std::string install_page_tests(const fs::path &folder) {
  const fs::path source = fs::path(PETROV_SOURCE_DIR) / "tests/system/page";
  fs::create_directories(folder);
  bool same = fs::exists(folder / "node_modules/.package-lock.json");
  for (const char *name : {"package.json", "package-lock.json", ".npmrc", "page_test.mjs"}) {
    const bool unchanged = contents(source / name) == contents(folder / name);
    same = same && (unchanged || std::string(name) == "page_test.mjs");
    if (!unchanged)
      fs::copy_file(source / name, folder / name, fs::copy_options::overwrite_existing);
  }
  if (same)
    return {};
  const auto ended = Process({"ci", "--ignore-scripts"}, folder, command("npm")).wait();
  return ended.exit_code == 0 ? "" : "npm ci ended with " + std::to_string(ended.exit_code) + ":\n" + ended.err;
}

TEST(Page, works_in_a_browser) {
  for (const char *name : {"chromium", "node", "npm"})
    if (command(name).empty())
      GTEST_SKIP() << name << " is not installed; ./petrov test installs what packages.txt names";
  if (!fs::exists("/usr/share/javascript/chart.js/chart.min.js"))
    GTEST_SKIP() << "Chart.js is not installed (libjs-chart.js); ./petrov test installs what packages.txt names";
  const fs::path tests = fs::path(PETROV_BINARY_DIR) / "page_tests";
  const std::string complaint = install_page_tests(tests);
  ASSERT_EQ(complaint, "") << "playwright-core and axe-core come from the npm registry";
  const Folder folder;
  const auto run = run_scenes(folder);
  ASSERT_TRUE(fs::exists(folder / "out/report.html")) << run.err;
  // A refused cell among others that can be drawn.
  auto results = reports::read_results(folder / "out/results.json");
  const auto refused = std::find_if(results.cells.begin(), results.cells.end(),
                                    [](const auto &cell) { return cell.status == reports::Status::refused; });
  ASSERT_NE(refused, results.cells.end());
  reports::Cell moved = *refused;
  moved.scene = "convergence";
  results.cells.push_back(moved);
  reports::write_reports(results, folder / "out", {"json", "html"}, "results", {program::page_directory(), {}});
  fs::create_directories(tests / "screenshots");
  const auto browser = Process({"page_test.mjs", (folder / "out/report.html").string(),
                                (folder / "out/results.json").string(), (tests / "screenshots").string()},
                               tests, command("node"))
                           .wait();
  EXPECT_EQ(browser.exit_code, 0) << browser.out << browser.err;
  EXPECT_GT(std::count(browser.out.begin(), browser.out.end(), '\n'), 40) << browser.out;
}

/// Without Chart.js, style and script the page is only to be read, and whole.
TEST(Page, is_written_without_what_it_may_lack) {
  const Folder folder;
  const auto results = reports_sample::results();
  reports::write_reports(results, folder.path(), {"html"}, "results");
  const std::string page = contents(folder / "report.html");
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_NE(page.find("<svg viewBox"), std::string::npos);
  EXPECT_NE(page.find("singular moment matrix at particle 7"), std::string::npos) << "the reason of a failed cell";
  EXPECT_EQ(page.find("://"), std::string::npos) << "nothing to ask a network for";
}

std::multiset<std::string> words_of(const std::string &text) {
  std::istringstream stream(text);
  std::multiset<std::string> words;
  for (std::string word; stream >> word;) {
    for (auto place = word.find("\u2212"); place != std::string::npos; place = word.find("\u2212"))
      word.replace(place, 3, "-"); // minus sign
    words.insert(word);
  }
  return words;
}

bool is_number(const std::string &text) {
  char *end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && text.find_first_of("0123456789") != std::string::npos;
}

TEST(Latex, compiles_and_the_pdf_shows_the_numbers) {
  for (const char *name : {"pdflatex", "pdftotext"})
    if (command(name).empty())
      GTEST_SKIP() << name << " is not installed; ./petrov test installs what packages.txt names";
  const Folder folder;
  auto results = reports_sample::results();
  results.scene["title"] = "Ünï ρ ≤ 0.3, 漢字 😀 & 5 % of #1_x^2 ~{} \\ \"q\"";
  reports::write_reports(results, folder.path(), {"tex"}, "results");
  for (int pass = 0; pass < 2; ++pass) {
    const auto latex =
        Process({"-interaction=nonstopmode", "-halt-on-error", "results.tex"}, folder.path(), command("pdflatex"))
            .wait();
    ASSERT_EQ(latex.exit_code, 0) << latex.out;
  }
  const auto text = Process({"-layout", "results.pdf", "-"}, folder.path(), command("pdftotext")).wait();
  ASSERT_EQ(text.exit_code, 0) << text.err;
  // Every number of every table, as often as the tables have it; their equality with the JSON is the test of numbers.
  std::multiset<std::string> wanted;
  for (const auto &table : reports_sample::parse_latex(reports::latex_report(results)))
    for (const auto &row : table.rows)
      for (const auto &field : row)
        if (is_number(field))
          wanted.insert(field);
  const auto shown = words_of(text.out);
  ASSERT_GT(wanted.size(), 150u);
  for (const std::string &number : std::set<std::string>(wanted.begin(), wanted.end()))
    EXPECT_GE(shown.count(number), wanted.count(number)) << number;
}

} // namespace
