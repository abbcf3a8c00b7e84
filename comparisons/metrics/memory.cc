#include "comparisons/metrics/memory.h"

#include <algorithm>
#include <fstream>
#include <malloc.h>
#include <string>

namespace comparisons::metrics {

std::int64_t listed_bytes(const std::string &file, const std::string &key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(key + ":"))
      return 1024 * std::stoll(line.substr(key.size() + 1));
  return 0;
}

PeakMemory::PeakMemory() {
  malloc_trim(0); // what earlier cells left in the heap must not hide what this one needs
  std::ofstream("/proc/self/clear_refs") << "5"; // resets VmHWM
  before_ = listed_bytes("/proc/self/status", "VmRSS");
}

std::int64_t PeakMemory::bytes() const {
  return std::max<std::int64_t>(0, listed_bytes("/proc/self/status", "VmHWM") - before_);
}

} // namespace comparisons::metrics
