#include "comparisons/reports/side_by_side.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/answers_section.h"
#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::reports {

namespace {

bool same_cell(const Cell &a, const Cell &b) {
  return a.benchmark == b.benchmark && a.scene == b.scene && a.variant == b.variant && a.label == b.label &&
         a.level == b.level;
}

std::string full_name(const Cell &cell) {
  return fmt::format("{} / {}{}{}, {}", cell.benchmark, cell.scene, cell.variant.empty() ? "" : ", ", cell.variant,
                     cell_name(cell));
}

std::string hashes(const Results &results) {
  const auto scenes = results.scene.is_array() ? results.scene : nlohmann::ordered_json::array({results.scene});
  std::string text;
  for (const auto &scene : scenes)
    if (scene.is_object() && scene.contains("hash") && scene["hash"].is_string())
      text += (text.empty() ? "" : " ") + scene["hash"].get<std::string>();
  return text.empty() ? no_number : text;
}

Table circumstances(const NamedResults &first, const NamedResults &second) {
  Table table({{"", Align::left}, {"first", Align::left, true}, {"second", Align::left, true}, {"", Align::left}});
  const auto add = [&](const std::string &what, const std::string &a, const std::string &b) {
    table.add_row({what, a, b, a == b ? "" : "differs"});
  };
  const Results &a = first.results;
  const Results &b = second.results;
  add("file", first.name, second.name);
  add("version", a.program.version, b.program.version);
  add("commit", a.program.commit, b.program.commit);
  add("build", a.program.build_type + " " + a.program.flags, b.program.build_type + " " + b.program.flags);
  add("processor", a.machine.cpu, b.machine.cpu);
  add("cores", fmt::format("{}", a.machine.cores), fmt::format("{}", b.machine.cores));
  add("load", significant(a.machine.load), significant(b.machine.load));
  add("BLAS", a.machine.blas, b.machine.blas);
  add("threads", fmt::format("{}", a.machine.threads), fmt::format("{}", b.machine.threads));
  add("SIMD lanes", fmt::format("{}", a.machine.simd_lanes), fmt::format("{}", b.machine.simd_lanes));
  add("scenes", hashes(a), hashes(b));
  return table;
}

std::string judged(const TimeRatio &ratio) {
  return ratio.holds_one() ? "the same within the spread" : ratio.ratio > 1 ? "slower" : "faster";
}

/// Largest relative change of an error that both have.
std::string changed_error(const Cell &a, const Cell &b) {
  std::string worst = "none";
  double largest = 0;
  for (const auto &entry : a.errors) {
    const auto before = target_error(a, entry.first), after = target_error(b, entry.first);
    if (!before || !after || !is_error_target(entry.first))
      continue;
    const double change = std::abs(*after - *before) / *before;
    if (change > largest) {
      largest = change;
      worst = fmt::format("{}: {} to {}", words_of(entry.first), scientific(before), scientific(after));
    }
  }
  // Rounding may differ between machines and compilers.
  return largest > 1e-6 ? worst : "none";
}

void append_group(Document &document, const Group &group,
                  const std::vector<std::pair<const Cell *, const Cell *>> &pairs, std::vector<double> &logarithms) {
  Table table({{"method", Align::left, true},
               {"level", Align::left},
               {"first\ns"},
               {"second\ns"},
               {"ratio"},
               {"at\nleast"},
               {"at\nmost"},
               {"second is", Align::left, true},
               {"changed error", Align::left, true}});
  for (const Cell *cell : group.cells) {
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const auto &one) { return one.first == cell; });
    if (pair == pairs.end())
      continue;
    const Cell &other = *pair->second;
    if (const auto ratio = time_ratio(*cell, other)) {
      logarithms.push_back(std::log(ratio->ratio));
      table.add_row({cell->label, cell->level, seconds(median_seconds(*cell, "total")),
                     seconds(median_seconds(other, "total")), significant(ratio->ratio), significant(ratio->least),
                     significant(ratio->largest), judged(*ratio), changed_error(*cell, other)});
    } else
      table.add_row({cell->label, cell->level, no_number, no_number, no_number, no_number, no_number,
                     fmt::format("{} / {}", to_text(cell->status), to_text(other.status)), "none"});
  }
  if (table.rows().empty())
    return;
  document.push_back(Heading{3, group.title()});
  document.push_back(std::move(table));
}

std::vector<std::string> only_in(const Results &one, const Results &other) {
  std::vector<std::string> names;
  for (const Cell &cell : one.cells)
    if (std::none_of(other.cells.begin(), other.cells.end(), [&](const Cell &b) { return same_cell(cell, b); }))
      names.push_back(full_name(cell));
  return names;
}

} // namespace

std::optional<TimeRatio> time_ratio(const Cell &first, const Cell &second) {
  if (first.status != Status::ok || second.status != Status::ok)
    return std::nullopt;
  const auto a = first.seconds.find("total"), b = second.seconds.find("total");
  if (a == first.seconds.end() || b == second.seconds.end() || !(a->second.minimum > 0) || !(b->second.minimum > 0))
    return std::nullopt;
  return TimeRatio{b->second.median / a->second.median, b->second.minimum / a->second.maximum,
                   b->second.maximum / a->second.minimum};
}

std::vector<std::pair<const Cell *, const Cell *>> paired_cells(const Results &first, const Results &second) {
  std::vector<std::pair<const Cell *, const Cell *>> pairs;
  for (const Cell &cell : first.cells)
    for (const Cell &other : second.cells)
      if (same_cell(cell, other)) {
        pairs.emplace_back(&cell, &other);
        break;
      }
  return pairs;
}

Document side_by_side(const NamedResults &first, const NamedResults &second) {
  Document document;
  document.push_back(Heading{1, fmt::format("{} beside {}", second.name, first.name)});
  document.push_back(circumstances(first, second));
  for (const NamedResults *one : {&first, &second})
    for (const std::string &reason : one->results.not_comparable)
      document.push_back(Alarm{fmt::format("NOT COMPARABLE: {}: {}", one->name, reason)});
  document.push_back(Heading{2, "Seconds"});
  document.push_back(Paragraph{"Ratios are of the second run over the first: medians, and between the extremes of the "
                               "repeats. A range that holds 1 leaves open whether anything changed."});
  const auto pairs = paired_cells(first.results, second.results);
  std::vector<double> logarithms;
  for (const Group &group : group_cells(first.results))
    append_group(document, group, pairs, logarithms);
  for (const auto &[one, other, name] : {std::tuple(&first, &second, "first"), std::tuple(&second, &first, "second")})
    if (auto names = only_in(one->results, other->results); !names.empty()) {
      document.push_back(Heading{2, fmt::format("Only in the {}", name)});
      document.push_back(Bullets{std::move(names)});
    }
  std::size_t n_same = 0;
  for (const auto &[a, b] : pairs)
    if (const auto ratio = time_ratio(*a, *b); ratio && ratio->holds_one())
      ++n_same;
  double mean = 0;
  for (const double logarithm : logarithms)
    mean += logarithm / static_cast<double>(logarithms.size());
  document.push_back(Paragraph{
      logarithms.empty() ? "No cell was timed in both."
                         : fmt::format("{} of {} cells the same within the spread; geometric mean of the ratios {}.",
                                       n_same, logarithms.size(), significant(std::exp(mean)))});
  return document;
}

} // namespace comparisons::reports
