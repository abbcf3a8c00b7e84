#pragma once

#include "meshless/cloud/neighbour_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace meshless::cloud {

/// Sorts by an unsigned number of each item, digit by digit: stable, and a few times as fast as comparing where the
/// numbers lie close together.
/// @param scratch as many items, overwritten
/// @param number_of item -> std::uint64_t
template <typename T, typename NumberOf>
void radix_sort(std::span<T> items, std::span<T> scratch, const NumberOf &number_of) {
  constexpr int largest_digit = 11; // bits: its counts fill a quarter of the first cache
  if (items.empty())
    return;
  std::uint64_t low = number_of(items[0]);
  std::uint64_t high = low;
  for (const T &item : items) {
    low = std::min(low, number_of(item));
    high = std::max(high, number_of(item));
  }
  const int bits = static_cast<int>(std::bit_width(high - low));
  const int n_passes = (bits + largest_digit - 1) / largest_digit;
  const int digit = n_passes == 0 ? 0 : (bits + n_passes - 1) / n_passes;
  const std::uint64_t mask = (std::uint64_t{1} << digit) - 1;
  for (int pass = 0; pass < n_passes; ++pass) {
    const auto bucket = [&](const T &item) { return (number_of(item) - low) >> (pass * digit) & mask; };
    std::array<std::uint32_t, std::size_t{1} << largest_digit> places;
    std::fill_n(places.begin(), mask + 1, 0);
    for (const T &item : items)
      ++places[bucket(item)];
    std::uint32_t sum = 0;
    for (std::uint64_t b = 0; b <= mask; ++b)
      sum += std::exchange(places[b], sum);
    for (const T &item : items)
      scratch[places[bucket(item)]++] = item;
    std::swap(items, scratch);
  }
  if (n_passes % 2 == 1)
    std::copy(items.begin(), items.end(), scratch.begin());
}

/// Sorts the first n indices; the vector keeps its size, what stands behind them does not stay.
inline void sort_indices(std::vector<Index> &indices, std::size_t n) {
  const std::size_t size = indices.size();
  if (size < 2 * n)
    indices.resize(2 * n);
  const std::span all(indices);
  radix_sort(all.first(n), all.subspan(n, n), [](Index i) { return static_cast<std::uint64_t>(i); });
  indices.resize(size);
}

} // namespace meshless::cloud
