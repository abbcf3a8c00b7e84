#include "comparisons/reports/summary.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/answers_section.h"
#include "comparisons/reports/ledger_section.h"
#include "comparisons/reports/numbers.h"
#include "comparisons/reports/reports.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::reports {

namespace {

void offer(std::optional<Winner> &best, const std::string &label, double seconds) {
  if (!best || seconds < best->seconds)
    best = Winner{label, seconds};
}

/// Methods with several levels in a group: what makes a comparison.
std::size_t n_compared(const Group &group) {
  std::size_t n = 0;
  for (const MethodSeries &series : series_of(group))
    n += series.cells.size() > 1 ? 1 : 0;
  return n;
}

/// Measured cells at or below the target, and points between two levels.
void find_winners(BenchmarkSummary &summary, const Group &group) {
  const auto names = headline_errors(group);
  if (names.empty())
    return;
  summary.error = names.front();
  summary.scene = group.variant.empty() ? group.scene : group.scene + ", " + group.variant;
  for (std::size_t k = 0; k < 2; ++k)
    for (const MethodSeries &series : series_of(group)) {
      std::optional<Winner> own;
      if (const Cost cost = seconds_for_error(series, summary.error, summary_targets[k]); cost.seconds)
        offer(own, series.label, *cost.seconds);
      for (const Cell *cell : series.cells) {
        const auto error = target_error(*cell, summary.error);
        const auto seconds = median_seconds(*cell, "total");
        if (error && *error <= summary_targets[k] && seconds && *seconds > 0)
          offer(own, series.label, *seconds);
      }
      if (!own)
        continue;
      offer(summary.best[k], own->label, own->seconds);
      if (!is_finite_element(series))
        offer(summary.best_meshless[k], own->label, own->seconds);
    }
}

void count_outcomes(BenchmarkSummary &summary, const Results &results) {
  for (const Cell &cell : results.cells)
    if (cell.benchmark == summary.benchmark) {
      summary.not_ok += cell.status != Status::ok && cell.expected ? 1 : 0;
      summary.unexpected += cell.expected ? 0 : 1;
    }
  for (const Published &entry : results.published)
    if (entry.benchmark == summary.benchmark) {
      const bool value = entry.kind == Kind::value;
      ++(value ? summary.values : summary.claims);
      summary.reproduced += value && entry.verdict == Verdict::reproduced ? 1 : 0;
      summary.holding += !value && entry.verdict == Verdict::holds ? 1 : 0;
      summary.unexpected += entry.expected ? 0 : 1;
    }
}

std::string text_of(const std::optional<Winner> &best, const std::optional<Winner> &meshless) {
  if (!best)
    return no_number;
  std::string text = fmt::format("{} {} s", best->label, seconds(best->seconds));
  if (meshless && meshless->label != best->label)
    text += fmt::format("; meshless: {} {} s", meshless->label, seconds(meshless->seconds));
  return text;
}

std::string of(int part, int all) { return all > 0 ? fmt::format("{} of {}", part, all) : no_number; }

} // namespace

std::vector<BenchmarkSummary> summarise(const Results &results) {
  const std::vector<Group> groups = group_cells(results);
  std::vector<BenchmarkSummary> summaries;
  std::vector<const Group *> chosen;
  for (const Group &group : groups) {
    const auto found = std::find_if(summaries.begin(), summaries.end(),
                                    [&](const auto &summary) { return summary.benchmark == group.benchmark; });
    const auto i = static_cast<std::size_t>(found - summaries.begin());
    if (found == summaries.end()) {
      summaries.emplace_back().benchmark = group.benchmark;
      chosen.push_back(&group);
    } else if (n_compared(group) > n_compared(*chosen[i]))
      chosen[i] = &group;
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    find_winners(summaries[i], *chosen[i]);
    count_outcomes(summaries[i], results);
  }
  return summaries;
}

void append_summary(Document &document, const Results &results) {
  document.push_back(Heading{2, "Summary"});
  Table table({{"benchmark", Align::left},
               {"scene: error", Align::left, true},
               {"best at\n0.01", Align::left, true},
               {"best at\n0.001", Align::left, true},
               {"numbers\nreproduced", Align::left},
               {"claims\nthat hold", Align::left},
               {"refused\nor failed", Align::right},
               {"unexpected", Align::right}});
  for (const BenchmarkSummary &summary : summarise(results))
    table.add_row(
        {summary.benchmark, summary.error.empty() ? no_number : summary.scene + ": " + words_of(summary.error),
         text_of(summary.best[0], summary.best_meshless[0]), text_of(summary.best[1], summary.best_meshless[1]),
         of(summary.reproduced, summary.values), of(summary.holding, summary.claims),
         summary.not_ok > 0 ? fmt::format("{}", summary.not_ok) : "0", fmt::format("{}", summary.unexpected)});
  if (!table.rows().empty()) {
    table.drop_columns_without(no_number);
    document.push_back(std::move(table));
  }
  for (const std::string &reason : results.not_comparable)
    document.push_back(Alarm{"NOT COMPARABLE: " + reason});
  const std::size_t n = unexpected_outcomes(results).size();
  document.push_back(Paragraph{n == 0   ? "No unexpected outcomes."
                               : n == 1 ? "1 unexpected outcome, named above."
                                        : fmt::format("{} unexpected outcomes, named above.", n)});
}

} // namespace comparisons::reports
