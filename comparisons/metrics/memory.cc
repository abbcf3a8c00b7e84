#include "comparisons/metrics/memory.h"

#include <algorithm>
#include <fstream>
#include <malloc.h>
#include <string>

namespace comparisons::metrics {

namespace {

/// A line such as "VmHWM:     1234 kB" of /proc/self/status, in bytes.
std::int64_t status_bytes(const std::string &key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key + ":"))
      return 1024 * std::stoll(line.substr(key.size() + 1));
  return 0;
}

} // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0); // what earlier cells left in the heap must not hide what this one needs
  std::ofstream("/proc/self/clear_refs") << "5"; // resets VmHWM
  before_ = status_bytes("VmRSS");
}

std::int64_t PeakMemory::bytes() const { return std::max<std::int64_t>(0, status_bytes("VmHWM") - before_); }

} // namespace comparisons::metrics
