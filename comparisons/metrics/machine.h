#pragma once

#include "comparisons/reports/results.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace comparisons::metrics {

/// What this machine is and what it was doing when the run began.
reports::Machine describe_machine(int threads);

/// Name, version, commit and flags of this program.
reports::Program describe_program();

/// Sets the number of threads of BLAS, of meshless and of fem_reference, and with it that of TBB in the process.
/// @throws std::runtime_error if the addresses that BLAS works in are more than this process may have
void use_threads(int threads);

/// One-minute load average of the machine, if the system tells.
std::optional<double> current_load();

/// What others do meanwhile: the processor time of the whole machine less that of this process and its children.
class CompetingWork {
public:
  /// Starts to count.
  CompetingWork();
  /// Cores that other processes kept busy since then, on the average; nothing if the system does not tell, or before
  /// its clock of 10 ms has ticked often enough to say.
  std::optional<double> cores() const;

private:
  std::optional<double> machine_seconds_;
  double own_seconds_;
  double start_;
};

/// Of others' work, in cores, less is taken for the system's own.
inline constexpr double least_competing_cores = 0.2;

/// Reasons why timings of this run are not comparable; empty if there are none: a Debug build, other work beside the
/// run, and methods or scenes with differing numbers of threads. Other work is that measured while the cells ran
/// (Machine::competing_cores); only where that is not known do the load averages at the start and the end tell, which
/// still hold what ended a minute before.
/// @param threads numbers of threads that the scenes ask for
/// @param seconds duration of the run so far; a load average needs a minute to mean something
std::vector<std::string> reasons_not_comparable(const reports::Program &program, const reports::Machine &machine,
                                                const std::set<int> &threads = {}, double seconds = 0);

} // namespace comparisons::metrics
