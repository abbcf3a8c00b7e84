#pragma once

#include "comparisons/reports/results.h"

namespace comparisons::metrics {

/// What this machine is and what it was doing when the run began.
reports::Machine describe_machine(int threads);

/// Name, version, commit and flags of this program.
reports::Program describe_program();

/// Sets the number of threads of BLAS (and of what else has its own).
void use_threads(int threads);

/// Reasons why timings of this run are not comparable; empty if there are none.
std::vector<std::string> reasons_not_comparable(const reports::Program &program, const reports::Machine &machine);

} // namespace comparisons::metrics
