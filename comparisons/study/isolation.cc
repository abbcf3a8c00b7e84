#include "comparisons/study/isolation.h"

#include "comparisons/metrics/memory.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <poll.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace comparisons::study {

namespace {

/// Exit code by which a child says that its memory ran out.
constexpr int memory_exit = 86;

void limit_memory(std::int64_t bytes) {
  // RLIMIT_DATA counts the private memory that there is, too.
  const auto limit = static_cast<rlim_t>(metrics::listed_bytes("/proc/self/status", "VmData") + bytes);
  const rlimit value{limit, limit};
  setrlimit(RLIMIT_DATA, &value);
}

bool write_all(int file, const std::string &text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

[[noreturn]] void run_child(const std::function<std::string()> &work, const Limits &limits, int output, pid_t parent) {
  // A parent that is killed can end nobody any more.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
    _exit(1);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (limits.memory_bytes)
    limit_memory(*limits.memory_bytes);
  int code = 1;
  try {
    code = write_all(output, work()) ? 0 : 1;
  } catch (const std::bad_alloc &) {
    code = memory_exit;
  } catch (...) {
    code = 1;
  }
  _exit(code); // no destructors: they belong to the parent
}

/// Reads until the child closes its end, the time is up, or the user stops; the reason, if any.
std::optional<IsolatedOutcome> read_output(int input, const Limits &limits, const std::function<bool()> &stop_requested,
                                           std::string &payload) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  char buffer[65536];
  while (true) {
    if (stop_requested && stop_requested())
      return IsolatedOutcome{IsolatedOutcome::Kind::interrupted, {}, "interrupted"};
    const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
    if (limits.seconds && elapsed > *limits.seconds)
      return IsolatedOutcome{
          IsolatedOutcome::Kind::out_of_time, {}, fmt::format("ended after max_seconds = {}", *limits.seconds)};
    pollfd item{input, POLLIN, 0};
    if (poll(&item, 1, 50) <= 0)
      continue;
    const ssize_t n = read(input, buffer, sizeof buffer);
    if (n == 0)
      return {};
    if (n > 0)
      payload.append(buffer, static_cast<std::size_t>(n));
  }
}

} // namespace

IsolatedOutcome run_isolated(const std::function<std::string()> &work, const Limits &limits,
                             const std::function<bool()> &stop_requested) {
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    throw std::runtime_error(fmt::format("cannot start a child process: {}", std::strerror(errno)));
  }
  if (child == 0) {
    close(ends[0]);
    run_child(work, limits, ends[1], parent);
  }
  close(ends[1]);
  IsolatedOutcome outcome;
  const auto ended = read_output(ends[0], limits, stop_requested, outcome.payload);
  close(ends[0]);
  if (ended)
    kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (ended)
    return *ended;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !outcome.payload.empty())
    outcome.kind = IsolatedOutcome::Kind::finished;
  else if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    outcome.kind = IsolatedOutcome::Kind::crashed;
    outcome.reason = "the process ended without a result";
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == memory_exit) {
    outcome.kind = IsolatedOutcome::Kind::out_of_memory;
    outcome.reason = limits.memory_bytes ? fmt::format("needs more than max_memory = {} bytes", *limits.memory_bytes)
                                         : "out of memory";
  } else if (WIFSIGNALED(status)) {
    outcome.kind = IsolatedOutcome::Kind::crashed;
    outcome.reason = fmt::format("crashed: {}", strsignal(WTERMSIG(status)));
  } else {
    outcome.kind = IsolatedOutcome::Kind::crashed;
    outcome.reason = fmt::format("the process ended with exit code {}", WEXITSTATUS(status));
  }
  return outcome;
}

} // namespace comparisons::study
