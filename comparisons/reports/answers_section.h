#pragma once

#include "comparisons/reports/groups.h"
#include "comparisons/reports/table.h"

namespace comparisons::reports {

/// Seconds for equal errors: a table for every group and error, methods by targets, and why there is no number where
/// there is none.
void append_equal_error(Document &document, const Results &results);

/// The cells that no other beats in seconds and error, with what their accuracy costs.
void append_pareto(Document &document, const std::vector<Group> &groups);

/// Observed orders between levels and by least squares, beside the theoretical ones.
void append_rates(Document &document, const std::vector<Group> &groups);

/// "displacement_l2_relative" -> "displacement l2 relative".
std::string words_of(std::string name);
/// "0.1 %" for a relative error, otherwise "1e-03".
std::string target_text(double target, std::string_view error);

} // namespace comparisons::reports
