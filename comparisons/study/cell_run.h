#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/scene/scene.h"
#include "comparisons/study/experiment.h"

#include <filesystem>

namespace comparisons::study {

/// One cell: what is to be solved, by what, and how finely.
struct CellTask {
  const scene::Scene *scene = nullptr;
  const scene::ProblemVariant *variant = nullptr;
  const Experiment *experiment = nullptr;
  const scene::MethodRequest *request = nullptr;
  const scene::Level *level = nullptr;
};

/// The cell before anything was computed: names and parameters.
reports::Cell describe_cell(const CellTask &task);

/// Runs once. Never throws for what a method does: the cell's status and reason tell. A value that is
/// not finite makes the cell fail.
reports::Cell run_cell(const CellTask &task, bool with_errors, const std::filesystem::path &series_directory);

} // namespace comparisons::study
