// Methods that fail in every way a library can: the other cells keep their results, the cell itself has its status and
// reason, and the exit code tells.

#include "comparisons/program/run_command.h"
#include "comparisons/reports/json.h"
#include "sanitized.h"
#include "system/program_process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

namespace {

using namespace system_tests;
using namespace comparisons;

/// A solution of which nothing is finite.
class NotANumber final : public methods::Solution {
public:
  std::vector<std::string> fields() const override { return {"displacement", "stress"}; }
  std::size_t n_components(std::string_view field) const override { return field == "displacement" ? 2 : 3; }
  void evaluate(std::string_view, std::span<const std::array<double, 2>>, std::span<double> values) const override {
    std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
  }
};

using Solved = std::unique_ptr<methods::Solution>;

methods::Method method(const std::string &name, std::function<Solved()> solve) {
  methods::Method result;
  result.description.name = name;
  result.description.meaning = "broken on purpose";
  result.description.effects = {"elasticity"};
  result.solve = [solve = std::move(solve)](const methods::SolveRequest &) { return solve(); };
  return result;
}

/// The shipped catalogue and methods that break.
study::Catalogue broken_catalogue() {
  auto catalogue = study::shipped_catalogue();
  auto &table = catalogue.methods;
  table.push_back(method("throws", []() -> Solved { throw std::runtime_error("the gate is shut"); }));
  table.push_back(method("throws_no_exception", []() -> Solved { throw 42; }));
  table.push_back(method("not_a_number", [] { return std::make_unique<NotANumber>(); }));
  table.push_back(method("returns_nothing", []() -> Solved { return nullptr; }));
  table.push_back(method("crashes", []() -> Solved {
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
    return nullptr;
  }));
  table.push_back(method("aborts", []() -> Solved { std::abort(); }));
  table.push_back(method("exits", []() -> Solved { std::_Exit(0); }));
  table.push_back(method("hangs", []() -> Solved {
    while (true)
      std::this_thread::sleep_for(std::chrono::seconds(1));
  }));
  table.push_back(method("allocates", []() -> Solved {
    std::vector<std::unique_ptr<char[]>> blocks;
    while (true) {
      constexpr std::size_t size = 1 << 22;
      blocks.push_back(std::make_unique<char[]>(size));
      std::memset(blocks.back().get(), 1, size); // memory counts when it is touched
    }
  }));
  // A C library whose malloc fails says so with an error of its own.
  table.push_back(method("library_out_of_memory", []() -> Solved {
    std::vector<std::unique_ptr<void, decltype(&std::free)>> blocks;
    while (true) {
      void *block = std::malloc(1 << 22);
      if (block == nullptr)
        throw std::runtime_error("out of memory in the factorisation");
      std::memset(block, 1, 1 << 22);
      blocks.emplace_back(block, &std::free);
    }
  }));
  return catalogue;
}

struct Run {
  int code = 0;
  std::string text;
  reports::Results results;
  bool series_of_failed = false;
};

/// Runs weak1, the broken methods and fem, in that order.
Run run(const std::vector<std::string> &broken, const std::string &study, bool isolate) {
  const Folder folder;
  std::string text = "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\n";
  for (const auto &name : broken)
    text += "[[method]]\nname = \"" + name + "\"\n";
  text += "[[method]]\nname = \"fem\"\n[study]\nlevels = [\"16x4\"]\n" + study;
  program::CommonOptions options;
  options.output = (folder / "out").string();
  options.isolate = isolate;
  options.quiet = true;
  testing::internal::CaptureStdout();
  Run result;
  result.code = program::run_scenes({folder.write("scene.toml", text)}, options, broken_catalogue());
  result.text = testing::internal::GetCapturedStdout();
  result.results = reports::read_results(folder / "out/results.json");
  for (const auto &name : broken)
    result.series_of_failed =
        result.series_of_failed || fs::exists(folder / ("out/series/cantilever-scene-" + name + "-16x4-bottom.csv"));
  return result;
}

void expect_others_intact(const Run &run, const Run &healthy) {
  const auto &cells = run.results.cells;
  ASSERT_GE(cells.size(), 2u);
  EXPECT_EQ(cells.front().errors, healthy.results.cells.front().errors);
  EXPECT_EQ(cells.back().errors, healthy.results.cells.back().errors);
  EXPECT_EQ(cells.front().repeats, 1);
  EXPECT_EQ(cells.back().repeats, 1);
  EXPECT_TRUE(cells.front().expected);
  EXPECT_TRUE(cells.back().expected);
  EXPECT_FALSE(run.series_of_failed);
}

/// A cell that is not ok: its reason is in the report, and no number of it.
void expect_told(const Run &run, std::size_t i, reports::Status status, const std::string &reason) {
  const auto &cell = run.results.cells.at(i);
  EXPECT_EQ(cell.status, status) << cell.label << ": " << cell.reason;
  EXPECT_NE(cell.reason.find(reason), std::string::npos) << cell.label << ": " << cell.reason;
  EXPECT_TRUE(cell.errors.empty());
  EXPECT_FALSE(cell.expected);
  EXPECT_NE(run.text.find(cell.label + ", 16x4: " + reports::to_text(status) + " (UNEXPECTED)"), std::string::npos);
}

TEST(FailingMethods, exceptions_and_values_that_are_not_finite_need_no_process_of_their_own) {
  const auto healthy = run({}, "", false);
  EXPECT_EQ(healthy.code, program::all_as_expected);
  const auto run_ = run({"throws", "not_a_number", "throws_no_exception", "returns_nothing"}, "", false);
  EXPECT_EQ(run_.code, program::cell_failed);
  expect_others_intact(run_, healthy);
  expect_told(run_, 1, reports::Status::failed, "the gate is shut");
  expect_told(run_, 2, reports::Status::failed, "is not finite");
  expect_told(run_, 3, reports::Status::failed, "an exception that is none of the standard library");
  expect_told(run_, 4, reports::Status::failed, "returned no solution");
}

TEST(FailingMethods, a_crash_ends_its_own_process) {
  const auto healthy = run({}, "", true);
  EXPECT_EQ(healthy.code, program::all_as_expected);
  const auto run_ = run({"crashes", "aborts", "exits", "throws"}, "", true);
  EXPECT_EQ(run_.code, program::cell_failed);
  expect_others_intact(run_, healthy);
  expect_told(run_, 1, reports::Status::failed, "crashed: Segmentation fault");
  expect_told(run_, 2, reports::Status::failed, "crashed: Aborted");
  expect_told(run_, 3, reports::Status::failed, "ended without a result");
  expect_told(run_, 4, reports::Status::failed, "the gate is shut");
}

TEST(FailingMethods, a_hang_ends_after_max_seconds) {
  const auto healthy = run({}, "", false);
  const auto begin = std::chrono::steady_clock::now();
  const auto run_ = run({"hangs", "crashes"}, "max_seconds = 2\n", false); // a limit isolates by itself
  // Two seconds, two healthy cells, and a machine that may be busy.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_EQ(run_.code, program::limit_reached) << "a limit is graver than a failure";
  expect_others_intact(run_, healthy);
  expect_told(run_, 1, reports::Status::limit, "max_seconds = 2");
  expect_told(run_, 2, reports::Status::failed, "Segmentation fault");
}

TEST(FailingMethods, exhausted_memory_ends_at_max_memory) {
  if (!sanitized::memory_can_be_limited)
    GTEST_SKIP() << sanitized::no_limit_of_memory;
  const auto healthy = run({}, "", false);
  const auto run_ = run({"allocates", "library_out_of_memory"}, "max_memory = \"200 MB\"\n", false);
  EXPECT_EQ(run_.code, program::limit_reached);
  expect_others_intact(run_, healthy);
  expect_told(run_, 1, reports::Status::limit, "max_memory = 200000000 bytes");
  expect_told(run_, 2, reports::Status::limit, "max_memory = 200000000 bytes");
}

TEST(FailingMethods, a_solver_that_runs_out_of_memory_says_limit) {
  if (!sanitized::memory_can_be_limited)
    GTEST_SKIP() << sanitized::no_limit_of_memory;
  const Folder folder;
  const std::string text =
      "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\nquadrature_points = 4\n"
      "[[method]]\nname = \"fem\"\nelement = \"Q4\"\nsolver = [\"cholesky\", \"umfpack\"]\n"
      "[study]\nlevels = [\"91x19\"]\n";
  program::CommonOptions options;
  options.output = (folder / "out").string();
  options.quiet = true;
  const auto file = folder.write("scene.toml", text);
  for (const auto *memory : {"1 B", "2 MB", "8 MB", "15 MB", "20 MB"}) {
    options.sets = {std::string("study.max_memory=\"") + memory + "\""};
    testing::internal::CaptureStdout();
    program::run_scenes({file}, options, study::shipped_catalogue());
    testing::internal::GetCapturedStdout();
    for (const auto &cell : reports::read_results(folder / "out/results.json").cells)
      EXPECT_TRUE(cell.status == reports::Status::ok || cell.status == reports::Status::limit)
          << memory << ", " << cell.label << ": " << cell.reason;
  }
}

/// A variable of the environment, as it was at the end.
class Variable {
public:
  Variable(const char *name, const char *value) : name_(name) {
    if (const char *old = std::getenv(name); old != nullptr)
      old_ = old;
    setenv(name, value, 1);
  }
  ~Variable() {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable &) = delete;
  Variable &operator=(const Variable &) = delete;

private:
  const char *name_;
  std::optional<std::string> old_;
};

// OpenBLAS with one thread, as on a machine with one core, takes its work memory when it first needs it, and asks for
// ever if it gets none.
TEST(FailingMethods, a_limit_of_memory_below_what_blas_takes_is_no_hang) {
  if (!sanitized::memory_can_be_limited)
    GTEST_SKIP() << sanitized::no_limit_of_memory;
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"fem\"\n[[method]]\nname = "
                             "\"weak1\"\nsolver = \"umfpack\"\n[study]\nlevels = [\"31x7\"]\nmax_seconds = 30\n");
  for (const char *in_environment : {"1", "2"})
    for (const char *threads : {"1", "2"})
      for (const char *memory : {"100 MB", "30 MB", "1 MB"}) {
        const Variable variable("OMP_NUM_THREADS", in_environment);
        run_program({"run", "scene.toml", "--output", "out", "--threads", threads, "--set",
                     std::string("study.max_memory=\"") + memory + "\""},
                    folder.path());
        for (const auto &cell : reports::read_results(folder / "out/results.json").cells) {
          const std::string at =
              fmt::format("{}, {} threads ({}), {}: {}", memory, threads, in_environment, cell.label, cell.reason);
          EXPECT_EQ(cell.reason.find("max_seconds"), std::string::npos) << at;
          if (memory == std::string("100 MB"))
            EXPECT_EQ(cell.status, reports::Status::ok) << at;
          else
            EXPECT_TRUE(cell.status == reports::Status::ok || cell.status == reports::Status::limit) << at;
        }
      }
}

// Batch systems limit the addresses of a whole process.
TEST(FailingMethods, a_limit_of_the_whole_process_that_leaves_blas_nothing_is_an_error) {
  if (!sanitized::memory_can_be_limited)
    GTEST_SKIP() << sanitized::no_limit_of_memory;
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\n[study]\nlevels = "
                             "[\"16x4\"]\n");
  // 64 threads ask for 8 GB; the program without them takes less than 2.
  const auto limited = [&](const std::string &arguments) {
    const std::string program = PETROV_PROGRAM;
    return Process({"-c", "ulimit -v 4000000; exec \"" + program + "\" run scene.toml --output out" + arguments},
                   folder.path(), "/bin/bash")
        .wait();
  };
  const auto ended = limited(" --threads 64");
  EXPECT_EQ(ended.exit_code, program::invalid_scene) << ended.err;
  EXPECT_NE(ended.err.find("OpenBLAS needs 8192 MB of addresses for 64 threads"), std::string::npos) << ended.err;
  EXPECT_EQ(limited("").exit_code, program::all_as_expected);
  // Without a limit more than the memory of the machine is no error: few of these addresses are used.
  EXPECT_EQ(run_program({"run", "scene.toml", "--output", "out", "--threads", "1024"}, folder.path()).exit_code,
            program::all_as_expected);
}

TEST(FailingMethods, a_case_that_needs_more_memory_leaves_the_other_cells_intact) {
  if (!sanitized::memory_can_be_limited)
    GTEST_SKIP() << sanitized::no_limit_of_memory;
  const Folder folder;
  // The factors of 2 x 201 x 51 unknowns take some 300 MB.
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"fem\"\nlevels = [\"31x7\"]\n"
                             "[[method]]\nname = \"weak1\"\nsolver = \"umfpack\"\nlevels = [\"16x4\", \"201x51\", "
                             "\"31x7\"]\n[study]\nmax_memory = \"100 MB\"\n");
  const auto ended = run_program({"run", "scene.toml", "--output", "out"}, folder.path());
  EXPECT_EQ(ended.exit_code, program::limit_reached) << ended.err;
  const auto limited = reports::read_results(folder / "out/results.json").cells;
  run_program({"run", "scene.toml", "--output", "free", "--set", "study.max_memory=\"4 GB\""}, folder.path());
  const auto free = reports::read_results(folder / "free/results.json").cells;
  ASSERT_EQ(limited.size(), 4u);
  ASSERT_EQ(free.size(), 4u);
  for (std::size_t i = 0; i < limited.size(); ++i)
    if (limited[i].level == "201x51") {
      EXPECT_EQ(limited[i].status, reports::Status::limit);
      EXPECT_NE(limited[i].reason.find("max_memory = 100000000 bytes"), std::string::npos) << limited[i].reason;
      EXPECT_EQ(free[i].status, reports::Status::ok) << free[i].reason;
    } else {
      EXPECT_EQ(limited[i].status, reports::Status::ok) << limited[i].reason;
      EXPECT_EQ(limited[i].errors, free[i].errors) << limited[i].level;
    }
}

TEST(FailingMethods, an_expected_refusal_is_no_failure_and_its_absence_is) {
  const Folder folder;
  const std::string refusal = "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\norder = 4\n"
                              "support = 6\nexpect = \"refused\"\n[study]\nlevels = [\"16x4\"]\n";
  std::string no_refusal = refusal;
  no_refusal.replace(no_refusal.find("order = 4"), 9, "order = 2");
  std::string unexpected = refusal;
  unexpected.replace(unexpected.find("expect"), 18, "");
  program::CommonOptions options;
  options.output = (folder / "out").string();
  options.quiet = true;
  const auto code_of = [&](const std::string &text) {
    testing::internal::CaptureStdout();
    const int code = program::run_scenes({folder.write("scene.toml", text)}, options, study::shipped_catalogue());
    testing::internal::GetCapturedStdout();
    return code;
  };
  EXPECT_EQ(code_of(refusal), program::all_as_expected);
  EXPECT_EQ(code_of(no_refusal), program::cell_failed);
  EXPECT_EQ(code_of(unexpected), program::cell_failed);
}

} // namespace
