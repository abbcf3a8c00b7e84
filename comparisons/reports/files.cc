#include "comparisons/reports/files.h"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <system_error>
#include <unistd.h>

namespace comparisons::reports {

namespace {

[[noreturn]] void fail(const std::filesystem::path &path, const char *what, int error) {
  throw OutputError(fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(error)));
}

std::filesystem::path parent_of(const std::filesystem::path &path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// A new, empty file beside `target`; closed and removed on destruction unless it was renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(const std::filesystem::path &target) : target_(target) {
    // A name may be left over from a process that was killed.
    for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
      name_ =
          (parent_of(target) / fmt::format(".{}.{}-{}.tmp", target.filename().string(), ::getpid(), attempt)).string();
      descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && errno != EEXIST)
        break;
    }
    if (descriptor_ < 0)
      fail(target, "cannot create a file in this directory", errno);
  }
  TemporaryFile(const TemporaryFile &) = delete;
  TemporaryFile &operator=(const TemporaryFile &) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
    if (!renamed_)
      ::unlink(name_.c_str());
  }

  void write(std::string_view contents) {
    while (!contents.empty()) {
      const ssize_t written = ::write(descriptor_, contents.data(), contents.size());
      if (written < 0 && errno == EINTR)
        continue;
      if (written < 0)
        fail(target_, "cannot write", errno);
      contents.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void rename_to_target() {
    if (::fsync(descriptor_) != 0)
      fail(target_, "cannot write", errno);
    // Some file systems report a full disk only here.
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0)
      fail(target_, "cannot write", errno);
    if (::rename(name_.c_str(), target_.c_str()) != 0)
      fail(target_, "cannot rename the finished file", errno);
    renamed_ = true;
  }

private:
  std::filesystem::path target_;
  std::string name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

} // namespace

std::string file_contents(const std::filesystem::path &path) {
  std::ifstream stream(path, std::ios::binary);
  return stream ? std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()) : std::string();
}

void write_file_atomically(const std::filesystem::path &path, std::string_view contents) {
  TemporaryFile file(path);
  file.write(contents);
  file.rename_to_target();
}

void prepare_output_directory(const std::filesystem::path &directory) {
  if (directory.empty())
    throw OutputError("the name of the output directory is empty");
  std::error_code error, ignored;
  std::filesystem::create_directories(directory, error);
  if (error && !std::filesystem::is_directory(directory, ignored))
    throw OutputError(fmt::format("{}: cannot create the output directory: {}", directory.string(), error.message()));
  // Only a real attempt tells: rights, a read-only or a full file system.
  TemporaryFile attempt(directory / "write_test");
  attempt.write("x");
}

} // namespace comparisons::reports
