#pragma once

#include "comparisons/metrics/memory.h"
#include "comparisons/reports/results.h"

#include "meshless/linear_algebra/stopwatch.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comparisons::benchmarks::rod {

/// Collects what the arrangements of a cell gave, and writes the cell.
class Measurement {
public:
  /// Seconds by phase, summed over the arrangements.
  std::map<std::string, double> seconds;
  /// Moment matrices of all arrangements that are not positive definite: factorised with complete pivoting.
  std::size_t n_pivoted = 0;

  /// The errors of one more arrangement.
  void add(const std::map<std::string, double> &errors);

  /// Seconds with their total, memory, `n_pivoted` if there are any and, if any were added, the errors: geometric
  /// means, with those of every arrangement as quantities "<error>_seed_<k>" for `add_slopes`, which removes them.
  void write(reports::Cell &cell) const;

private:
  metrics::PeakMemory memory_;
  std::map<std::string, std::vector<double>> errors_;
};

/// max |a - b|
double largest_difference(std::span<const double> a, std::span<const double> b);

/// For every series of cells that differ only in their level, and every error: slopes of log(error) against
/// log(spacing) as quantities of the finest level: "<error>_slope" by least squares over all levels, "_slope_first"
/// (not of errors "_inside") and "_slope_last" between the first and the last two; if there are several arrangements
/// "_slope_least" and
/// "_slope_largest", those of single ones. No slope is given if an error is at rounding level, or a cell not ok.
void add_slopes(std::vector<reports::Cell> &cells);

/// Writes columns as CSV below `directory` and enters it in the cell.
/// @param time of the state that the columns hold, s; its first column is then the place "x"
/// @throws reports::OutputError
void write_series(const std::filesystem::path &directory, const std::string &name,
                  const std::vector<std::string> &headings, const std::vector<std::vector<double>> &columns,
                  reports::Cell &cell, std::optional<double> time = {});

} // namespace comparisons::benchmarks::rod
