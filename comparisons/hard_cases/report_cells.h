#pragma once

#include "comparisons/hard_cases/matrix.h"
#include "comparisons/reports/results.h"
#include "comparisons/study/cell_journal.h"

#include <vector>

namespace comparisons::hard_cases {

/// The name of the benchmark in results.json.
inline constexpr const char *benchmark_name = "hard_cases";

/// The matrix as cells of results.json (reports/hard_cases_section.h says what is where): holds and degrades are ok,
/// refused is as expected, fails is not. Every cell is on the disk before the next is run.
/// @param identity of what they depend on beside the cases
/// @throws reports::OutputError
std::vector<reports::Cell> run_reported_matrix(const std::vector<HardCase> &cases, const MatrixOptions &options,
                                               study::CellJournal &journal, const std::string &identity);

} // namespace comparisons::hard_cases
