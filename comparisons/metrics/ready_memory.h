#pragma once

#include <cstdint>
#include <functional>
#include <sys/types.h>

namespace comparisons::metrics {

/// Memory that the system has ready for timed work. A virtual machine gives idle memory back to its host, and getting
/// it again costs up to two and a half seconds a GB: without this the first use of memory may be what is timed, in the
/// larger cells alone, so that cost seems to grow faster than work.
///
/// While this lives a child process holds the memory, every page of it written to, and gives it back as this process
/// and its other children take theirs, a little ahead of them: what is given back at once would soon be idle again. The
/// work then finds memory as a repeated run does. The child is the first to go if memory runs out; giving back, it runs
/// on the processor of the work, for well under a hundredth of the time.
class ReadyMemory {
public:
  /// Returns when the memory is ready: so many bytes, but no more than half of what is available. Less, or nothing,
  /// where the process may not have it, and when `stop_requested` becomes true.
  explicit ReadyMemory(std::int64_t bytes, const std::function<bool()> &stop_requested = {});
  ReadyMemory(const ReadyMemory &) = delete;
  ReadyMemory &operator=(const ReadyMemory &) = delete;
  /// Gives back what is left.
  ~ReadyMemory();

  /// Bytes made ready.
  std::int64_t bytes() const { return bytes_; }

private:
  std::int64_t bytes_ = 0;
  pid_t holder_ = -1;
};

/// Bytes that new work can have without swapping: what the machine has available, or the limit of the process's control
/// group (version 1 or 2) if that is less; 0 where the system does not tell.
std::int64_t available_memory();

} // namespace comparisons::metrics
