#pragma once

#include "comparisons/reports/groups.h"
#include "comparisons/reports/table.h"

namespace comparisons::reports {

/// Errors, total seconds and memory, one table a group, the reasons of cells that are not ok below it.
void append_comparison(Document &document, const std::vector<Group> &groups);
/// Seconds by phase, with the spread of the repeats; one above 10 % is named.
void append_phases(Document &document, const std::vector<Group> &groups);
/// How well the particles suit the bases: neighbours, distances, moment matrices (quantities named cloud_...).
void append_clouds(Document &document, const std::vector<Group> &groups);
/// Errors and quantities that the comparison does not show.
void append_further_quantities(Document &document, const std::vector<Group> &groups);

/// "ok", "refused (expected)", "failed (UNEXPECTED)".
std::string status_text(const Cell &cell);

} // namespace comparisons::reports
