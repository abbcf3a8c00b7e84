// A geometry of one's own as a new user meets it: the page of the examples, followed to the letter.

#include "comparisons/reports/json.h"
#include "sanitized.h"
#include "system/program_here.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>

namespace {

using namespace system_tests;
namespace reports = comparisons::reports;

fs::path examples() { return fs::path(PETROV_SOURCE_DIR) / "comparisons" / "examples"; }

/// Writes the page's blocks with a file's name in their first line.
void write_blocks(const std::string &page, const Folder &folder, const std::vector<std::string> &headers) {
  for (const auto &header : headers) {
    const std::string fence = "```" + header + "\n";
    const auto begin = page.find(fence);
    ASSERT_NE(begin, std::string::npos) << header;
    const auto end = page.find("```", begin + fence.size());
    folder.write(header.substr(header.find(' ') + 1), page.substr(begin + fence.size(), end - begin - fence.size()));
  }
}

TEST(OwnGeometry, the_page_leads_to_a_report) {
  const Folder folder;
  write_blocks(contents(examples() / "README.md"), folder, {"geo plate.geo", "toml scene.toml"});
  const auto begin = std::chrono::steady_clock::now();
  const auto explained = run_program({"explain", "scene.toml"}, folder.path());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(explained.exit_code, 0) << explained.err;
  EXPECT_LT(seconds, 5 * sanitized::slowness); // as the page's readers are promised
  for (const auto *word : {"clamp", "lip", "hole", "traction = 0; -2000000", "mesh/2", "weak1", "fem"})
    EXPECT_NE(explained.out.find(word), std::string::npos) << word << "\n" << explained.out;
  EXPECT_NE(explained.err.find("boundaries without a condition are free of traction: hole, sides"), std::string::npos)
      << explained.err;

  const auto run = run_program({"run", "scene.toml"}, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto results = reports::read_results(folder / "out/results.json");
  ASSERT_EQ(results.cells.size(), 4u);
  for (const auto &cell : results.cells) {
    EXPECT_EQ(cell.status, reports::Status::ok) << cell.label << ": " << cell.reason;
    EXPECT_LT(cell.quantities.at("lip_deflection"), 0);
    // The lip carries 2 MPa over 60 mm: finite elements balance to rounding, the others by convergence.
    const double balance = std::abs(cell.quantities.at("clamp_force") / 0.12e6 - 1);
    EXPECT_LT(balance, cell.method == "fem" ? 1e-8 : 0.1) << cell.label << " " << cell.level;
    // Both methods at both levels see the same part.
    EXPECT_NEAR(cell.quantities.at("lip_deflection") / results.cells.back().quantities.at("lip_deflection"), 1, 0.1);
    bool told = false;
    for (const auto &warning : cell.warnings)
      told = told || warning.find("errors are relative to a finer finite-element solution") != std::string::npos;
    EXPECT_TRUE(told) << cell.label;
  }
}

TEST(OwnGeometry, init_writes_a_scene_to_fill_in) {
  const Folder folder;
  const auto written = run_here({"init", "geometry", "-"}, folder.path());
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_NE(written.out.find("[geometry]"), std::string::npos) << written.out;
  folder.write("scene.toml", written.out);
  // It is a scene but for the file, which is not there yet.
  const auto checked = run_here({"check", "scene.toml"}, folder.path());
  EXPECT_EQ(checked.exit_code, 3);
  EXPECT_NE(checked.err.find("fill in: error: there is no such file"), std::string::npos) << checked.err;
  std::size_t n_errors = 0;
  for (auto i = checked.err.find(": error: "); i != std::string::npos; i = checked.err.find(": error: ", i + 1))
    ++n_errors;
  EXPECT_EQ(n_errors, 1u) << checked.err;
}

TEST(OwnGeometry, every_example_is_valid) {
  const Folder folder;
  std::vector<std::string> arguments{"check"};
  for (const auto &example : fs::directory_iterator(examples()))
    if (example.is_directory()) {
      EXPECT_TRUE(fs::exists(example.path() / "README.md")) << example.path();
      for (const auto &entry : fs::directory_iterator(example))
        if (entry.path().extension() == ".toml")
          arguments.push_back(entry.path().string());
    }
  ASSERT_EQ(arguments.size(), 1u + 11u);
  const auto ended = run_here(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

} // namespace
