#pragma once

#include "comparisons/hard_cases/matrix.h"
#include "comparisons/reports/results.h"
#include "comparisons/study/cell_journal.h"

#include <vector>

namespace comparisons::hard_cases {

/// The name of the benchmark in results.json.
inline constexpr const char *benchmark_name = "hard_cases";

/// A method's part in a case before it is run: a cell of results.json without a verdict.
reports::Cell described_cell(const HardCase &hard_case, const std::string &method);

/// A cell of the matrix as one of results.json (reports/hard_cases_section.h says what is where): holds and degrades
/// are ok, refused is as expected, fails is not.
reports::Cell report_cell(const HardCase &hard_case, const MatrixCell &cell);

/// The matrix as cells of results.json. Every cell is on the disk before the next is run.
/// @param identity of what they depend on beside the cases
/// @throws reports::OutputError
std::vector<reports::Cell> run_reported_matrix(const std::vector<HardCase> &cases, const MatrixOptions &options,
                                               study::CellJournal &journal, const std::string &identity);

} // namespace comparisons::hard_cases
