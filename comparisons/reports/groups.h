#pragma once

#include "comparisons/reports/results.h"

#include <string>
#include <vector>

namespace comparisons::reports {

/// The cells of one table: same benchmark, scene and variant. Cells of one label stand together, the labels in
/// the order in which they appear.
struct Group {
  std::string benchmark;
  std::string scene;
  std::string variant;
  std::vector<const Cell *> cells;

  /// "cantilever / order, jitter=0.25"
  std::string title() const;
  /// The level of all cells, or empty if they differ.
  std::string common_level() const;
};

/// Benchmarks in the order in which they appear; within one the scene named "scene" (the main comparison) first. The
/// pointers refer to `results`.
std::vector<Group> group_cells(const Results &results);

/// "weak1 order=2, 16x4"
std::string cell_name(const Cell &cell);

/// Observed order of the error `name` between the previous level of the same label within the group and this one,
/// log(e1/e2) / log(h1/h2) with `relative_spacing`. None for the first level, and none where an error has reached
/// rounding (below 1e-10), where an order means nothing.
std::optional<double> observed_rate(const Group &group, const Cell &cell, std::string_view name);

} // namespace comparisons::reports
