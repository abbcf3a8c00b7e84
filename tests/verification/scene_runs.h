#pragma once

#include "comparisons/metrics/machine.h"
#include "comparisons/scene/reader.h"
#include "comparisons/study/cell_run.h"
#include "comparisons/study/run_scene.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

/// Scenes run through the library, once a cell, without repeats and without files.
namespace scene_runs {

using namespace comparisons;
using Overrides = std::vector<std::string>;

/// The scene of a text; throws with all findings if it is not valid.
inline scene::Scene read(const std::string &text, const Overrides &overrides = {},
                         const study::Catalogue &catalogue = study::shipped_catalogue()) {
  auto result = scene::read_scene_text(text, "test.toml", overrides, study::vocabulary_of(catalogue));
  if (!result.scene)
    throw std::runtime_error(scene::to_text(result.diagnostics));
  return std::move(*result.scene);
}

/// A scene of the cantilever's folder.
inline scene::Scene read_shipped(const std::string &name, const Overrides &overrides = {}) {
  const auto file = std::filesystem::path(PETROV_SOURCE_DIR) / "comparisons/benchmarks/cantilever" / (name + ".toml");
  auto result = scene::read_scene(file, overrides, study::vocabulary_of(study::shipped_catalogue()));
  if (!result.scene)
    throw std::runtime_error(scene::to_text(result.diagnostics));
  return std::move(*result.scene);
}

inline std::vector<reports::Cell> run(const scene::Scene &scene,
                                      const study::Catalogue &catalogue = study::shipped_catalogue()) {
  metrics::use_threads(1);
  std::vector<reports::Cell> cells;
  for (const auto &variant : scene.problems) {
    const auto experiment =
        study::find_benchmark(catalogue, scene.benchmark).make_experiment(scene, variant, catalogue.methods);
    for (const auto &request : scene.methods)
      for (const auto &level : request.levels)
        cells.push_back(study::run_cell({&scene, &variant, experiment.get(), &request, &level}, true, {}));
  }
  return cells;
}

/// "weak1 order=3, 16x4, jitter=0.25: reason", for messages.
inline std::string name_of(const reports::Cell &cell) {
  return cell.label + ", " + cell.level + (cell.variant.empty() ? "" : ", " + cell.variant) +
         (cell.reason.empty() ? "" : ": " + cell.reason);
}

/// The only cell with this label, level and variant.
inline const reports::Cell &find(const std::vector<reports::Cell> &cells, const std::string &label,
                                 const std::string &level, const std::string &variant = {}) {
  const reports::Cell *found = nullptr;
  for (const auto &cell : cells)
    if (cell.label == label && cell.level == level && cell.variant == variant) {
      if (found != nullptr)
        throw std::runtime_error("two cells " + label + ", " + level + ", " + variant);
      found = &cell;
    }
  if (found == nullptr)
    throw std::runtime_error("no cell " + label + ", " + level + ", " + variant);
  return *found;
}

/// An error of a cell; not a number if the cell has none.
inline double error_of(const reports::Cell &cell, const std::string &name) {
  return reports::reportable(cell, cell.errors, name).value_or(std::nan(""));
}

inline double l2(const reports::Cell &cell) { return error_of(cell, "displacement_l2_relative"); }
inline double stress_l2(const reports::Cell &cell) { return error_of(cell, "stress_l2_relative"); }

/// Observed order of the L2 error of the displacement between two levels.
inline double rate(const reports::Cell &coarse, const reports::Cell &fine) {
  return std::log(l2(coarse) / l2(fine)) /
         std::log(reports::relative_spacing(coarse).value() / reports::relative_spacing(fine).value());
}

} // namespace scene_runs
