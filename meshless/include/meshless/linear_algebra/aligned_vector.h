#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace meshless::linear_algebra {

/// Memory that begins with a cache line, so that no SIMD vector at a whole number of them lies in two lines.
template <typename T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheLineAllocator() = default;
  template <typename U>
  CacheLineAllocator(const CacheLineAllocator<U> &) {}

  T *allocate(std::size_t n) { return static_cast<T *>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T *memory, std::size_t) noexcept { ::operator delete(memory, alignment); }

  bool operator==(const CacheLineAllocator &) const { return true; }
};

using AlignedVector = std::vector<double, CacheLineAllocator<double>>;

} // namespace meshless::linear_algebra
