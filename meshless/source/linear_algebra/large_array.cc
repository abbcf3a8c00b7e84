#include "meshless/linear_algebra/large_array.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <sys/mman.h>

namespace meshless::linear_algebra {

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool has_pages = false; // the sanitizer watches what malloc gives
#else
constexpr bool has_pages = true;
#endif

constexpr std::size_t large_page = std::size_t{2} << 20;
/// From here on pages of its own: half of a large one is in use at least.
constexpr std::size_t least_of_pages = large_page / 2;

bool in_pages(std::size_t size) { return has_pages && size >= least_of_pages; }

/// Addresses for so many bytes that begin with a large page, without memory behind them.
/// @throws std::bad_alloc
void *aligned_addresses(std::size_t size) {
  const std::size_t spare = size + large_page;
  void *all =
      spare < size ? MAP_FAILED : mmap(nullptr, spare, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (all == MAP_FAILED)
    throw std::bad_alloc();
  auto *const first = static_cast<std::byte *>(all);
  const std::size_t before = (large_page - reinterpret_cast<std::uintptr_t>(all) % large_page) % large_page;
  if (before > 0)
    munmap(first, before);
  munmap(first + before + size, large_page - before);
  return first + before;
}

/// What is in the old pages moves at large pages' boundaries: elsewhere the system would split them all. Linux keeps to
/// them by itself from 6.7 on; Debian 12 has 6.1.
/// @param old pages that are given up; null: none
/// @throws std::bad_alloc
void *pages(void *old, std::size_t old_size, std::size_t size) {
  void *data = old == nullptr ? MAP_FAILED : mremap(old, old_size, size, 0); // where they are, if there is room
  if (data == MAP_FAILED) {
    void *place = aligned_addresses(size);
    data = old == nullptr ? mmap(place, size, PROT_READ | PROT_WRITE,
                                 MAP_FIXED | MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)
                          : mremap(old, old_size, size, MREMAP_MAYMOVE | MREMAP_FIXED, place);
    if (data == MAP_FAILED) {
      munmap(place, size);
      throw std::bad_alloc();
    }
  }
  madvise(data, size, MADV_HUGEPAGE);
  return data;
}

} // namespace

void GrowingBytes::grow(std::size_t size) {
  if (size <= size_)
    return;
  if (!in_pages(size)) {
    void *data = std::realloc(data_, size);
    if (data == nullptr)
      throw std::bad_alloc();
    data_ = data;
    size_ = size;
    return;
  }
  const std::size_t whole = (size + large_page - 1) / large_page * large_page;
  if (whole < size)
    throw std::bad_alloc();
  if (in_pages(size_))
    data_ = pages(data_, size_, whole);
  else {
    void *data = pages(nullptr, 0, whole);
    if (size_ > 0)
      std::memcpy(data, data_, size_);
    std::free(data_);
    data_ = data;
  }
  size_ = whole;
}

GrowingBytes::~GrowingBytes() {
  if (in_pages(size_))
    munmap(data_, size_);
  else
    std::free(data_);
}

} // namespace meshless::linear_algebra
