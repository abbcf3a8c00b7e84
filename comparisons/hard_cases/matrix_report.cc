#include "comparisons/hard_cases/matrix.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::hard_cases {

namespace {

/// "1.2e-03, 24 x the threshold"
std::string figure(const MatrixCell &cell) {
  if (!cell.error)
    return "-";
  if (cell.verdict == CellVerdict::holds)
    return fmt::format("{:.1e}", *cell.error);
  return fmt::format("{:.1e} ({:.1f} x)", *cell.error, *cell.error / cell.threshold);
}

const HardCase *find(const std::vector<HardCase> &cases, const MatrixCell &cell) {
  const auto found = std::find_if(cases.begin(), cases.end(), [&](const HardCase &hard_case) {
    return hard_case.family == cell.family && hard_case.name == cell.name;
  });
  return found == cases.end() ? nullptr : &*found;
}

std::string shortened(const std::string &text, std::size_t length) {
  return text.size() <= length ? text : text.substr(0, length - 3) + "...";
}

} // namespace

std::string text_report(const std::vector<HardCase> &cases, const std::vector<MatrixCell> &cells) {
  std::string text;
  std::string family, name;
  for (const auto &cell : cells) {
    if (cell.family != family) {
      family = cell.family;
      name.clear();
      text += fmt::format("\n{}\n{}\n", family, std::string(family.size(), '-'));
    }
    if (cell.name != name) {
      name = cell.name;
      const auto *hard_case = find(cases, cell);
      text += fmt::format(
          "{}{}\n", name,
          hard_case == nullptr ? "" : fmt::format(": {}; threshold {:g}", hard_case->reference, hard_case->threshold));
    }
    std::string note = cell.reason;
    if (note.empty() && cell.verdict == CellVerdict::degrades && !cell.warnings.empty())
      note = "warned: " + cell.warnings.front();
    text += fmt::format("  {:<17} {:<9} {:<19} {:>6.2f} s  {}", cell.method, to_text(cell.verdict), figure(cell),
                        cell.seconds, shortened(note, 110));
    while (text.back() == ' ')
      text.pop_back();
    text += '\n';
  }
  const auto n = counts(cells);
  text += fmt::format("\n{} cells: {} hold, {} degrade, {} refused by name, {} fail\n", cells.size(), n.at("holds"),
                      n.at("degrades"), n.at("refused"), n.at("fails"));
  text += "fails: a crash, a hang, no number, or an error above 10 % without a warning\n";
  return text;
}

nlohmann::ordered_json json_report(const std::vector<HardCase> &cases, const std::vector<MatrixCell> &cells) {
  nlohmann::ordered_json json;
  json["schema"] = 1;
  json["kind"] = "hard_cases";
  for (const auto &[verdict, n] : counts(cells))
    json["counts"][verdict] = n;
  json["cases"] = nlohmann::ordered_json::array();
  for (const auto &hard_case : cases)
    json["cases"].push_back({{"family", hard_case.family},
                             {"name", hard_case.name},
                             {"meaning", hard_case.meaning},
                             {"reference", hard_case.reference},
                             {"threshold", hard_case.threshold},
                             {"reason", hard_case.reason}});
  json["cells"] = nlohmann::ordered_json::array();
  for (const auto &cell : cells) {
    nlohmann::ordered_json entry{{"family", cell.family}, {"case", cell.name}, {"method", cell.method}};
    entry["verdict"] = to_text(cell.verdict);
    entry["error"] = cell.error ? nlohmann::ordered_json(*cell.error) : nlohmann::ordered_json();
    entry["value"] = cell.value ? nlohmann::ordered_json(*cell.value) : nlohmann::ordered_json();
    entry["reason"] = cell.reason;
    entry["warnings"] = cell.warnings;
    entry["indicators"] = cell.indicators;
    entry["seconds"] = cell.seconds;
    json["cells"].push_back(std::move(entry));
  }
  return json;
}

std::string list_text(const std::vector<HardCase> &cases) {
  std::string text;
  for (const auto &hard_case : cases)
    text += fmt::format("{}: {}{}\n  {}\n  reference: {}\n  threshold {:g}: {}\n", hard_case.family, hard_case.name,
                        hard_case.quick ? "" : " (not with --quick)", hard_case.meaning, hard_case.reference,
                        hard_case.threshold, hard_case.reason);
  return text;
}

} // namespace comparisons::hard_cases
