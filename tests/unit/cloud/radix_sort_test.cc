// Sorting by digits against the standard library's stable sort.

#include "sample_clouds.h"

#include "meshless/cloud/radix_sort.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace {

using meshless::cloud::Index;
using Item = std::pair<std::uint64_t, std::size_t>;

void expect_sorted(std::vector<Item> items) {
  auto expected = items;
  std::stable_sort(expected.begin(), expected.end(), [](const Item &a, const Item &b) { return a.first < b.first; });
  std::vector<Item> scratch(items.size());
  meshless::cloud::radix_sort(std::span(items), std::span(scratch), [](const Item &item) { return item.first; });
  EXPECT_EQ(items, expected);
}

TEST(RadixSort, is_a_stable_sort_for_numbers_of_any_width) {
  sample_clouds::Uniform random(1);
  for (const std::size_t n : {0, 1, 2, 100, 3000})
    // One digit, exactly one and two full digits, an odd and an even number of them, all of them.
    for (const int bits : {0, 1, 7, 11, 12, 22, 23, 40, 64})
      for (const std::uint64_t lowest : {std::uint64_t{0}, std::uint64_t{123456789}}) {
        std::vector<Item> items;
        for (std::size_t i = 0; i < n; ++i)
          items.emplace_back((lowest + static_cast<std::uint64_t>(std::ldexp(random(), bits))), i);
        expect_sorted(items);
      }
  expect_sorted({{std::numeric_limits<std::uint64_t>::max(), 0}, {0, 1}, {1, 2}, {0, 3}});
}

TEST(RadixSort, sorts_distinct_indices_close_together_or_far_apart) {
  sample_clouds::Uniform random(2);
  for (const std::size_t n : {0, 1, 2, 100, 3000})
    for (const double spread : {1.0, 3.0, 63.5, 128.0, 200.0, 1e5}) {
      std::set<Index> drawn;
      const double range = spread * static_cast<double>(n);
      while (drawn.size() < n)
        drawn.insert(70 + static_cast<Index>(random() * range));
      std::vector<Index> indices(drawn.begin(), drawn.end());
      for (std::size_t i = n; i > 1; --i)
        std::swap(indices[i - 1], indices[static_cast<std::size_t>(random() * static_cast<double>(i))]);
      indices.push_back(-1); // behind those that are sorted
      meshless::cloud::sort_indices(indices, n);
      EXPECT_EQ(indices.size(), n + 1);
      indices.resize(n);
      EXPECT_EQ(indices, std::vector<Index>(drawn.begin(), drawn.end())) << n << " " << spread;
    }
}

} // namespace
