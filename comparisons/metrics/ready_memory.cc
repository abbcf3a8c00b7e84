#include "comparisons/metrics/ready_memory.h"

#include "comparisons/metrics/memory.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <optional>
#include <poll.h>
#include <sched.h>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace comparisons::metrics {

namespace {

/// Given back at a time: large pages, whole ones.
constexpr std::int64_t step = 4 << 20;
/// Given back in advance, so that it is there when it is taken: more than is taken while the holder sleeps.
constexpr std::int64_t ahead = 16 * step;
constexpr long sleep_nanoseconds = 4'000'000;
constexpr long long_sleep_nanoseconds = 16'000'000; ///< after nothing was to be given back

// The holder is the child of a process with threads, so that from its fork on it may not allocate: what it reads, it
// reads into buffers of its own.

/// The number that a text begins with, after blanks; moves past it. Negative if there is none.
std::int64_t next_number(const char *&text) {
  while (*text == ' ')
    ++text;
  if (*text < '0' || *text > '9')
    return -1;
  std::int64_t value = 0;
  for (; *text >= '0' && *text <= '9'; ++text)
    value = 10 * value + (*text - '0');
  return value;
}

/// The path of a file of a process: "/proc/12/statm".
class ProcessFile {
public:
  ProcessFile(std::int64_t process, const char *name) {
    append("/proc/");
    append_number(process);
    append(name);
  }
  ProcessFile(std::int64_t process, const char *before, std::int64_t thread, const char *after)
      : ProcessFile(process, before) {
    append_number(thread);
    append(after);
  }

  /// The first bytes of the file; false if it cannot be read.
  template <std::size_t size>
  bool read(std::array<char, size> &text) const {
    const int file = open(path_.data(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
      return false;
    const auto n = pread(file, text.data(), size - 1, 0);
    close(file);
    text[n > 0 ? static_cast<std::size_t>(n) : 0] = 0;
    return n > 0;
  }

private:
  void append(const char *text) {
    for (; *text != 0 && length_ + 1 < path_.size(); ++text)
      path_[length_++] = *text;
  }
  void append_number(std::int64_t number) {
    if (number >= 10)
      append_number(number / 10);
    const char digit[2] = {static_cast<char>('0' + number % 10), 0};
    append(digit);
  }

  std::array<char, 96> path_{};
  std::size_t length_ = 0;
};

/// Resident memory of a process that no file stands behind; 0 if it is gone.
std::int64_t private_bytes(std::int64_t process) {
  std::array<char, 128> text{};
  if (!ProcessFile(process, "/statm").read(text))
    return 0;
  const char *at = text.data();
  next_number(at);
  const std::int64_t resident = next_number(at);
  const std::int64_t shared = next_number(at);
  return std::max<std::int64_t>(0, resident - shared) * sysconf(_SC_PAGESIZE);
}

/// The processor that a process ran on last; negative if it is gone.
std::int64_t last_processor(std::int64_t process) {
  constexpr int name_field = 2;
  constexpr int processor_field = 39;
  std::array<char, 1024> text{};
  if (!ProcessFile(process, "/stat").read(text))
    return -1;
  const char *at = std::strrchr(text.data(), ')'); // the name may hold blanks
  for (int field = name_field; at != nullptr && field < processor_field; ++field)
    at = std::strchr(at + 1, ' ');
  return at == nullptr ? -1 : next_number(at);
}

struct Work {
  std::int64_t bytes = 0; ///< of the process that works and of its children but the holder
  pid_t process = 0;      ///< that takes memory: with --isolate a child
};

Work find_work(pid_t parent, pid_t holder) {
  Work work{private_bytes(parent), parent};
  std::array<char, 512> text{};
  if (ProcessFile(parent, "/task/", parent, "/children").read(text)) {
    const char *at = text.data();
    for (std::int64_t child = next_number(at); child > 0; child = next_number(at))
      if (child != holder) {
        work.bytes += private_bytes(child);
        work.process = static_cast<pid_t>(child);
      }
  }
  return work;
}

/// What is given back waits for the processor that gave it: the work takes just these pages only on the same one.
void follow(pid_t process) {
  const auto processor = last_processor(process);
  if (processor < 0 || processor >= CPU_SETSIZE)
    return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(processor), &one);
  sched_setaffinity(0, sizeof one, &one);
}

/// The child's work: takes the memory, says so with a byte for every step, and gives it back as the others take theirs.
[[noreturn]] void hold(std::int64_t bytes, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
    _exit(1);
  // The lock on the folder of results, too: a process that ends gives its memory back first, which takes a second.
  if (output > 3)
    close_range(3, static_cast<unsigned>(output) - 1, 0);
  close_range(static_cast<unsigned>(output) + 1, ~0U, 0);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (const int score = open("/proc/self/oom_score_adj", O_WRONLY); score >= 0) {
    [[maybe_unused]] const auto written = write(score, "1000", 4);
    close(score);
  }
  const auto size = static_cast<std::size_t>(bytes);
  void *const pages = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED)
    _exit(1);
  madvise(pages, size, MADV_HUGEPAGE);
  constexpr std::int64_t page = 4096;
  for (std::int64_t done = 0; done < bytes; done += step) {
    for (std::int64_t i = done; i < std::min(bytes, done + step); i += page)
      static_cast<volatile char *>(pages)[i] = 1;
    if (write(output, "", 1) != 1)
      _exit(1);
  }
  const pid_t self = getpid();
  const std::int64_t at_first = find_work(parent, self).bytes;
  close(output); // the work begins
  for (std::int64_t given_back = 0; given_back < bytes;) {
    const Work work = find_work(parent, self);
    const std::int64_t wanted = std::min(bytes, work.bytes - at_first + ahead);
    const timespec pause{0, given_back < wanted ? sleep_nanoseconds : long_sleep_nanoseconds};
    follow(work.process);
    // What came first goes first: measured, less of the work's memory is new than the other way round.
    for (; given_back < wanted; given_back += step)
      munmap(static_cast<char *>(pages) + given_back, static_cast<std::size_t>(std::min(step, bytes - given_back)));
    nanosleep(&pause, nullptr);
  }
  _exit(0);
}

/// The number that a file holds; nothing for "max" and for no file.
std::optional<std::int64_t> number_in(const std::filesystem::path &file) {
  std::ifstream text(file);
  std::int64_t value = 0;
  if (text >> value)
    return value;
  return {};
}

/// Lowers `least` to the limit of a control group and of those that hold it.
void lower_to_limits(const std::filesystem::path &root, std::filesystem::path group, const char *file,
                     std::int64_t &least) {
  while (true) {
    if (const auto limit = number_in(root / group.relative_path() / file))
      least = std::min(least, *limit);
    if (!group.has_relative_path())
      return;
    group = group.parent_path();
  }
}

} // namespace

std::int64_t available_memory() {
  std::int64_t least = listed_bytes("/proc/meminfo", "MemAvailable");
  std::ifstream groups("/proc/self/cgroup");
  // "4:memory:/path" in version 1, "0::/path" in version 2
  for (std::string line; std::getline(groups, line);) {
    const auto name = line.find(':');
    const auto path = line.find(':', name + 1);
    if (name == std::string::npos || path == std::string::npos)
      continue;
    const std::string controllers = "," + line.substr(name + 1, path - name - 1) + ",";
    if (controllers.find(",memory,") != std::string::npos)
      lower_to_limits("/sys/fs/cgroup/memory", line.substr(path + 1), "memory.limit_in_bytes", least);
    else if (controllers == ",,")
      lower_to_limits("/sys/fs/cgroup", line.substr(path + 1), "memory.max", least);
  }
  return least;
}

ReadyMemory::ReadyMemory(std::int64_t bytes, const std::function<bool()> &stop_requested) {
  bytes = std::min(bytes, available_memory() / 2);
  if (bytes <= 0)
    return;
  int ends[2];
  if (pipe(ends) != 0)
    return;
  const pid_t parent = getpid();
  holder_ = fork();
  if (holder_ == 0) {
    close(ends[0]);
    hold(bytes, ends[1], parent);
  }
  close(ends[1]);
  while (holder_ > 0 && !(stop_requested && stop_requested())) {
    pollfd item{ends[0], POLLIN, 0};
    if (poll(&item, 1, 50) <= 0)
      continue;
    std::array<char, 256> steps{};
    const auto n = read(ends[0], steps.data(), steps.size());
    if (n == 0)
      break;
    if (n > 0)
      bytes_ = std::min(bytes, bytes_ + n * step);
  }
  close(ends[0]);
}

ReadyMemory::~ReadyMemory() {
  if (holder_ <= 0)
    return;
  kill(holder_, SIGKILL);
  while (waitpid(holder_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

} // namespace comparisons::metrics
