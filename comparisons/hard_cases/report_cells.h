#pragma once

#include "comparisons/hard_cases/matrix.h"
#include "comparisons/reports/results.h"

#include <vector>

namespace comparisons::hard_cases {

/// The matrix as cells of results.json (reports/hard_cases_section.h says what is where): holds and degrades are ok,
/// refused is as expected, fails is not.
std::vector<reports::Cell> report_cells(const std::vector<HardCase> &cases, const std::vector<MatrixCell> &cells);

} // namespace comparisons::hard_cases
