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

/// Sets the number of threads of BLAS (and of what else has its own).
void use_threads(int threads);

/// One-minute load average of the machine, if the system tells.
std::optional<double> current_load();

/// Reasons why timings of this run are not comparable; empty if there are none: a Debug build, other work at the start
/// of the run or, as far as the load at the end tells, during it, and methods or scenes with differing numbers of
/// threads.
/// @param threads numbers of threads that the scenes ask for
/// @param seconds duration of the run so far; a load average needs a minute to mean something
std::vector<std::string> reasons_not_comparable(const reports::Program &program, const reports::Machine &machine,
                                                const std::set<int> &threads = {}, double seconds = 0);

} // namespace comparisons::metrics
