// Half-bandwidth against graphs whose best one is known, whatever order their nodes come in.

#include "comparisons/metrics/bandwidth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

namespace {

using comparisons::metrics::half_bandwidth;

/// A grid of nx x ny nodes, each coupled to the eight around it, with shuffled numbers.
std::int64_t bandwidth_of_grid(int nx, int ny, bool lower_only = false) {
  std::vector<int> number(static_cast<std::size_t>(nx * ny));
  std::iota(number.begin(), number.end(), 0);
  std::mt19937 random(7);
  for (std::size_t i = number.size(); i > 1; --i)
    std::swap(number[i - 1], number[random() % i]);
  std::vector<std::vector<std::int64_t>> rows(number.size());
  for (int a = 0; a < nx; ++a)
    for (int b = 0; b < ny; ++b)
      for (int i = std::max(0, a - 1); i < std::min(nx, a + 2); ++i)
        for (int j = std::max(0, b - 1); j < std::min(ny, b + 2); ++j) {
          const int from = number[static_cast<std::size_t>(a * ny + b)];
          const int to = number[static_cast<std::size_t>(i * ny + j)];
          if (!lower_only || to <= from)
            rows[static_cast<std::size_t>(from)].push_back(to);
        }
  std::vector<std::int64_t> start{0}, columns;
  for (const auto &row : rows) {
    columns.insert(columns.end(), row.begin(), row.end());
    start.push_back(static_cast<std::int64_t>(columns.size()));
  }
  return half_bandwidth(start, columns);
}

} // namespace

TEST(Bandwidth, OfALineIsOne) { EXPECT_EQ(bandwidth_of_grid(40, 1), 1); }

/// Row by row it is ny + 1. Breadth-first levels of a long grid are its columns but near the ends, where they are up to
/// twice as long.
TEST(Bandwidth, OfALongGridIsAboutItsWidth) {
  const auto width = bandwidth_of_grid(60, 5);
  EXPECT_GE(width, 5);
  EXPECT_LE(width, 2 * 5 + 1);
}

TEST(Bandwidth, TakesEitherHalfOfThePattern) { EXPECT_EQ(bandwidth_of_grid(20, 4, true), bandwidth_of_grid(20, 4)); }

TEST(Bandwidth, OfSeparatePartsIsThatOfTheWidest) {
  EXPECT_EQ(half_bandwidth(std::vector<std::int64_t>{0, 1, 2, 3}, std::vector<std::int64_t>{0, 1, 2}), 0);
  EXPECT_EQ(half_bandwidth(std::vector<std::int64_t>{0, 1, 2, 3, 4}, std::vector<std::int64_t>{3, 1, 2, 0}), 1);
}
