#pragma once

#include <cstdint>
#include <string>

namespace comparisons::metrics {

/// A line such as "VmHWM:     1234 kB" of a file of /proc, in bytes; 0 if there is none.
std::int64_t listed_bytes(const std::string &file, const std::string &key);

/// Peak memory of a stretch of work: the high-water mark of this process after a reset, above what
/// it held when the stretch began.
class PeakMemory {
public:
  PeakMemory();
  /// Bytes since construction; 0 where the system does not tell.
  std::int64_t bytes() const;

private:
  std::int64_t before_ = 0;
};

} // namespace comparisons::metrics
