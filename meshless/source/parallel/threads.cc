#include "meshless/parallel/threads.h"

#include <fmt/format.h>

#include <atomic>
#include <stdexcept>

namespace meshless::parallel {

namespace {
std::atomic<int> setting{1};
} // namespace

void set_threads(int n) {
  if (n < 1)
    throw std::invalid_argument(fmt::format("{} threads; at least one is needed", n));
  setting = n;
}

int threads() { return setting; }

} // namespace meshless::parallel
