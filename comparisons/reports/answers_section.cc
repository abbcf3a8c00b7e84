#include "comparisons/reports/answers_section.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/numbers.h"
#include "comparisons/reports/theory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace comparisons::reports {

namespace {

using Entries = std::vector<const EqualError *>;

bool same_table(const EqualError &a, const EqualError &b) {
  return a.benchmark == b.benchmark && a.scene == b.scene && a.variant == b.variant && a.error == b.error;
}

/// Entries by table, in the order in which they appear.
std::vector<Entries> tables_of(const Results &results) {
  std::vector<Entries> tables;
  for (const EqualError &entry : results.equal_error) {
    auto found = std::find_if(tables.begin(), tables.end(),
                              [&](const Entries &entries) { return same_table(*entries.front(), entry); });
    if (found == tables.end())
      found = tables.insert(tables.end(), Entries());
    found->push_back(&entry);
  }
  return tables;
}

template <typename Value, typename Get>
std::vector<Value> distinct(const Entries &entries, Get get) {
  std::vector<Value> values;
  for (const EqualError *entry : entries)
    if (std::find(values.begin(), values.end(), get(*entry)) == values.end())
      values.push_back(get(*entry));
  return values;
}

Table cost_table(const Entries &entries, const std::vector<std::string> &methods) {
  const auto targets = distinct<double>(entries, [](const EqualError &entry) { return entry.target; });
  std::vector<Column> columns{{"method", Align::left, true}};
  for (const double target : targets)
    columns.push_back({"s for\n" + target_text(target, entries.front()->error)});
  Table table(columns);
  for (const std::string &method : methods) {
    std::vector<std::string> row{method};
    for (const double target : targets) {
      const auto found = std::find_if(entries.begin(), entries.end(), [&](const EqualError *entry) {
        return entry->method == method && entry->target == target;
      });
      row.push_back(found == entries.end() ? no_number : seconds((*found)->seconds));
    }
    table.add_row(std::move(row));
  }
  return table;
}

/// "strong: not reached: 1.4e-02 at 61x13 (0.1 %, 0.01 %)", one line a method and reason.
std::vector<std::string> dashes_explained(const Entries &entries, const std::vector<std::string> &methods) {
  std::vector<std::string> items;
  for (const std::string &method : methods) {
    Entries own;
    std::copy_if(entries.begin(), entries.end(), std::back_inserter(own),
                 [&](const EqualError *entry) { return entry->method == method && !entry->reason.empty(); });
    for (const auto &reason : distinct<std::string>(own, [](const EqualError &entry) { return entry.reason; })) {
      std::vector<std::string> targets;
      for (const EqualError *entry : own)
        if (entry->reason == reason)
          targets.push_back(target_text(entry->target, entry->error));
      items.push_back(fmt::format("{}: {} ({})", method, reason, fmt::join(targets, ", ")));
    }
  }
  return items;
}

std::string group_title(const EqualError &entry) {
  std::string text = entry.benchmark;
  if (!entry.scene.empty())
    text += " / " + entry.scene;
  return entry.variant.empty() ? text : text + ", " + entry.variant;
}

} // namespace

std::string words_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string target_text(double target, std::string_view error) {
  return target >= 9e-5 && error.find("relative") != std::string_view::npos ? fmt::format("{:.6g} %", 100 * target)
                                                                            : fmt::format("{:.0e}", target);
}

void append_equal_error(Document &document, const Results &results) {
  if (results.equal_error.empty())
    return;
  document.push_back(Heading{2, "Seconds for equal errors"});
  document.push_back(Paragraph{
      "Interpolated on logarithmic axes between the two levels around the target, never beyond the measured ones; the "
      "reasons of dashes stand below."});
  for (const Entries &entries : tables_of(results)) {
    const auto methods = distinct<std::string>(entries, [](const EqualError &entry) { return entry.method; });
    document.push_back(
        Heading{3, fmt::format("{}: {}", group_title(*entries.front()), words_of(entries.front()->error))});
    document.push_back(cost_table(entries, methods));
    if (auto items = dashes_explained(entries, methods); !items.empty())
      document.push_back(Bullets{std::move(items)});
  }
}

void append_pareto(Document &document, const std::vector<Group> &groups) {
  bool has_heading = false;
  for (const Group &group : groups) {
    Table table({{"error", Align::left},
                 {"method", Align::left, true},
                 {"level", Align::left},
                 {"value"},
                 {"total\ns"},
                 {"1 / (error x\nseconds)"},
                 {"1 / (error x\nMB)"}});
    for (const std::string &error : headline_errors(group))
      for (const Cell *cell : pareto_front(group, error))
        table.add_row({words_of(error), cell->label, cell->level, scientific(target_error(*cell, error)),
                       seconds(median_seconds(*cell, "total")), scientific(efficiency(*cell, error)),
                       scientific(accuracy_per_megabyte(*cell, error))});
    if (!has_several_levels(group) && group.scene != "scene")
      continue; // a study of one parameter has no cost to choose by
    // A front of one cell, or a group with nothing to choose from, says nothing.
    if (table.rows().size() < 2 || group.cells.size() < 2)
      continue;
    if (!has_heading) {
      document.push_back(Heading{2, "Not beaten in seconds and error (Pareto front)"});
      document.push_back(Paragraph{"No other cell of the table's group is both faster and more accurate than these."});
      has_heading = true;
    }
    document.push_back(Heading{3, group.title()});
    document.push_back(std::move(table));
  }
}

void append_rates(Document &document, const std::vector<Group> &groups) {
  bool has_heading = false;
  for (const Group &group : groups) {
    Table table({{"error", Align::left},
                 {"method", Align::left, true},
                 {"between levels", Align::left},
                 {"least\nsquares"},
                 {"theory"}});
    for (const std::string &error : headline_errors(group))
      for (const MethodSeries &series : series_of(group)) {
        std::vector<std::string> rates;
        for (const Cell *cell : series.cells)
          if (const auto observed = observed_rate(group, *cell, error))
            rates.push_back(rate(observed));
        if (!rates.empty())
          table.add_row({words_of(error), series.label, fmt::format("{}", fmt::join(rates, " ")),
                         rate(least_squares_rate(series, error)),
                         exact(theoretical_rate(*series.cells.front(), error))});
      }
    if (table.rows().empty())
      continue;
    table.drop_columns_without(no_number);
    if (!has_heading) {
      document.push_back(Heading{2, "Orders of convergence"});
      document.push_back(Paragraph{
          "Observed between neighbouring levels from coarse to fine, and by least squares over all of them; theory is "
          "for smooth solutions on quasi-uniform points and may be exceeded on uniform ones."});
      has_heading = true;
    }
    document.push_back(Heading{3, group.title()});
    document.push_back(std::move(table));
  }
}

} // namespace comparisons::reports
