#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace comparisons::reports {

/// Output that cannot be written; the message names the path and the system's reason.
class OutputError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Writes the whole of `contents` or nothing: a temporary file in the same directory, flushed to the disk, then renamed
/// over `path`. Whatever fails (a full disk, a missing right), the temporary file is removed, an older file at `path`
/// stays as it was, and OutputError is thrown.
void write_file_atomically(const std::filesystem::path &path, std::string_view contents);

/// Empty if the file cannot be read.
std::string file_contents(const std::filesystem::path &path);

/// Creates the directory with its parents and tries to write in it. To be called before any computing, so that a run
/// does not end with results that cannot be kept. Throws OutputError.
void prepare_output_directory(const std::filesystem::path &directory);

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
  int descriptor_ = -1;
};

} // namespace comparisons::reports
