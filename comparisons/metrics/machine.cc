#include "comparisons/metrics/machine.h"

#include "comparisons/metrics/memory.h"
#include "fem_reference/threads.h"
#include "meshless/linear_algebra/pack.h"
#include "meshless/parallel/threads.h"
#include "petrov_commit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

// Calls of OpenBLAS; declared here because its header clashes with other CBLAS headers.
extern "C" {
void openblas_set_num_threads(int threads);
char *openblas_get_config(void);
void dpotrf_(const char *triangle, const int *n, double *a, const int *row_length, int *info);
void daxpy_(const int *n, const double *factor, const double *x, const int *step_x, double *y, const int *step_y);
}

namespace comparisons::metrics {

namespace {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      return line.substr(line.find(':') + 2);
  return "unknown";
}

/// Seconds that all cores were busy since the system started: every field of the first line but idle and iowait, less
/// the guests', which user and nice hold already.
std::optional<double> busy_seconds() {
  std::ifstream stat("/proc/stat");
  std::string name;
  std::array<double, 8> ticks{}; // user nice system idle iowait irq softirq steal
  stat >> name;
  for (double &value : ticks)
    stat >> value;
  const long per_second = sysconf(_SC_CLK_TCK);
  if (!stat || name != "cpu" || per_second <= 0)
    return {};
  return (ticks[0] + ticks[1] + ticks[2] + ticks[5] + ticks[6] + ticks[7]) / static_cast<double>(per_second);
}

/// OpenBLAS takes work memory, addresses of this size, for each of its threads as it starts and for a caller's first
/// factorisation; refused, it asks again for ever.
constexpr std::size_t blas_work_bytes = std::size_t{128} << 20;

/// @throws std::runtime_error if this process may not have that much
void check_room_for_blas(int threads) {
  std::vector<void *> rooms; // one by one, as it asks: a machine may refuse them all at once
  bool enough = true;
  for (int i = 0; i < threads && enough; ++i) {
    void *const room = mmap(nullptr, blas_work_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    enough = room != MAP_FAILED;
    if (enough)
      rooms.push_back(room);
  }
  for (void *const room : rooms)
    munmap(room, blas_work_bytes);
  if (!enough)
    throw std::runtime_error(fmt::format(
        "OpenBLAS needs {} MB of addresses for {} thread{}, which this process may not have: a limit (ulimit "
        "-v) or the machine leaves {} MB; max_memory in [study] limits a cell without this",
        (static_cast<std::size_t>(threads) * blas_work_bytes) >> 20, threads, threads == 1 ? "" : "s",
        (rooms.size() * blas_work_bytes) >> 20));
}

/// A child process whose memory is limited must find it taken.
void take_work_memory_of_blas() {
  constexpr int n = 20000; // enough entries for all threads to be given some: it returns when they have started
  constexpr int step = 1;
  constexpr double factor = 1;
  const std::vector<double> x(n);
  std::vector<double> y(n);
  daxpy_(&n, &factor, x.data(), &step, y.data(), &step);
  constexpr int order = 2;
  double matrix[order * order] = {1, 0, 0, 1};
  int info = 0;
  dpotrf_("L", &order, matrix, &order, &info);
}

double own_seconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    if (getrusage(who, &usage) == 0)
      for (const timeval &time : {usage.ru_utime, usage.ru_stime})
        sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

} // namespace

CompetingWork::CompetingWork() : machine_seconds_(busy_seconds()), own_seconds_(own_seconds()), start_(now()) {}

std::optional<double> CompetingWork::cores() const {
  constexpr double shortest = 0.1; // ten ticks
  const auto machine = busy_seconds();
  const double elapsed = now() - start_;
  if (!machine || !machine_seconds_ || elapsed < shortest)
    return {};
  return std::max(0.0, (*machine - *machine_seconds_) - (own_seconds() - own_seconds_)) / elapsed;
}

std::optional<double> current_load() {
  double loads[1];
  return getloadavg(loads, 1) == 1 ? std::optional(loads[0]) : std::nullopt;
}

reports::Machine describe_machine(int threads) {
  reports::Machine machine;
  machine.cpu = cpu_name();
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  machine.memory_bytes = listed_bytes("/proc/meminfo", "MemTotal");
  machine.load = current_load().value_or(0);
  std::string config = openblas_get_config();
  while (!config.empty() && config.back() == ' ')
    config.pop_back();
  machine.blas = config;
  machine.threads = threads;
  machine.simd_lanes = meshless::linear_algebra::n_lanes;
  machine.libraries = {{"g++", __VERSION__}};
  // "deal.II 9.4.1,Eigen3 3.4.0", from the build.
  std::istringstream list(PETROV_LIBRARY_VERSIONS);
  for (std::string library; std::getline(list, library, ',');)
    if (const auto space = library.rfind(' '); space != std::string::npos && space + 1 < library.size())
      machine.libraries[library.substr(0, space)] = library.substr(space + 1);
  return machine;
}

reports::Program describe_program() {
  reports::Program program;
  program.version = PETROV_VERSION;
  program.commit = PETROV_COMMIT;
  program.build_type = PETROV_BUILD_TYPE;
  program.flags = PETROV_CXX_FLAGS;
  return program;
}

void use_threads(int threads) {
  setenv("OMP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  static int with_memory = 0; // threads of BLAS that have theirs; it is never given back
  if (threads > with_memory)
    check_room_for_blas(threads - with_memory);
  openblas_set_num_threads(threads);
  if (threads > with_memory)
    take_work_memory_of_blas();
  with_memory = std::max(with_memory, threads);
  meshless::parallel::set_threads(threads);
  fem_reference::set_threads(threads);
}

std::vector<std::string> reasons_not_comparable(const reports::Program &program, const reports::Machine &machine,
                                                const std::set<int> &threads, double seconds) {
  std::vector<std::string> reasons;
  if (program.build_type != "Release")
    reasons.push_back(fmt::format("{} build", program.build_type));
  if (machine.competing_cores && *machine.competing_cores > least_competing_cores)
    reasons.push_back(fmt::format("other processes kept {:.2f} of {} cores busy while the cells ran",
                                  *machine.competing_cores, machine.cores));
  const bool known = machine.competing_cores.has_value();
  // One busy core of our own is no competition; more than the machine has is.
  if (!known && machine.cores > 0 && machine.load > 0.75 * machine.cores)
    reasons.push_back(fmt::format("the machine was loaded ({:.1f} on {} cores)", machine.load, machine.cores));
  // After a minute the average holds little but this run, which keeps `threads` cores busy.
  const int own = threads.empty() ? machine.threads : *threads.rbegin();
  if (!known && seconds >= 60 && machine.load_at_end && *machine.load_at_end > own + 0.5)
    reasons.push_back(fmt::format("other work ran beside (load {:.1f} at the end, of which {} {} this run's)",
                                  *machine.load_at_end, own, own == 1 ? "is" : "are"));
  if (threads.size() > 1)
    reasons.push_back(fmt::format("the scenes ask for differing numbers of threads ({})", fmt::join(threads, ", ")));
  return reasons;
}

} // namespace comparisons::metrics
