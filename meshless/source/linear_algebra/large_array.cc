#include "meshless/linear_algebra/large_array.h"

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
/// Above this, what is taken step by step costs less in small pages: large ones are split where a move leaves their
/// boundaries (3.8 GB: 3.0 to 4.1 s against 1.4 to 2.7; on a virtual machine whose host has taken the memory back, 5 to
/// 7 either way).
constexpr std::size_t most_growing_by_large = 16 * large_page;

bool in_pages(std::size_t size) { return has_pages && size >= least_of_pages; }

/// @param old pages that are given up; null: none
void *pages(void *old, std::size_t old_size, std::size_t size) {
  void *data = old == nullptr
                   ? mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)
                   : mremap(old, old_size, size, MREMAP_MAYMOVE);
  if (data == MAP_FAILED)
    throw std::bad_alloc();
  madvise(data, size, old != nullptr && size > most_growing_by_large ? MADV_NOHUGEPAGE : MADV_HUGEPAGE);
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
