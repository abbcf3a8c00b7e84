#pragma once

#include "comparisons/reports/results.h"

#include <filesystem>
#include <string>
#include <vector>

namespace comparisons::reports {

/// A figure for a paper: a gnuplot script and the data that it draws. The script can be edited and run again; it makes
/// name.svg and name.pdf beside it.
struct GnuplotFigure {
  std::string name; ///< of the files, without ending
  std::string script;
  std::string data;
};

/// Figures for what the results contain: error against seconds, convergence with slope triangles, seconds by phase, and
/// from the data files of the cells (below `series_directory`) profiles and other curves, beside the exact ones where
/// the file has columns "exact_...", fields of the error on one scale and deformed shapes. Data files that are not
/// there are left out.
std::vector<GnuplotFigure> gnuplot_figures(const Results &results, const std::filesystem::path &series_directory);

/// Writes scripts and data into `directory` and, where gnuplot is found, lets it draw SVG and PDF.
/// @return files written; what gnuplot complains of is added to `complaints`
std::vector<std::filesystem::path> write_figures(const std::vector<GnuplotFigure> &figures,
                                                 const std::filesystem::path &directory,
                                                 std::vector<std::string> &complaints);

} // namespace comparisons::reports
