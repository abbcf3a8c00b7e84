// A killed run goes on with the cells that are missing, and does not time the finished ones again.

#include "comparisons/reports/json.h"
#include "system/program_process.h"
#include "system/whole_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <sstream>

namespace {

using namespace system_tests;
using namespace comparisons;
using std::chrono::milliseconds;

/// Twelve cells of some milliseconds and, so that there is time to kill it, one of some seconds at the end.
const std::string scene = "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"fem\"\nelement = [\"Q1\", "
                          "\"Q2\", \"Q3\"]\nlevels = [\"4x2\", \"8x2\", \"16x4\", \"31x7\"]\n[[method]]\nname = "
                          "\"weak1\"\nquadrature_points = 64\nlevels = [\"41x9\"]\n[study]\nrepeats = 1\n";

std::vector<std::string> command(const std::vector<std::string> &more = {}) {
  std::vector<std::string> words{"run", "scene.toml", "--output", "out"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string key(const reports::Cell &cell) { return cell.label + ", " + cell.level; }

/// The file of the cells so far, its whole lines.
struct Kept {
  std::map<std::string, reports::Cell> cells;
  std::map<std::string, double> seconds; ///< total of the only repeat, where there is one
};

Kept kept_cells(const fs::path &out) {
  Kept kept;
  std::istringstream lines(contents(out / ".cells"));
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::ordered_json::parse(line, nullptr, false);
    if (json.is_discarded())
      continue;
    const auto cell = reports::from_json(json.at("results")).cells.at(0);
    kept.cells[key(cell)] = cell;
    if (json.at("samples").contains("total"))
      kept.seconds[key(cell)] = json.at("samples").at("total").at(0);
  }
  return kept;
}

/// Kills a run as soon as the file holds the text.
Kept killed_run(const Folder &folder, const std::string &text) {
  const auto file = folder / "out/.cells";
  Process process(command(), folder.path());
  for (int i = 0; i < 4000 && contents(file).find(text) == std::string::npos; ++i)
    std::this_thread::sleep_for(milliseconds(2));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().signal, SIGKILL);
  return kept_cells(folder / "out");
}

} // namespace

TEST(Resume, KeepsErrorsAndSecondsAndRunsTheRest) {
  const Folder folder;
  folder.write("scene.toml", scene);
  // In the round of repeats: some cells are finished, others have their first run.
  const auto kept = killed_run(folder, "\"samples\":{\"");
  ASSERT_EQ(kept.cells.size(), 13u);
  ASSERT_GE(kept.seconds.size(), 1u);
  ASSERT_LT(kept.seconds.size(), 13u);
  const auto ended = run_program(command({"--resume"}), folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("13 of 13 cells were kept from an earlier run"), std::string::npos) << ended.err;
  const auto results = reports::read_results(folder / "out/results.json");
  ASSERT_EQ(results.cells.size(), 13u);
  EXPECT_NE(fmt::format("{}", fmt::join(results.not_comparable, "\n")).find("by an earlier run"), std::string::npos);
  for (const auto &cell : results.cells) {
    EXPECT_EQ(cell.errors, kept.cells.at(key(cell)).errors) << key(cell);
    EXPECT_EQ(cell.repeats, 1) << key(cell);
    if (const auto seconds = kept.seconds.find(key(cell)); seconds != kept.seconds.end()) {
      EXPECT_EQ(cell.seconds.at("total").median, seconds->second) << key(cell);
    }
  }
  EXPECT_FALSE(fs::exists(folder / "out/.cells")) << "a complete run has nothing to go on with";
}

TEST(Resume, RunsWhatHasNotBegun) {
  const Folder folder;
  folder.write("scene.toml", scene);
  const auto kept = killed_run(folder, "identity");
  ASSERT_GE(kept.cells.size(), 1u);
  ASSERT_LT(kept.cells.size(), 13u);
  const auto ended = run_program(command({"--resume"}), folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::string note = fmt::format("{} of 13 cells were kept from an earlier run", kept.cells.size());
  EXPECT_NE(ended.err.find(note), std::string::npos) << ended.err;
  EXPECT_EQ(reports::read_results(folder / "out/results.json").cells.size(), 13u);
}

TEST(Resume, TakesNothingOfAnotherRun) {
  const Folder folder;
  folder.write("scene.toml", scene);
  ASSERT_GE(killed_run(folder, "identity").cells.size(), 1u);
  const auto file = contents(folder / "out/.cells");
  const auto changed = run_program(command({"--resume", "--set", "material.nu=0.2"}), folder.path());
  EXPECT_EQ(changed.exit_code, 0) << changed.err;
  EXPECT_EQ(changed.err.find("earlier run"), std::string::npos) << changed.err;
  folder.write("out/.cells", file);
  const auto without = run_program(command(), folder.path());
  EXPECT_EQ(without.err.find("earlier run"), std::string::npos) << without.err;
}

TEST(Resume, PassesOverALineThatAKillCutOff) {
  const Folder folder;
  folder.write("scene.toml", scene);
  killed_run(folder, "identity");
  const auto file = contents(folder / "out/.cells");
  folder.write("out/.cells", file.substr(0, file.size() - 20));
  const auto kept = kept_cells(folder / "out");
  const auto ended = run_program(command({"--resume"}), folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(reports::read_results(folder / "out/results.json").cells.size(), 13u);
  const std::string note = fmt::format("{} of 13 cells were kept", kept.cells.size());
  EXPECT_EQ(ended.err.find(note) != std::string::npos, !kept.cells.empty()) << ended.err;
}

/// gnuplot's stand-in writes half of a file and kills the program.
TEST(Resume, AKillWhileFiguresAreDrawnLeavesOnlyWholeFiles) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"fem\"\n[study]\nlevels = "
                             "[\"4x2\", \"8x2\"]\nrepeats = 1\n");
  fs::create_directory(folder / "stand_in");
  folder.write("stand_in/gnuplot", "#!/bin/bash\nprefix=${2#*\\'}\nprintf half >\"${prefix%\\'}${3%.gp}.svg\"\n"
                                   "kill -9 $PPID\n");
  fs::permissions(folder / "stand_in/gnuplot", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", ((folder / "stand_in").string() + ":" + path).c_str(), 1);
  Process process(command({"--format", "json,figures"}), folder.path());
  const auto ended = process.wait();
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(ended.signal, SIGKILL);
  std::size_t n_halves = 0;
  for (const auto &entry : fs::directory_iterator(folder / "out/figures"))
    n_halves += contents(entry.path()) == "half";
  EXPECT_EQ(n_halves, 1u);
  expect_whole_folder(folder / "out");
  const auto again = run_program(command({"--format", "json,figures"}), folder.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  for (const auto &entry : fs::directory_iterator(folder / "out/figures"))
    EXPECT_NE(contents(entry.path()), "half") << entry.path();
}

// tests/system/kill_twenty_times.sh does it with all benchmarks.
TEST(Resume, KillsAtRandomMomentsLeaveOnlyWholeFilesAndARunThatCompletes) {
  const Folder folder;
  const auto out = folder / "out";
  std::vector<std::string> words{"compare", "rod_static", "smoothing_functions", "--output", "out", "--resume"};
  std::mt19937_64 random(std::random_device{}());
  for (int kill = 0; kill < 5; ++kill) {
    const auto after = milliseconds(100 + random() % 900);
    SCOPED_TRACE(fmt::format("kill {} after {} ms", kill, after.count()));
    Process process(words, folder.path());
    std::this_thread::sleep_for(after);
    process.send(SIGKILL);
    process.wait();
    expect_whole_folder(out);
  }
  const auto ended = run_program(words, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  expect_whole_folder(out);
  auto words_anew = words;
  words_anew.pop_back();
  words_anew[4] = "anew";
  EXPECT_EQ(run_program(words_anew, folder.path()).exit_code, 0);
  const auto resumed = reports::read_results(out / "results.json");
  const auto anew = reports::read_results(folder / "anew/results.json");
  ASSERT_EQ(resumed.cells.size(), anew.cells.size());
  for (std::size_t i = 0; i < anew.cells.size(); ++i) {
    EXPECT_EQ(resumed.cells[i].errors, anew.cells[i].errors) << key(anew.cells[i]);
    EXPECT_EQ(resumed.cells[i].quantities, anew.cells[i].quantities) << key(anew.cells[i]);
  }
}
