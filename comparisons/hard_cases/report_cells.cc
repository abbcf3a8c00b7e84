#include "comparisons/hard_cases/report_cells.h"

#include <fmt/format.h>

#include <utility>

namespace comparisons::hard_cases {

namespace {

/// A method's part in a case before it is run.
reports::Cell described_cell(const HardCase &hard_case, const std::string &method) {
  reports::Cell cell;
  cell.benchmark = benchmark_name;
  cell.scene = hard_case.family;
  cell.variant = hard_case.name;
  cell.method = cell.label = method;
  cell.level = "-";
  cell.parameters["threshold"] = hard_case.threshold;
  cell.parameters["meaning"] = hard_case.meaning;
  cell.parameters["reference"] = hard_case.reference;
  cell.parameters["reason"] = hard_case.reason;
  return cell;
}

/// All but the verdict.
reports::Cell report_cell(const HardCase &hard_case, const MatrixCell &from) {
  auto cell = described_cell(hard_case, from.method);
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
  return cell;
}

/// From status, error and threshold, as `judge` has it.
void add_verdict(reports::Cell &cell) {
  auto verdict = CellVerdict::degrades;
  if (cell.status == reports::Status::failed)
    verdict = CellVerdict::fails;
  else if (cell.status == reports::Status::refused)
    verdict = CellVerdict::refused;
  else if (cell.errors.at("error_of_case") <= cell.parameters.at("threshold").get<double>())
    verdict = CellVerdict::holds;
  cell.parameters["verdict"] = to_text(verdict);
}

} // namespace

std::vector<reports::Cell> run_reported_matrix(const std::vector<HardCase> &cases, const MatrixOptions &options,
                                               study::CellJournal &journal, const std::string &identity) {
  std::vector<reports::Cell> cells;
  for (const auto &hard_case : cases)
    for (const auto &method : hard_case.methods) {
      if (auto kept = journal.recall(identity, described_cell(hard_case, method)))
        cells.push_back(std::move(kept->cell));
      else if (const auto run = run_cell(hard_case, method, options)) {
        cells.push_back(report_cell(hard_case, *run));
        journal.keep(identity, {cells.back(), {}, true});
      } else
        return cells;
      add_verdict(cells.back()); // not before: a kept cell is looked for by what is known beforehand
    }
  return cells;
}

} // namespace comparisons::hard_cases
