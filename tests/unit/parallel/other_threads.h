#pragma once

#include <atomic>
#include <chrono>
#include <thread>

/// Do more threads than the test's own take part in what it calls?
class OtherThreads {
public:
  /// To be called by every thread that takes part.
  void take_part() {
    if (std::this_thread::get_id() != here_)
      ++n_;
    else // on a busy machine the second thread may come late
      for (int ms = 0; awaited_ && n_ == 0 && ms < 20'000; ++ms)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  /// From here on the test's own thread gives others time to come.
  void await() { awaited_ = true; }
  /// Calls by others.
  int n() const { return n_; }

private:
  std::thread::id here_ = std::this_thread::get_id();
  std::atomic<int> n_{0};
  bool awaited_ = false;
};
