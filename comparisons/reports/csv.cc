#include "comparisons/reports/numbers.h"
#include "comparisons/reports/reports.h"

#include <fmt/format.h>

#include <cmath>

namespace comparisons::reports {

namespace {

std::string field(const std::string &text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"')
      quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string number(std::optional<double> value) {
  return value && std::isfinite(*value) ? exact(value) : std::string();
}

std::string line(const std::vector<std::string> &fields) {
  std::string text;
  for (const std::string &entry : fields)
    text += (&entry == &fields.front() ? "" : ",") + field(entry);
  return text + '\n';
}

/// Rows of one cell share all but the last columns.
class CellRows {
public:
  CellRows(std::string &csv, const Cell &cell) : csv_(csv) {
    front_ = {cell.benchmark,
              cell.scene,
              cell.variant,
              cell.method,
              cell.label,
              cell.level,
              fmt::format("{}", cell.n_points),
              fmt::format("{}", cell.n_dofs),
              to_text(cell.status),
              cell.expected ? "true" : "false",
              cell.reason};
  }

  void add(const std::string &kind, const std::string &quantity, const std::string &value) {
    std::vector<std::string> fields = front_;
    fields.insert(fields.end(), {kind, quantity, value});
    csv_ += line(fields);
  }

private:
  std::string &csv_;
  std::vector<std::string> front_;
};

void append_cell(std::string &csv, const Cell &cell) {
  CellRows rows(csv, cell);
  if (cell.status != Status::ok) {
    rows.add("none", "", "");
    return;
  }
  for (const auto &entry : cell.errors)
    rows.add("error", entry.first, number(reportable(cell, cell.errors, entry.first)));
  for (const auto &entry : cell.quantities)
    rows.add("quantity", entry.first, number(reportable(cell, cell.quantities, entry.first)));
  for (const char *phase : phases) {
    const auto found = cell.seconds.find(phase);
    if (found == cell.seconds.end())
      continue;
    rows.add("seconds", phase, number(found->second.median));
    rows.add("seconds_minimum", phase, number(found->second.minimum));
    rows.add("seconds_maximum", phase, number(found->second.maximum));
  }
  rows.add("size", "repeats", fmt::format("{}", cell.repeats));
  rows.add("size", "steps", fmt::format("{}", cell.steps));
  rows.add("size", "memory_bytes", fmt::format("{}", cell.memory_bytes));
  rows.add("size", "nonzeros", fmt::format("{}", cell.nonzeros));
}

} // namespace

std::string csv_report(const Results &results) {
  std::string csv = line({"benchmark", "scene", "variant", "method", "label", "level", "n_points", "n_dofs", "status",
                          "expected", "reason", "kind", "quantity", "value"});
  for (const Cell &cell : results.cells)
    append_cell(csv, cell);
  return csv;
}

std::string csv_published(const Results &results) {
  std::string csv =
      line({"source", "entry", "benchmark", "scene", "variant", "method", "level", "quantity", "kind", "statement",
            "published", "computed", "tolerance", "verdict", "expected", "finding", "remark"});
  for (const Published &entry : results.published)
    csv += line({entry.source, entry.entry, entry.benchmark, entry.scene, entry.variant, entry.method, entry.level,
                 entry.quantity, to_text(entry.kind), entry.statement, number(entry.published), number(entry.computed),
                 number(entry.tolerance), to_text(entry.verdict), entry.expected ? "true" : "false", entry.finding,
                 entry.remark});
  return csv;
}

} // namespace comparisons::reports
