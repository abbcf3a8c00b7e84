#pragma once

#include "comparisons/reports/groups.h"
#include "comparisons/reports/table.h"

#include <string_view>
#include <vector>

namespace comparisons::reports {

/// A quantity that counts something done so that a cell has a solution: a lower order, larger supports, another solver.
bool is_recovery(std::string_view quantity);

/// The rule of every recovery that there was, and which cells had it how often; nothing where there was none.
void append_recoveries(Document &document, const std::vector<Group> &groups);

} // namespace comparisons::reports
