#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/scene/scene.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace comparisons::study {

/// What the cells of a scene depend on besides their own names, as a hash (FNV-1a, 64 bit, hexadecimal): the scene's
/// text and overrides, the contents of every file that a text of the scene names, the program with its flags, and the
/// machine. Cells with the same identity may stand for each other, their seconds included.
std::string identity_of(const scene::Scene &scene, const reports::Program &program, const reports::Machine &machine);
/// The same of cells that no scene describes.
std::string identity_of(const reports::Program &program, const reports::Machine &machine);

/// A cell of a run that goes on.
struct KeptCell {
  reports::Cell cell; ///< of the first run
  /// Seconds of the repeats so far, by phase.
  std::map<std::string, std::vector<double>> samples;
  bool done = false; ///< no further repeats
};

/// The cells of a run with the repeats so far, kept beside its results while it goes on, so that a run which was
/// interrupted or killed goes on where it was.
///
/// One line of JSON whenever there is more of a cell, on the disk before the next run begins: {"identity", "results":
/// {"cells": [one]}, "samples", "done"}; the last one of a cell counts. A line that a kill cut off is passed over.
class CellJournal {
public:
  /// @param resume take the cells that the file holds; else an older file is removed
  /// @throws reports::OutputError
  CellJournal(std::filesystem::path file, bool resume);

  /// The cell of the same names, parameters and identity whose curves are all there; counted as recalled.
  /// @param described the cell before anything was computed
  std::optional<KeptCell> recall(const std::string &identity, const reports::Cell &described);

  /// @throws reports::OutputError
  void keep(const std::string &identity, const KeptCell &kept);

  std::size_t n_recalled() const { return n_recalled_; }

  /// For the end of a complete run, which has nothing to go on with.
  void remove() const;

private:
  std::filesystem::path file_;
  std::map<std::string, KeptCell> cells_;
  std::size_t n_recalled_ = 0;
};

} // namespace comparisons::study
