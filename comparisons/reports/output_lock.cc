#include "comparisons/reports/output_lock.h"

#include "comparisons/reports/files.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace comparisons::reports {

OutputLock::OutputLock(const std::filesystem::path &directory)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  using namespace std::chrono;
  const auto end = steady_clock::now() + seconds(2);
  while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || errno == EINTR)) {
    if (steady_clock::now() > end) {
      ::close(descriptor_);
      throw OutputError(fmt::format("{}: another run is writing its results here", directory.string()));
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
}

OutputLock::~OutputLock() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
}

} // namespace comparisons::reports
