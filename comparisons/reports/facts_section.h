#pragma once

#include "comparisons/reports/groups.h"
#include "comparisons/reports/table.h"

#include <string_view>

namespace comparisons::reports {

/// A quantity of a cell that belongs to the comparison of methods and to no other table.
inline bool is_fact(std::string_view quantity) { return quantity.starts_with("fact_"); }

/// Zhang & Batra 2008, Table 7, row by row: the paper's words on SSPH and finite elements, and beside them what was
/// measured of every method at one level. Nothing for groups whose scene did not ask for it (`facts` in [study]).
void append_facts(Document &document, const std::vector<Group> &groups);

} // namespace comparisons::reports
