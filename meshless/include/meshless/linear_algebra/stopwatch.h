#pragma once

#include <chrono>

namespace meshless::linear_algebra {

/// Wall-clock seconds since construction or the last lap.
class Stopwatch {
public:
  /// Seconds since the last lap; starts the next.
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

} // namespace meshless::linear_algebra
