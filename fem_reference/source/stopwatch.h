#pragma once

#include <chrono>

namespace fem_reference {
/// Wall-clock seconds since construction or the last `lap`.
class Stopwatch {
public:
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};
} // namespace fem_reference
