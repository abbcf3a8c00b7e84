#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace comparisons::reports {

/// One run of two that are compared.
struct NamedResults {
  std::string name; ///< file
  Results results;
};

/// Ratio of two measured times, second over first, with what the spread of the repeats leaves open.
struct TimeRatio {
  double ratio = 1; ///< of the medians
  double least = 1; ///< minimum of the second over maximum of the first
  double largest = 1;

  /// The two times may be the same.
  bool holds_one() const { return least <= 1 && 1 <= largest; }
};

/// None if one of the two has no total.
std::optional<TimeRatio> time_ratio(const Cell &first, const Cell &second);

/// Cells with the same benchmark, scene, variant, label and level, in the order of the first run.
std::vector<std::pair<const Cell *, const Cell *>> paired_cells(const Results &first, const Results &second);

/// Two runs side by side, of two machines, versions or settings: what differs around them, ratios of seconds with what
/// their spread leaves open, errors that changed, cells that only one has.
Document side_by_side(const NamedResults &first, const NamedResults &second);

} // namespace comparisons::reports
