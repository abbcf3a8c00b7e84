#include "comparisons/hard_cases/report_cells.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::hard_cases {

std::vector<reports::Cell> report_cells(const std::vector<HardCase> &cases, const std::vector<MatrixCell> &cells) {
  std::vector<reports::Cell> result;
  for (const auto &from : cells) {
    reports::Cell cell;
    cell.benchmark = "hard_cases";
    cell.scene = from.family;
    cell.variant = from.name;
    cell.method = cell.label = from.method;
    cell.level = "-";
    cell.parameters["verdict"] = to_text(from.verdict);
    cell.parameters["threshold"] = from.threshold;
    const auto hard_case = std::find_if(cases.begin(), cases.end(), [&](const HardCase &candidate) {
      return candidate.family == from.family && candidate.name == from.name;
    });
    if (hard_case != cases.end()) {
      cell.parameters["meaning"] = hard_case->meaning;
      cell.parameters["reference"] = hard_case->reference;
      cell.parameters["reason"] = hard_case->reason;
    }
    const bool fails = from.verdict == CellVerdict::fails;
    cell.status = fails                                  ? reports::Status::failed
                  : from.verdict == CellVerdict::refused ? reports::Status::refused
                                                         : reports::Status::ok;
    cell.expected = !fails;
    cell.reason = from.reason;
    if (fails && from.error)
      cell.reason += fmt::format(": {:.2g}", *from.error);
    cell.warnings = from.warnings;
    if (from.error)
      cell.errors["error_of_case"] = *from.error;
    if (from.value)
      cell.quantities["value"] = *from.value;
    for (const auto &[name, value] : from.indicators)
      cell.quantities["indicator_" + name] = value;
    cell.quantities["wall_seconds"] = from.seconds;
    result.push_back(std::move(cell));
  }
  return result;
}

} // namespace comparisons::hard_cases
