// What packs have beyond arithmetic: gathering by index, indices of the lanes where a condition holds.

#include "meshless/linear_algebra/pack.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <vector>

namespace {

using namespace meshless::linear_algebra;

template <int step>
void expect_gathered() {
  std::vector<double> numbers(500);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::array<std::int32_t, n_lanes> index;
  for (int lane = 0; lane < n_lanes; ++lane)
    index[static_cast<std::size_t>(lane)] = (37 * lane + 11) % 160;
  const Pack found = gather<step>(numbers.data() + 1, index.data());
  for (int lane = 0; lane < n_lanes; ++lane)
    EXPECT_EQ(found[lane], 1 + step * index[static_cast<std::size_t>(lane)]);
}

TEST(Pack, gathers_by_index_in_steps) {
  expect_gathered<1>();
  expect_gathered<2>();
  expect_gathered<3>();
}

TEST(Pack, appends_the_indices_where_a_condition_holds) {
  std::array<std::int32_t, n_lanes> indices;
  std::iota(indices.begin(), indices.end(), 100);
  for (unsigned bits = 0; bits < 1u << n_lanes; ++bits) {
    std::vector<std::int32_t> expected;
    for (int lane = 0; lane < n_lanes; ++lane)
      if (bits >> lane & 1)
        expected.push_back(100 + lane);
    const Pack chosen([&](auto lane) { return bits >> lane & 1 ? 1. : 0.; });
    std::array<std::int32_t, 2 * n_lanes> to{};
    const auto *end = append_where(chosen > 0, indices.data(), to.data() + 1);
    EXPECT_EQ(std::vector<std::int32_t>(static_cast<const std::int32_t *>(to.data() + 1), end), expected);
    EXPECT_EQ(to[0], 0);
  }
}

} // namespace
