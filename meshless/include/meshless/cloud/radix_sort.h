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
/// numbers lie close together; items in order are left as they are.
/// @param scratch as many items, overwritten
/// @param number_of item -> std::uint64_t
template <typename T, typename NumberOf>
void radix_sort(std::span<T> items, std::span<T> scratch, const NumberOf &number_of) {
  constexpr int largest_digit = 11; // bits: its counts fill a quarter of the first cache
  const auto by_number = [&](const T &a, const T &b) { return number_of(a) < number_of(b); };
  if (std::is_sorted(items.begin(), items.end(), by_number))
    return;
  std::uint64_t low = number_of(items[0]);
  std::uint64_t high = low;
  for (const T &item : items) {
    low = std::min(low, number_of(item));
    high = std::max(high, number_of(item));
  }
  const int bits = static_cast<int>(std::bit_width(high - low));
  const auto digit_of = [&](int n_passes) { return (bits + n_passes - 1) / n_passes; };
  // Measured: an item costs a pass about five times what a count does.
  const auto cost = [&](int n_passes) {
    return static_cast<std::size_t>(n_passes) * (5 * items.size() + (std::size_t{1} << digit_of(n_passes)));
  };
  int n_passes = (bits + largest_digit - 1) / largest_digit;
  while (n_passes < bits && cost(n_passes + 1) < cost(n_passes))
    ++n_passes;
  const int digit = digit_of(n_passes);
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

/// Sorts distinct indices close to each other: marks each in a row of bits and reads them off.
/// @returns whether they are close enough; else nothing is done
inline bool sort_by_marks(std::span<Index> indices) {
  constexpr std::size_t most_words = 256;
  if (indices.empty())
    return true;
  const auto [least, greatest] = std::minmax_element(indices.begin(), indices.end());
  const Index low = *least;
  const std::size_t n_words = static_cast<std::size_t>(*greatest - low) / 64 + 1;
  if (n_words > std::min(most_words, 2 * indices.size()))
    return false;
  std::array<std::uint64_t, most_words> marks;
  std::fill_n(marks.begin(), n_words, 0);
  for (const Index i : indices) {
    const auto place = static_cast<std::size_t>(i - low);
    marks[place / 64] |= std::uint64_t{1} << (place % 64);
  }
  auto next = indices.begin();
  for (std::size_t w = 0; w < n_words; ++w)
    for (std::uint64_t word = marks[w]; word != 0; word &= word - 1)
      *next++ = low + static_cast<Index>(64 * w + static_cast<std::size_t>(std::countr_zero(word)));
  return true;
}

/// Sorts the first n indices, which are distinct; the vector keeps its size, what stands behind them does not stay.
inline void sort_indices(std::vector<Index> &indices, std::size_t n) {
  if (sort_by_marks(std::span(indices).first(n)))
    return;
  const std::size_t size = indices.size();
  if (size < 2 * n)
    indices.resize(2 * n);
  const std::span all(indices);
  radix_sort(all.first(n), all.subspan(n, n), [](Index i) { return static_cast<std::uint64_t>(i); });
  indices.resize(size);
}

} // namespace meshless::cloud
