#include "comparisons/hard_cases/matrix.h"

#include "comparisons/methods/method_table.h"
#include "comparisons/metrics/machine.h"
#include "comparisons/study/isolation.h"

#include "meshless/basis/shape_functions.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

namespace comparisons::hard_cases {

namespace {

using nlohmann::ordered_json;

bool matches(const std::string &text, const std::vector<std::string> &parts) {
  return parts.empty() || std::any_of(parts.begin(), parts.end(),
                                      [&](const auto &part) { return text.find(part) != std::string::npos; });
}

ordered_json refusal(const char *reason) { return {{"refused", reason}}; }

/// In the child: a text for the parent. Exceptions with a reason of the libraries are refusals by name: too few
/// neighbours, a singular system, an ill-posed problem; anything else is told as a failure.
std::string outcome_of(const HardCase &hard_case, const std::string &method) {
  ordered_json json;
  try {
    const auto measurement = hard_case.run(method);
    if (std::isfinite(measurement.error))
      json["error"] = measurement.error;
    else
      json["failed"] = "the error is not finite";
    if (measurement.value && std::isfinite(*measurement.value))
      json["value"] = *measurement.value;
    json["warnings"] = measurement.warnings;
    json["indicators"] = ordered_json::object();
    for (const auto &[name, value] : measurement.indicators)
      if (std::isfinite(value))
        json["indicators"][name] = value;
  } catch (const NamedRefusal &error) {
    json = refusal(error.what());
  } catch (const methods::Refused &error) {
    json = refusal(error.what());
  } catch (const meshless::basis::SingularMomentMatrix &error) {
    json = refusal(error.what());
  } catch (const meshless::linear_algebra::SolveError &error) {
    json = refusal(error.what());
  } catch (const std::invalid_argument &error) {
    json = refusal(error.what());
  } catch (const std::bad_alloc &) {
    json["failed"] = "out of memory";
  } catch (const std::exception &error) {
    json["failed"] = error.what();
  }
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void fill(const HardCase &hard_case, const std::string &text, MatrixCell &cell) {
  const auto json = ordered_json::parse(text);
  if (json.contains("refused")) {
    cell.verdict = CellVerdict::refused;
    cell.reason = json["refused"];
    return;
  }
  if (json.contains("value"))
    cell.value = json["value"].get<double>();
  if (json.contains("failed")) {
    cell.verdict = CellVerdict::fails;
    cell.reason = json["failed"];
    return;
  }
  cell.error = json["error"].get<double>();
  cell.warnings = json["warnings"].get<std::vector<std::string>>();
  cell.indicators = json["indicators"].get<std::map<std::string, double>>();
  cell.verdict = judge(hard_case, {*cell.error, cell.value, cell.warnings, {}});
  if (cell.verdict == CellVerdict::fails)
    cell.reason = "a wrong answer without a warning";
}

} // namespace

const char *to_text(CellVerdict verdict) {
  constexpr const char *texts[] = {"holds", "degrades", "refused", "fails"};
  return texts[static_cast<int>(verdict)];
}

CellVerdict judge(const HardCase &hard_case, const Measurement &measurement) {
  if (!std::isfinite(measurement.error))
    return CellVerdict::fails;
  if (measurement.error <= hard_case.threshold)
    return CellVerdict::holds;
  return measurement.error <= silent_error || !measurement.warnings.empty() ? CellVerdict::degrades
                                                                            : CellVerdict::fails;
}

std::vector<HardCase> select(std::vector<HardCase> cases, const Selection &selection) {
  std::erase_if(cases, [&](HardCase &hard_case) {
    std::erase_if(hard_case.methods, [&](const std::string &m) { return !matches(m, selection.methods); });
    return (selection.quick && !hard_case.quick) || hard_case.methods.empty() ||
           !matches(hard_case.family + ": " + hard_case.name, selection.cases);
  });
  return cases;
}

std::optional<MatrixCell> run_cell(const HardCase &hard_case, const std::string &method, const MatrixOptions &options) {
  if (options.stop_requested && options.stop_requested())
    return {};
  if (options.progress)
    options.progress(fmt::format("{}: {}, {}", hard_case.family, hard_case.name, method));
  metrics::use_threads(1); // BLAS takes all cores otherwise, which small systems only wait for
  MatrixCell cell;
  cell.family = hard_case.family;
  cell.name = hard_case.name;
  cell.method = method;
  cell.threshold = hard_case.threshold;
  meshless::linear_algebra::Stopwatch watch;
  const auto outcome =
      study::run_isolated([&] { return outcome_of(hard_case, method); },
                          {.seconds = options.max_seconds, .memory_bytes = {}}, options.stop_requested);
  cell.seconds = watch.lap();
  if (outcome.kind == study::IsolatedOutcome::Kind::interrupted)
    return {};
  if (outcome.kind == study::IsolatedOutcome::Kind::finished)
    fill(hard_case, outcome.payload, cell);
  else
    cell.reason = outcome.reason;
  return cell;
}

std::vector<MatrixCell> run_matrix(const std::vector<HardCase> &cases, const MatrixOptions &options) {
  std::vector<MatrixCell> cells;
  for (const auto &hard_case : cases)
    for (const auto &method : hard_case.methods) {
      auto cell = run_cell(hard_case, method, options);
      if (!cell)
        return cells;
      cells.push_back(std::move(*cell));
    }
  return cells;
}

std::map<std::string, int> counts(const std::vector<MatrixCell> &cells) {
  std::map<std::string, int> result{{"holds", 0}, {"degrades", 0}, {"refused", 0}, {"fails", 0}};
  for (const auto &cell : cells)
    ++result[to_text(cell.verdict)];
  return result;
}

} // namespace comparisons::hard_cases
