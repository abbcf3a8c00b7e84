#include "fem_reference/threads.h"

#include "fem_reference/errors.h"

#include <fmt/format.h>

#include <atomic>

namespace fem_reference {

namespace {
std::atomic<int> setting{1};
} // namespace

void set_threads(int n) {
  if (n < 1)
    throw InvalidInput(fmt::format("{} threads; at least one is needed", n));
  setting = n;
}

int threads() { return setting; }

} // namespace fem_reference
