// Interrupting and repeating a run in one folder: what is named as a result is always whole.

#include "comparisons/reports/json.h"
#include "sanitized.h"
#include "system/program_process.h"
#include "system/whole_files.h"

#include <gtest/gtest.h>

#include <string>

#include <sstream>
#include <thread>

namespace {

using namespace system_tests;
using namespace comparisons;
using std::chrono::milliseconds;

const std::vector<std::string> comparison{"compare", "cantilever", "--output", "out", "--repeats", "1"};

TEST(Interruption, never_leaves_a_half_written_file) {
  const Folder folder;
  const auto out = folder / "out";
  // Ctrl-C: from the very start to the middle of the cells.
  for (const int after : {5, 150, 400, 900}) {
    SCOPED_TRACE("interrupted after " + std::to_string(after) + " ms");
    const auto before = last_curve(out);
    Process process(comparison, folder.path());
    if (after > 100)
      wait_for_run(out, before);
    std::this_thread::sleep_for(milliseconds(after > 100 ? after * sanitized::slowness : after));
    process.send(SIGINT);
    const auto ended = process.wait();
    expect_whole_folder(out);
    if (after < 100) {
      // The handler may not be in place yet; then there is nothing to write either.
      EXPECT_TRUE(ended.exit_code == 130 || ended.signal == SIGINT) << ended.exit_code;
      continue;
    }
    EXPECT_EQ(ended.exit_code, 130) << ended.err;
    EXPECT_NE(ended.out.find("INTERRUPTED"), std::string::npos);
    const auto results = reports::read_results(out / "results.json");
    EXPECT_TRUE(results.interrupted);
    EXPECT_TRUE(results.published.empty()) << "a part of the cells must not be judged";
    for (const auto &cell : results.cells)
      EXPECT_TRUE(cell.expected) << cell.label << ": " << cell.reason;
    EXPECT_NE(contents(out / "results.txt").find("INTERRUPTED"), std::string::npos);
    EXPECT_EQ(n_temporary_files(out), 0u);
  }
  { // Killed: nothing can be tidied up, but no result is half.
    const auto before = last_curve(out);
    Process process(comparison, folder.path());
    wait_for_run(out, before);
    std::this_thread::sleep_for(milliseconds(250));
    process.send(SIGKILL);
    EXPECT_EQ(process.wait().signal, SIGKILL);
    expect_whole_folder(out);
  }
  // Another run in the same folder sets all right.
  auto again = comparison;
  again.insert(again.end(), {"--set", "study.levels=[\"16x4\"]", "--quiet"});
  const auto ended = run_program(again, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err
                                << ended.out.substr(ended.out.size() - std::min<std::size_t>(2000, ended.out.size()));
  expect_whole_folder(out);
  const auto results = reports::read_results(out / "results.json");
  EXPECT_FALSE(results.interrupted);
  EXPECT_FALSE(results.published.empty());
  EXPECT_EQ(contents(out / "results.txt").find("INTERRUPTED"), std::string::npos);
  // The terminal has a part of the file, the same summary at its end.
  const auto summary = ended.out.find("\nSummary\n");
  ASSERT_NE(summary, std::string::npos) << ended.out;
  EXPECT_NE(contents(out / "results.txt").find(ended.out.substr(summary)), std::string::npos);
  EXPECT_LT(ended.out.size(), contents(out / "results.txt").size());
  EXPECT_EQ(ended.err, "");
}

const std::string long_scene = "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\n"
                               "quadrature_points = 64\n[study]\nlevels = [\"61x13\"]\nrepeats = 100\n";

TEST(Interruption, ends_a_cell_in_a_process_of_its_own_at_once) {
  const Folder folder;
  folder.write("scene.toml", long_scene);
  Process process({"run", "scene.toml", "--isolate"}, folder.path());
  wait_for_run(folder / "out");
  std::this_thread::sleep_for(milliseconds(300));
  const auto begin = std::chrono::steady_clock::now();
  process.send(SIGINT);
  const auto ended = process.wait();
  // The cell takes some five seconds and would be repeated a hundred times.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_TRUE(process.left_nobody(1));
}

TEST(Interruption, a_killed_program_takes_its_cell_along) {
  const Folder folder;
  folder.write("scene.toml", long_scene);
  Process process({"run", "scene.toml", "--isolate"}, folder.path());
  wait_for_run(folder / "out");
  std::this_thread::sleep_for(milliseconds(300));
  process.send_to_program(SIGKILL);
  EXPECT_EQ(process.wait().signal, SIGKILL);
  EXPECT_TRUE(process.left_nobody(2)) << "the cell's process goes on without anyone to end it";
}

/// Two runs would write over each other's files: the second ends before it computes, the first does not notice.
TEST(Interruption, one_run_at_a_time_writes_to_a_folder) {
  const Folder folder;
  folder.write("scene.toml", long_scene);
  Process first({"run", "scene.toml", "--isolate"}, folder.path());
  wait_for_run(folder / "out");
  const Folder elsewhere; // what the second prints is not to be taken for the first's
  const auto second =
      run_program({"run", (folder / "scene.toml").string(), "--output", (folder / "out").string()}, elsewhere.path());
  EXPECT_EQ(second.exit_code, 3) << second.out;
  EXPECT_NE(second.err.find("another run is writing its results here"), std::string::npos) << second.err;
  EXPECT_NE(second.err.find("--output"), std::string::npos) << second.err;
  // A killed one, its cell with it, leaves the folder to the next.
  first.send_to_program(SIGKILL);
  EXPECT_EQ(first.wait().signal, SIGKILL);
  folder.write("short.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"strong\"\n[study]\n"
                             "levels = [\"16x4\"]\n");
  const auto next = run_program({"run", "short.toml"}, folder.path());
  EXPECT_EQ(next.exit_code, 0) << next.err;
}

TEST(Interruption, a_thousand_repeats_end_between_two) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"strong\"\n[study]\n"
                             "levels = [\"31x7\"]\nrepeats = 1000\n");
  Process process({"run", "scene.toml"}, folder.path());
  // Until the first one is finished, however slow the machine.
  for (int i = 0; i < 4000 && contents(folder / "out/.cells").find("identity") == std::string::npos; ++i)
    std::this_thread::sleep_for(milliseconds(5));
  std::this_thread::sleep_for(milliseconds(500));
  process.send(SIGTERM);
  EXPECT_EQ(process.wait().exit_code, 130);
  const auto results = reports::read_results(folder / "out/results.json");
  ASSERT_EQ(results.cells.size(), 1u);
  EXPECT_EQ(results.cells[0].status, reports::Status::ok);
  EXPECT_GE(results.cells[0].repeats, 1);
  EXPECT_LT(results.cells[0].repeats, 1000);
}

TEST(Interruption, results_of_an_earlier_run_do_not_stay_beside_new_ones) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"strong\"\n[study]\n"
                             "levels = [\"16x4\"]\n");
  fs::create_directory(folder / "out");
  folder.write("out/results_published.csv", "from,an,earlier,run\n");
  EXPECT_EQ(run_program({"run", "scene.toml"}, folder.path()).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/results_published.csv"));
}

} // namespace
