#pragma once

#include <filesystem>

namespace comparisons::reports {

/// Keeps a directory of results to this process as long as this lives: two runs would write over each other's files.
/// A process that is killed frees it, and its children with it.
class OutputLock {
public:
  /// Waits two seconds at most for a process that is just ending.
  /// @throws OutputError if another process has the directory. One that no process can have to itself, as on some
  ///   network drives, is not locked.
  explicit OutputLock(const std::filesystem::path &directory);
  OutputLock(const OutputLock &) = delete;
  OutputLock &operator=(const OutputLock &) = delete;
  ~OutputLock();

private:
  int descriptor_;
};

} // namespace comparisons::reports
