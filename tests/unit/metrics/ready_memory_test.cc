// Memory made ready for timed work: how much is taken, that it is given back as others take theirs, and for which
// cells.

#include "comparisons/metrics/ready_memory.h"

#include "comparisons/metrics/memory.h"
#include "comparisons/scene/reader.h"
#include "comparisons/study/run_scene.h"
#include "sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {

using namespace comparisons;
using metrics::ReadyMemory;

constexpr std::int64_t MiB = 1 << 20;

std::int64_t status_bytes(const std::string &process, const std::string &key) {
  return metrics::listed_bytes("/proc/" + process + "/status", key);
}

/// Number of a child of this process; empty if it has none.
std::string child() {
  std::string number;
  std::ifstream("/proc/self/task/" + std::to_string(getpid()) + "/children") >> number;
  return number;
}

/// Pages that are written to.
class Taken {
public:
  explicit Taken(std::size_t size)
      : size_(size), data_(mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
    for (std::size_t i = 0; i < size; i += 4096)
      static_cast<volatile char *>(data_)[i] = 1;
  }
  Taken(const Taken &) = delete;
  Taken &operator=(const Taken &) = delete;
  ~Taken() { munmap(data_, size_); }

private:
  std::size_t size_;
  void *data_;
};

} // namespace

TEST(ReadyMemory, AChildHoldsItAndNothingIsLeftAfterwards) {
  ASSERT_EQ(child(), "");
  const auto before = status_bytes("self", "VmRSS");
  {
    const ReadyMemory ready(512 * MiB);
    EXPECT_EQ(ready.bytes(), 512 * MiB);
    ASSERT_NE(child(), "");
    EXPECT_GT(status_bytes(child(), "VmRSS"), 350 * MiB); // less what it gives back in advance
  }
  EXPECT_EQ(child(), "");
  EXPECT_LT(waitpid(-1, nullptr, WNOHANG), 0); // and none waits to be asked for
  EXPECT_LT(status_bytes("self", "VmRSS"), before + 64 * MiB);
}

TEST(ReadyMemory, IsGivenBackAsMemoryIsTaken) {
  const ReadyMemory ready(768 * MiB);
  ASSERT_EQ(ready.bytes(), 768 * MiB);
  const auto held = [] { return status_bytes(child(), "VmRSS"); };
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_GT(held(), 600 * MiB) << "nobody has taken anything";
  const std::int64_t at_first = held();
  const auto expect_falls_by = [&](std::int64_t least, std::int64_t most) {
    for (int k = 0; k < 500 && at_first - held() < least; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_GE(at_first - held(), least);
    EXPECT_LE(at_first - held(), most);
  };
  {
    const Taken taken(256 * MiB);
    expect_falls_by(240 * MiB, 350 * MiB);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_LE(at_first - held(), 350 * MiB) << "what was given back is what the next work takes";
  // An isolated cell takes its memory in a child.
  const pid_t other = fork();
  if (other == 0) {
    const Taken taken(448 * MiB);
    std::this_thread::sleep_for(std::chrono::seconds(20));
    _exit(0);
  }
  expect_falls_by(430 * MiB, 700 * MiB);
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
}

/// A run that is killed leaves its lock at once, not after the memory.
TEST(ReadyMemory, TheHolderHasNoFilesOfTheRun) {
  const std::ifstream file("/proc/meminfo");
  const ReadyMemory ready(512 * MiB);
  ASSERT_NE(child(), "");
  const auto n_files = [] {
    std::size_t n = 0;
    for (const auto &entry : std::filesystem::directory_iterator("/proc/" + child() + "/fd"))
      n += std::stoi(entry.path().filename()) > 2 ? 1 : 0;
    return n;
  };
  std::size_t least = n_files();
  for (int k = 0; k < 20 && least > 0; ++k) { // for a moment, one that it reads of the process
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    least = std::min(least, n_files());
  }
  EXPECT_EQ(least, 0U);
}

TEST(ReadyMemory, StopsWhenAsked) {
  const auto begin = std::chrono::steady_clock::now();
  const ReadyMemory ready(std::int64_t{1} << 60, [] { return true; });
  EXPECT_EQ(ready.bytes(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5 * sanitized::slowness));
}

TEST(ReadyMemory, TakesNothingForNothing) {
  EXPECT_EQ(ReadyMemory(0).bytes(), 0);
  EXPECT_EQ(ReadyMemory(-1).bytes(), 0);
  EXPECT_EQ(child(), "");
}

/// A process that may not have the memory goes on without.
TEST(ReadyMemory, ALimitIsNoError) {
  EXPECT_EXIT(
      {
        const auto limit = static_cast<rlim_t>(status_bytes("self", "VmData") + 64 * MiB);
        rlimit value;
        value.rlim_cur = value.rlim_max = limit;
        setrlimit(RLIMIT_DATA, &value);
        std::_Exit(ReadyMemory(512 * MiB).bytes() == 0 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(ReadyMemory, AvailableIsPartOfTheMachine) {
  EXPECT_GT(metrics::available_memory(), 0);
  EXPECT_LE(metrics::available_memory(), sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE));
}

namespace {

/// Says what its run needs, and sees whether a child holds memory meanwhile.
class Needs final : public study::Experiment {
public:
  Needs(double estimated, std::int64_t needed, std::vector<bool> &ready)
      : estimated_(estimated), needed_(needed), ready_(ready) {}

  void run(const scene::MethodRequest &, const scene::Level &, bool, const std::filesystem::path &,
           reports::Cell &cell) const override {
    ready_.push_back(!child().empty());
    cell.memory_bytes = needed_;
    cell.seconds["total"] = {1, 1, 1};
  }
  study::Estimate estimate(const scene::MethodRequest &, const scene::Level &) const override {
    return {.bytes = estimated_};
  }

private:
  double estimated_;
  std::int64_t needed_;
  std::vector<bool> &ready_;
};

/// For each run of a cell, warm-up and two repeats: whether its memory was made ready.
std::vector<bool> ready_runs(double estimated, std::int64_t needed, const std::function<bool()> &stop_requested = {}) {
  std::vector<bool> ready;
  auto catalogue = study::shipped_catalogue();
  for (auto &benchmark : catalogue.benchmarks) {
    benchmark.finish = {};
    benchmark.make_experiment = [&](const auto &, const auto &, const auto &) {
      return std::make_unique<Needs>(estimated, needed, ready);
    };
  }
  const auto read = scene::read_scene_text(R"(
schema = 1
title = "Memory"
benchmark = "cantilever"
[effects]
elasticity = true
[[method]]
name = "fem"
[study]
levels = ["8x2"]
repeats = 2
)",
                                           "test.toml", {}, study::vocabulary_of(catalogue));
  EXPECT_TRUE(read.scene) << scene::to_text(read.diagnostics);
  study::RunOptions options;
  options.write_series = false;
  options.stop_requested = stop_requested;
  study::run_scene(*read.scene, catalogue, options);
  return ready;
}

} // namespace

TEST(ReadyMemory, IsForCellsThatNeedMuch) {
  EXPECT_EQ(ready_runs(300e6, 300'000'000), std::vector<bool>({true, true, true}));
  EXPECT_EQ(ready_runs(100e6, 100'000'000), std::vector<bool>({false, false, false}));
}

TEST(ReadyMemory, ThatACellWasMeasuredToNeedIsBetterThanTheEstimate) {
  EXPECT_EQ(ready_runs(300e6, 1'000'000), std::vector<bool>({true, false, false}));
  EXPECT_EQ(ready_runs(0, 300'000'000), std::vector<bool>({false, true, true}));
}

TEST(ReadyMemory, NothingRunsAfterAStopMeanwhile) {
  bool holder_seen = false;
  const auto stop = [&] { return holder_seen = holder_seen || !child().empty(); };
  EXPECT_EQ(ready_runs(300e6, 300'000'000, stop), std::vector<bool>());
  EXPECT_TRUE(holder_seen);
  EXPECT_EQ(child(), "");
}
