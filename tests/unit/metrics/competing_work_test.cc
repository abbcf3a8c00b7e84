// Work of others is seen, one's own is not.

#include "comparisons/metrics/machine.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>
#include <vector>

namespace {

double work_for(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  double sum = 0;
  while (std::chrono::steady_clock::now() < end)
    for (int k = 1; k < 1000; ++k)
      sum += 1.0 / k;
  return sum;
}

} // namespace

TEST(CompetingWork, SaysNothingBeforeTheClockHasTicked) {
  const comparisons::metrics::CompetingWork others;
  EXPECT_FALSE(others.cores().has_value());
}

/// All cores are kept busy by this process: what it got and what others got is no more than there is. Ticks of 10 ms on
/// every core may be counted early or late.
TEST(CompetingWork, OnesOwnWorkIsNoCompetition) {
  const int n_cores = comparisons::metrics::describe_machine(1).cores;
  const comparisons::metrics::CompetingWork others;
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t own_begin = std::clock(); // of all threads
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(n_cores));
  for (int k = 0; k < n_cores; ++k)
    threads.emplace_back([] { EXPECT_GT(work_for(.6), 0); });
  for (auto &thread : threads)
    thread.join();
  const double own = static_cast<double>(std::clock() - own_begin) / CLOCKS_PER_SEC;
  const auto cores = others.cores();
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_TRUE(cores.has_value());
  EXPECT_GE(*cores, 0);
  EXPECT_LE(*cores + own / elapsed, n_cores + 4 * .01 * n_cores / elapsed);
}
