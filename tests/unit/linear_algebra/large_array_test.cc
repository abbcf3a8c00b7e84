// The array that matrices grow in, across the sizes where it changes to pages of its own.

#include "meshless/linear_algebra/large_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <vector>

#include <sys/mman.h>

namespace {

using meshless::linear_algebra::LargeArray;

TEST(LargeArray, keeps_its_values_while_it_grows_and_moves) {
  LargeArray<std::int64_t> array;
  EXPECT_TRUE(array.empty());
  constexpr std::int64_t n = 1'000'000; // 8 MB: through the heap to pages, and through several of these
  for (std::int64_t i = 0; i < n; ++i)
    array.push_back(3 * i);
  ASSERT_EQ(array.size(), static_cast<std::size_t>(n));
  for (std::int64_t i = 0; i < n; ++i)
    ASSERT_EQ(array[static_cast<std::size_t>(i)], 3 * i);
  LargeArray<std::int64_t> moved(std::move(array));
  EXPECT_EQ(array.size(), 0u); // NOLINT(bugprone-use-after-move): it is empty, and of use
  array.push_back(7);
  EXPECT_EQ(array[0], 7);
  array = std::move(moved);
  ASSERT_EQ(array.size(), static_cast<std::size_t>(n));
  EXPECT_EQ(std::accumulate(array.begin(), array.end(), std::int64_t{0}), 3 * (n * (n - 1) / 2));
}

// Pages that move elsewhere would be split into small ones, whose first use and look-up cost more. Linux from 6.7 on
// keeps to these addresses whatever is asked: what this can find, it finds on Debian 12's 6.1.
TEST(LargeArray, keeps_to_large_pages_when_it_moves) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer watches what malloc gives: no pages of its own";
#endif
  constexpr std::uintptr_t large_page = std::uintptr_t{2} << 20;
  constexpr std::size_t small_page = 4096;
  LargeArray<double> array;
  array.reserve(300'000);      // 2.4 MB
  std::vector<void *> between; // small mappings, in the way of growing in place and of addresses that fit by chance
  const double *first = array.data();
  bool moved = false;
  for (std::size_t n = 300'000; n < 3'000'000; n = 2 * n) {
    between.push_back(mmap(reinterpret_cast<std::byte *>(array.data()) - small_page, small_page, PROT_READ,
                           MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    ASSERT_NE(between.back(), MAP_FAILED);
    const std::size_t size = array.size();
    array.resize(n);
    std::fill(array.data() + size, array.end(), static_cast<double>(n));
    moved = moved || array.data() != first;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % large_page, 0u) << n;
    EXPECT_EQ(array[0], 300'000);
  }
  EXPECT_TRUE(moved);
  for (void *mapping : between)
    munmap(mapping, small_page);
}

TEST(LargeArray, copies_are_apart) {
  LargeArray<double> array{1, 2, 3};
  auto copy = array;
  copy[0] = 9;
  copy.push_back(4);
  EXPECT_EQ(std::vector<double>(array.begin(), array.end()), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(std::vector<double>(copy.begin(), copy.end()), (std::vector<double>{9, 2, 3, 4}));
  array = copy;
  EXPECT_EQ(array.size(), 4u);
}

TEST(LargeArray, reserved_room_is_filled_in_place) {
  LargeArray<double> array;
  array.reserve(500'000);
  const double *data = array.data();
  array.resize(500'000);
  EXPECT_EQ(array.data(), data);
  std::fill(array.begin(), array.end(), 2.5);
  array.clear();
  EXPECT_EQ(array.size(), 0u);
  EXPECT_GE(array.capacity(), 500'000u);
  const std::vector<double> more(300'000, 1.5);
  array.append(more);
  EXPECT_EQ(array.data(), data);
  EXPECT_EQ(array[299'999], 1.5);
}

TEST(LargeArray, an_entry_of_its_own_may_be_appended) {
  LargeArray<int> array{42};
  while (array.size() < 1'000'000)
    array.push_back(array[array.size() / 2]);
  for (const int value : array)
    ASSERT_EQ(value, 42);
}

TEST(LargeArray, says_when_memory_is_missing_and_keeps_what_it_has) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends the program for want of memory";
#endif
  LargeArray<double> array;
  array.resize(200'000);
  array[199'999] = 1;
  EXPECT_THROW(array.reserve(std::numeric_limits<std::size_t>::max() / 16), std::bad_alloc);
  EXPECT_EQ(array.size(), 200'000u);
  EXPECT_EQ(array[199'999], 1);
}

} // namespace
