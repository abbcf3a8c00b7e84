#pragma once

#include "comparisons/study/catalogue.h"

#include <vector>

namespace comparisons::benchmarks {

/// The one table of benchmarks.
std::vector<study::Benchmark> benchmark_table();

} // namespace comparisons::benchmarks
