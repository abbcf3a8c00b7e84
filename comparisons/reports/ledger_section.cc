#include "comparisons/reports/ledger_section.h"

#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::reports {

namespace {

/// Remarks of one section, each text once.
class Remarks {
public:
  /// "[3]", or empty for no remark.
  std::string mark(const std::string &text) {
    if (text.empty())
      return {};
    auto found = std::find(notes_.items.begin(), notes_.items.end(), text);
    if (found == notes_.items.end())
      found = notes_.items.insert(notes_.items.end(), text);
    return fmt::format("[{}]", found - notes_.items.begin() + 1);
  }
  const Notes &notes() const { return notes_; }

private:
  Notes notes_;
};

std::string joined(const std::string &first, const std::string &second) {
  return first.empty() || second.empty() ? first + second : first + "; " + second;
}

/// As in the heads of the comparison's columns, so that an entry fits a line of the terminal.
std::string short_name(std::string name) {
  constexpr std::array<std::pair<const char *, const char *>, 4> short_names{{{"displacement_l2_relative", "u L2"},
                                                                              {"displacement_log10_E", "log10 E"},
                                                                              {"u2_max_relative", "u2 max"},
                                                                              {"stress_l2_relative", "stress L2"}}};
  for (const auto &[full, brief] : short_names)
    if (name == full)
      return brief;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string difference(const Published &entry) {
  if (!entry.published || !entry.computed)
    return no_number;
  return fmt::format("{:+.1e}", *entry.computed - *entry.published);
}

std::string place(const Published &entry) {
  std::string text = entry.method;
  if (!entry.level.empty())
    text += ", " + entry.level;
  return entry.variant.empty() ? text : text + ", " + entry.variant;
}

/// Rounded as papers print: logarithms with four decimals, all else with four digits.
std::string computed_text(const Published &entry) {
  const bool is_logarithm = entry.quantity.find("log10") != std::string::npos;
  return is_logarithm ? logarithm(entry.computed) : significant(entry.computed);
}

Table value_table(const std::vector<const Published *> &entries, Remarks &remarks) {
  Table table({{"entry", Align::left, true},
               {"method, level", Align::left, true},
               {"quantity", Align::left, true},
               {"published"},
               {"computed"},
               {"difference"},
               {"tolerance"},
               {"verdict", Align::left, true},
               {"remark", Align::left}});
  for (const Published *entry : entries)
    table.add_row({entry->entry, place(*entry), short_name(entry->quantity), exact(entry->published),
                   computed_text(*entry), difference(*entry), significant(entry->tolerance), verdict_text(*entry),
                   remarks.mark(joined(entry->finding, entry->remark))});
  table.drop_columns_without("");
  return table;
}

Table claim_table(const std::vector<const Published *> &entries, Remarks &remarks) {
  Table table({{"entry", Align::left, true},
               {"claim", Align::left, true},
               {"measured", Align::left, true},
               {"verdict", Align::left, true},
               {"remark", Align::left}});
  for (const Published *entry : entries)
    table.add_row({entry->entry, entry->statement, entry->finding, verdict_text(*entry), remarks.mark(entry->remark)});
  table.drop_columns_without("");
  return table;
}

std::vector<const Published *> select(const Results &results, const std::string &source, Kind kind) {
  std::vector<const Published *> selected;
  for (const Published &entry : results.published)
    if (entry.source == source && entry.kind == kind)
      selected.push_back(&entry);
  return selected;
}

long count(const Results &results, Kind kind, Verdict verdict, std::optional<bool> expected = std::nullopt) {
  return std::count_if(results.published.begin(), results.published.end(), [&](const Published &entry) {
    return entry.kind == kind && entry.verdict == verdict && (!expected || entry.expected == *expected);
  });
}

} // namespace

std::string verdict_text(const Published &entry) {
  const std::string verdict = to_text(entry.verdict);
  if (!entry.expected)
    return verdict + " (UNEXPECTED)";
  const bool good = entry.verdict == Verdict::reproduced || entry.verdict == Verdict::holds;
  return good ? verdict : verdict + " (expected)";
}

std::string ledger_summary(const Results &results) {
  const auto values = std::count_if(results.published.begin(), results.published.end(),
                                    [](const Published &entry) { return entry.kind == Kind::value; });
  std::string text =
      fmt::format("{} of {} published numbers reproduced; {} claims hold, {} do not (expected)",
                  count(results, Kind::value, Verdict::reproduced), values, count(results, Kind::claim, Verdict::holds),
                  count(results, Kind::claim, Verdict::does_not_hold, true));
  const auto missed = count(results, Kind::claim, Verdict::does_not_hold, false);
  if (missed > 0)
    text += fmt::format(", {} do not (UNEXPECTED)", missed);
  const auto unexpected = std::count_if(results.published.begin(), results.published.end(),
                                        [](const Published &entry) { return !entry.expected; });
  return text + (unexpected > 0 ? fmt::format("; {} outcomes UNEXPECTED.", unexpected) : ".");
}

void append_ledger(Document &document, const Results &results) {
  if (results.published.empty())
    return;
  std::vector<std::string> sources;
  for (const Published &entry : results.published)
    if (std::find(sources.begin(), sources.end(), entry.source) == sources.end())
      sources.push_back(entry.source);
  document.push_back(Heading{2, "Published numbers and claims"});
  Remarks remarks;
  for (const std::string &source : sources) {
    document.push_back(Heading{3, source});
    if (const auto values = select(results, source, Kind::value); !values.empty())
      document.push_back(value_table(values, remarks));
    if (const auto claims = select(results, source, Kind::claim); !claims.empty())
      document.push_back(claim_table(claims, remarks));
  }
  if (!remarks.notes().items.empty())
    document.push_back(remarks.notes());
  document.push_back(Paragraph{ledger_summary(results)});
}

} // namespace comparisons::reports
