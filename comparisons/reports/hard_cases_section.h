#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

#include <string>

namespace comparisons::reports {

/// Cells of the matrix of hard cases: `scene` is the family, `variant` the case, and `parameters` say its verdict,
/// meaning, reference, threshold and reason. They have a section of their own and are in no other comparison.
inline bool is_hard_case(const Cell &cell) { return cell.benchmark == "hard_cases"; }

bool has_hard_cases(const Results &results);

/// Case x method with verdict, figure and reference, a table a family; the counts above.
void append_hard_cases(Document &document, const Results &results);

/// The counts alone, for the terminal; nothing without hard cases.
void append_hard_cases_in_brief(Document &document, const Results &results);

} // namespace comparisons::reports
