#include "comparisons/metrics/machine.h"

#include "meshless/linear_algebra/pack.h"
#include "meshless/parallel/threads.h"
#include "petrov_commit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

// OpenBLAS's own calls; declared here because its header clashes with other CBLAS headers.
extern "C" {
void openblas_set_num_threads(int threads);
char *openblas_get_config(void);
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

std::int64_t total_memory() {
  std::ifstream info("/proc/meminfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("MemTotal:"))
      return 1024 * std::stoll(line.substr(9));
  return 0;
}

} // namespace

std::optional<double> current_load() {
  double loads[1];
  return getloadavg(loads, 1) == 1 ? std::optional(loads[0]) : std::nullopt;
}

reports::Machine describe_machine(int threads) {
  reports::Machine machine;
  machine.cpu = cpu_name();
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  machine.memory_bytes = total_memory();
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
  openblas_set_num_threads(threads);
  meshless::parallel::set_threads(threads);
}

std::vector<std::string> reasons_not_comparable(const reports::Program &program, const reports::Machine &machine,
                                                const std::set<int> &threads, double seconds) {
  std::vector<std::string> reasons;
  if (program.build_type != "Release")
    reasons.push_back(fmt::format("{} build", program.build_type));
  // One busy core of our own is no competition; more than the machine has is.
  if (machine.cores > 0 && machine.load > 0.75 * machine.cores)
    reasons.push_back(fmt::format("the machine was loaded ({:.1f} on {} cores)", machine.load, machine.cores));
  // After a minute the average holds little but this run, which keeps `threads` cores busy.
  const int own = threads.empty() ? machine.threads : *threads.rbegin();
  if (seconds >= 60 && machine.load_at_end && *machine.load_at_end > own + 0.5)
    reasons.push_back(fmt::format("other work ran beside (load {:.1f} at the end, of which {} {} this run's)",
                                  *machine.load_at_end, own, own == 1 ? "is" : "are"));
  if (threads.size() > 1)
    reasons.push_back(fmt::format("the scenes ask for differing numbers of threads ({})", fmt::join(threads, ", ")));
  return reasons;
}

} // namespace comparisons::metrics
