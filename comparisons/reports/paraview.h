#pragma once

#include "comparisons/reports/groups.h"

#include <filesystem>
#include <string>
#include <vector>

namespace comparisons::reports {

struct TextFile {
  std::string name; ///< path relative to the folder of the output
  std::string text;
};

/// What ParaView needs of a group of cells beside the fields that the run wrote (.vtu): states of runs in time, which
/// are tables over x, as points on a line, and a collection (.pvd) of all. The times of a collection are seconds if
/// there are such states, else the numbers of the levels; its parts are the methods at each level, or the methods.
///
/// @param series folder that the cells' files are relative to
/// @param directory folder of the output
/// @returns no file if no cell has a field; a table that is missing or no table is left out
std::vector<TextFile> paraview_files(const Group &group, const std::filesystem::path &series,
                                     const std::filesystem::path &directory);

} // namespace comparisons::reports
