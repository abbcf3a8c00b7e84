#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

#include <string>

namespace comparisons::reports {

/// Published numbers and claims beside what was computed, by source, the remarks as numbered notes, and the summary.
void append_ledger(Document &document, const Results &results);

/// "27 of 29 published numbers reproduced; 9 claims hold, 4 do not (expected)", with the unexpected counted apart.
std::string ledger_summary(const Results &results);

/// "reproduced", "differs (expected)", "does not hold (UNEXPECTED)".
std::string verdict_text(const Published &entry);

} // namespace comparisons::reports
