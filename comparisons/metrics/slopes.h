#pragma once

#include "comparisons/reports/results.h"

#include <span>
#include <string>
#include <vector>

namespace comparisons::metrics {

/// Slope of log(error) against log(spacing) by least squares.
/// @param counts points along an axis (spacing 1 / count); at least two, errors > 0
double least_squares_slope(std::span<const double> counts, std::span<const double> errors);

/// For every series of cells that differ only in their level (a number of points along an axis), adds the
/// least-squares slope of the error as quantity "<error>_slope" to the cell of the finest level.
/// Series with fewer than three levels, or with a cell that is not ok, get none.
void add_slopes(const std::string &error, std::vector<reports::Cell> &cells);

} // namespace comparisons::metrics
