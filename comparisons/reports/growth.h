#pragma once

#include "comparisons/reports/answers.h"
#include "comparisons/reports/table.h"

#include <optional>
#include <string_view>

namespace comparisons::reports {

/// p of cost ~ N^p for the number N of unknowns, by least squares in logarithms over the ok levels of a series.
/// @param cost a phase of `Cell::seconds`, or "memory"
/// @return none unless three levels have a cost and N grows tenfold at least; none for a phase that never takes a
///   millisecond: clocks and caches are then all that is measured
std::optional<double> growth_exponent(const MethodSeries &series, std::string_view cost);

/// The exponents of all series that have any, one table a group.
void append_growth(Document &document, const std::vector<Group> &groups);

} // namespace comparisons::reports
