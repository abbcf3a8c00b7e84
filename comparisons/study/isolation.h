#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace comparisons::study {

/// Limits on one isolated piece of work; nothing is unlimited.
struct Limits {
  std::optional<double> seconds;
  std::optional<std::int64_t> memory_bytes;
};

/// How a child process ended.
struct IsolatedOutcome {
  enum class Kind {
    finished,    ///< `payload` is what the work returned
    crashed,     ///< a signal or an unexpected exit
    out_of_time, ///< ended after max_seconds
    out_of_memory,
    interrupted, ///< the user asked to stop
  };
  Kind kind = Kind::crashed;
  std::string payload;
  std::string reason;
};

/// Runs `work` in a child process and returns its text, so that a crash, a hang or exhausted memory
/// inside a library ends this work alone.
///
/// The work's text must not be empty. The memory limit is on what the child allocates beyond what it inherits. The
/// child ignores SIGINT; the parent ends it when `stop_requested` becomes true.
IsolatedOutcome run_isolated(const std::function<std::string()> &work, const Limits &limits,
                             const std::function<bool()> &stop_requested);

} // namespace comparisons::study
