// `petrov verify` as a user types it.

#include "system/program_process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>

namespace {

using namespace system_tests;

bool has(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

std::string name_of(const nlohmann::json &cell) {
  std::string name;
  for (const auto *part : {"scene", "variant", "label"})
    name += cell.at(part).get<std::string>() + "; ";
  return name;
}

TEST(Verify, prints_the_matrix_and_writes_it_as_data) {
  const Folder folder;
  const auto ended = run_program(
      {"verify", "--quick", "--cases", "cook nu=0.499999", "--methods", "mixed,fem", "--json", "matrix.json"},
      folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const auto *part : {"incompressibility", "u2(48, 52) = 18.508", "mixed", "fem Q2Q1", "holds",
                           "warned: nu = 0.499999", "4 cells", "0 fail"})
    EXPECT_TRUE(has(ended.out, part)) << part << "\n" << ended.out;
  EXPECT_TRUE(has(ended.err, "cook")); // progress
  const auto json = nlohmann::json::parse(contents(folder / "matrix.json"));
  EXPECT_EQ(json.at("kind"), "hard_cases");
  EXPECT_EQ(json.at("cells").size(), 4u); // mixed, Q1, Q2, Q2Q1
  int total = 0;
  for (const auto &[verdict, n] : json.at("counts").items())
    total += n.get<int>();
  EXPECT_EQ(total, static_cast<int>(json.at("cells").size()));
  for (const auto &cell : json.at("cells")) {
    EXPECT_TRUE(cell.at("error").is_number());
    EXPECT_TRUE(cell.at("indicators").is_object());
  }
}

/// Killed on its way, and gone on with.
TEST(Verify, its_quick_matrix_is_a_benchmark_of_compare) {
  const Folder folder;
  const std::vector<std::string> words{"compare", "hard_cases", "--output", "out", "--resume"};
  const auto lines = [&] {
    const auto text = contents(folder / "out/.cells");
    return std::count(text.begin(), text.end(), '\n') / 2; // one before every cell
  };
  Process process(words, folder.path());
  for (int i = 0; i < 20000 && lines() < 40; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  process.send(SIGKILL);
  process.wait();
  const auto n_kept = lines();
  ASSERT_GE(n_kept, 40);
  std::map<std::string, double> kept; // seconds
  std::istringstream text(contents(folder / "out/.cells"));
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) {
      const auto cell = nlohmann::json::parse(line).at("results").at("cells").at(0);
      if (cell.at("status") == "ok")
        kept[name_of(cell)] = cell.at("quantities").at("wall_seconds");
    }
  const auto ended = run_program(words, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_TRUE(has(ended.err, fmt::format("{} of ", n_kept))) << ended.err;
  EXPECT_TRUE(has(ended.out, "Hard cases: ")) << ended.out;
  EXPECT_LT(ended.out.size(), 4000u); // the terminal gets the counts
  const auto json = nlohmann::json::parse(contents(folder / "out/results.json"));
  EXPECT_GT(json.at("cells").size(), 500u);
  std::size_t n_same = 0;
  for (const auto &cell : json.at("cells")) {
    EXPECT_EQ(cell.at("benchmark"), "hard_cases");
    EXPECT_NE(cell.at("parameters").at("verdict"), "fails") << cell;
    EXPECT_FALSE(cell.at("parameters").at("reference").get<std::string>().empty());
    if (const auto before = kept.find(name_of(cell)); before != kept.end()) {
      ++n_same;
      EXPECT_EQ(cell.at("quantities").at("wall_seconds"), before->second) << before->first;
    }
  }
  EXPECT_GT(n_same, 10u);
  EXPECT_EQ(n_same, kept.size());
  for (const auto *file : {"out/report.html", "out/results.md", "out/results.txt", "out/results_tables.tex"})
    EXPECT_TRUE(has(contents(folder / file), "Hard cases: incompressibility")) << file;
}

TEST(Verify, lists_its_cases_without_running_them) {
  const Folder folder;
  const auto ended = run_program({"verify", "--list"}, folder.path());
  EXPECT_EQ(ended.exit_code, 0);
  for (const auto *part : {"patch: linear, grid", "reference:", "threshold", "Swegle", "material contrast"})
    EXPECT_TRUE(has(ended.out, part)) << part;
}

TEST(Verify, says_when_nothing_is_selected) {
  const Folder folder;
  const auto ended = run_program({"verify", "--cases", "no such case"}, folder.path());
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_TRUE(has(ended.err, "petrov verify --list"));
  EXPECT_EQ(run_program({"verify", "--max-seconds", "-1"}, folder.path()).exit_code, 2);
}

TEST(Verify, a_hang_is_a_failure_with_exit_code_4) {
  // A limit that no cell can keep stands for a hang.
  const Folder folder;
  const auto ended = run_program({"verify", "--cases", "thick cylinder nu=0.3", "--methods", "weak1 consistent",
                                  "--max-seconds", "0.001", "--quiet"},
                                 folder.path());
  EXPECT_EQ(ended.exit_code, 4);
  EXPECT_TRUE(has(ended.out, "ended after max_seconds")) << ended.out;
}

TEST(Explain, knows_mixed_and_consistent_quadrature) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\ntitle = \"mixed\"\nbenchmark = \"cantilever\"\n[[method]]\nname = \"mixed\"\n"
                             "[[method]]\nname = \"weak1\"\nquadrature = \"consistent\"\n[[method]]\nname = \"fem\"\n"
                             "element = \"Q2Q1\"\n[study]\nlevels = [\"16x4\"]\n");
  const auto ended = run_program({"explain", "scene.toml"}, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(has(ended.out, "192")) << ended.out; // three unknowns of 64 particles
}

} // namespace
