#include "fem_reference/threads.h"

#include "fem_reference/errors.h"

#include <atomic>

#include <deal.II/base/multithread_info.h>
#include <fmt/format.h>

namespace fem_reference {

namespace {
std::atomic<int> setting{1};
} // namespace

void set_threads(int n) {
  if (n < 1)
    throw InvalidInput(fmt::format("{} threads; at least one is needed", n));
  setting = n;
  dealii::MultithreadInfo::set_thread_limit(static_cast<unsigned>(n));
}

int threads() { return setting; }

} // namespace fem_reference
