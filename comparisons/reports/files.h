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

} // namespace comparisons::reports
