#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

/// Two ways to do the same, timed in turns on one core, so that what else the machine does hits both.
namespace performance {

/// Processor time of this thread, s: the time in which another process holds the core is not in it.
inline double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What the turns have shown.
struct Turns {
  std::vector<double> general, by_hand, ratio; ///< seconds a step; general over by hand
  double difference = 0;                       ///< of what the two compute, relative

  /// One turn: each does `batch` steps; who begins alternates.
  void take(int batch, auto &&general_step, auto &&hand_step) {
    const auto time = [&](auto &step, std::vector<double> &to) {
      const double begin = thread_seconds();
      for (int s = 0; s < batch; ++s)
        step();
      to.push_back((thread_seconds() - begin) / batch);
    };
    if (ratio.size() % 2 == 0) {
      time(general_step, general);
      time(hand_step, by_hand);
    } else {
      time(hand_step, by_hand);
      time(general_step, general);
    }
    ratio.push_back(general.back() / by_hand.back());
  }
};

} // namespace performance
