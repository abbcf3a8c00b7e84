#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/scene/scene.h"
#include "comparisons/study/catalogue.h"
#include "comparisons/study/cell_journal.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace comparisons::study {

struct RunOptions {
  /// Each cell in a child process; a scene with max_memory or max_seconds isolates by itself.
  bool isolate = false;
  /// Folder of the results; series are written below it.
  std::filesystem::path directory;
  /// Write the sample lines of every cell as data files.
  bool write_series = true;
  /// Asked between cells (and while a child runs); true ends the run with what is there.
  std::function<bool()> stop_requested;
  /// One line on what is done now.
  std::function<void(const std::string &)> progress;
  /// The same from within a long cell, at most twice a second.
  std::function<void(const std::string &)> long_progress = {};
  /// Gets every run of a cell and gives back the cells of an earlier run; null: none.
  CellJournal *journal = nullptr;
};

/// Runs every method x level (x problem variant) of a scene: one warm-up of each cell and then
/// `repeats` rounds over all cells, interleaved, so that a drift of the machine's speed meets all
/// methods alike. A cell that takes more than ten seconds is run once. A cell that needs more than a quarter of a GB
/// finds its memory ready (metrics::ReadyMemory). Errors are those of the first run; each repeat gives a time.
///
/// A cell that fails leaves the others as they are and says why. Cells missing at the end were
/// interrupted.
std::vector<reports::Cell> run_scene(const scene::Scene &scene, const Catalogue &catalogue, const RunOptions &options);

/// A benchmark of the catalogue.
/// @throws std::invalid_argument if there is none of that name
const Benchmark &find_benchmark(const Catalogue &catalogue, const std::string &name);

} // namespace comparisons::study
