#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

#include <optional>
#include <string>
#include <vector>

namespace comparisons::reports {

/// Who reaches a target error in the least time.
struct Winner {
  std::string label;
  double seconds = 0;
};

/// What a reader wants to know of one benchmark in ten seconds.
struct BenchmarkSummary {
  std::string benchmark;
  std::string scene; ///< the one that compares most methods over several levels; with its variant
  std::string error; ///< that the targets are of
  /// At 1 % and 0.1 %: the best of all in that scene, and the best that is no finite element; by interpolation, or a
  /// measured cell at or below the target if that takes less.
  std::optional<Winner> best[2];
  std::optional<Winner> best_meshless[2];
  int values = 0; ///< published numbers
  int reproduced = 0;
  int claims = 0;
  int holding = 0;
  int not_ok = 0; ///< cells failed, refused or at a limit as expected
  int unexpected = 0;
};

inline constexpr double summary_targets[2] = {0.01, 0.001};

std::vector<BenchmarkSummary> summarise(const Results &results);

/// The section that closes a report.
void append_summary(Document &document, const Results &results);

} // namespace comparisons::reports
