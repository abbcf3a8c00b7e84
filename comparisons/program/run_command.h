#pragma once

#include "comparisons/program/options.h"
#include "comparisons/reports/results.h"
#include "comparisons/study/catalogue.h"

#include <filesystem>
#include <string>
#include <vector>

namespace comparisons::program {

/// `petrov run`: validates all scenes, runs them, writes and prints the reports.
/// @param against_papers settle the published numbers of the scenes' benchmarks
/// @return the exit code, see ExitCode
int run_scenes(const std::vector<std::filesystem::path> &files, const CommonOptions &options,
               const study::Catalogue &catalogue);

/// `petrov compare`: the shipped scenes of the benchmarks, all when none is named.
/// @param full also the scenes whose [study] effort is "full"
int compare_benchmarks(const std::vector<std::string> &benchmarks, bool full, const CommonOptions &options,
                       const study::Catalogue &catalogue);

/// Exit code that results deserve: the gravest of interrupted, a cell out of limits, a cell failed
/// or refused unexpectedly, a published number missed unexpectedly.
int exit_code_of(const reports::Results &results);

} // namespace comparisons::program
