#pragma once

#include <cstdint>

namespace comparisons::metrics {

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
