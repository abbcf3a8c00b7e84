#pragma once

#include "comparisons/program/options.h"
#include "comparisons/study/catalogue.h"

#include <filesystem>
#include <string>
#include <vector>

namespace comparisons::program {

/// `petrov check`: validates scenes and builds their problems and points, without solving.
int check_scenes(const std::vector<std::filesystem::path> &files, const CommonOptions &options,
                 const study::Catalogue &catalogue);

/// `petrov explain`: what a scene calls for and what not, its cells with unknowns and estimates of
/// memory and time, and what each key means.
int explain_scene(const std::filesystem::path &file, const CommonOptions &options, const study::Catalogue &catalogue);

/// `petrov list methods|bases|kernels|effects|benchmarks`.
int list_names(const std::string &what, const study::Catalogue &catalogue);

/// `petrov init BENCHMARK`: prints or writes a scene to start from; never overwrites a file.
int write_initial_scene(const std::string &benchmark, const std::string &file, const study::Catalogue &catalogue);

/// `petrov report RESULTS`: rebuilds the reports from results.json.
int rebuild_report(const std::filesystem::path &results, const CommonOptions &options);

/// `petrov report FIRST SECOND`: two runs side by side; with --output also as text, Markdown and LaTeX.
int compare_runs(const std::filesystem::path &first, const std::filesystem::path &second, const CommonOptions &options);

} // namespace comparisons::program
