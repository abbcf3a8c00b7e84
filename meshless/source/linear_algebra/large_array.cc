#include "meshless/linear_algebra/large_array.h"

#include <cstdlib>
#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace meshless::linear_algebra {

namespace {

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) // which watches what malloc gives
constexpr bool has_pages = true;
#else
constexpr bool has_pages = false;
#endif

constexpr std::size_t large_page = std::size_t{2} << 20;
/// From here on pages of its own: half of a large one is in use at least.
constexpr std::size_t least_of_pages = large_page / 2;

constexpr std::size_t most_growing_by_large = 16 * large_page;

constexpr std::size_t in_pages(std::size_t size) { return (size + large_page - 1) / large_page * large_page; }

/// `old` null: new pages; else it is given up.
void *pages([[maybe_unused]] void *old, [[maybe_unused]] std::size_t old_size, [[maybe_unused]] std::size_t size) {
#ifdef __linux__
  void *data = old == nullptr
                   ? mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)
                   : mremap(old, old_size, size, MREMAP_MAYMOVE);
  if (data == MAP_FAILED)
    throw std::bad_alloc();
  // Refused: small ones. Much memory that is taken step by step costs less in these: large ones may have to be found
  // anew.
  madvise(data, size, old != nullptr && size > most_growing_by_large ? MADV_NOHUGEPAGE : MADV_HUGEPAGE);
  return data;
#else
  return nullptr;
#endif
}

} // namespace

void GrowingBytes::grow(std::size_t size) {
  if (size <= size_)
    return;
  const bool were_pages = has_pages && size_ >= least_of_pages;
  const bool become_pages = has_pages && size >= least_of_pages;
  if (!become_pages) {
    void *data = std::realloc(data_, size);
    if (data == nullptr)
      throw std::bad_alloc();
    data_ = data;
    size_ = size;
    return;
  }
  const std::size_t whole = in_pages(size);
  if (whole < size)
    throw std::bad_alloc();
  if (were_pages)
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
#ifdef __linux__
  if (has_pages && size_ >= least_of_pages) {
    munmap(data_, size_);
    return;
  }
#endif
  std::free(data_);
}

} // namespace meshless::linear_algebra
