#include "comparisons/reports/groups.h"

#include "comparisons/reports/hard_cases_section.h"
#include "comparisons/reports/solvers_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace comparisons::reports {

namespace {

constexpr double rounding_level = 1e-10;

Group &group_of(std::vector<Group> &groups, const Cell &cell) {
  for (Group &group : groups)
    if (group.benchmark == cell.benchmark && group.scene == cell.scene && group.variant == cell.variant)
      return group;
  groups.push_back({cell.benchmark, cell.scene, cell.variant, {}});
  return groups.back();
}

void put_labels_together(Group &group) {
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < group.cells.size(); ++i)
    first.emplace(group.cells[i]->label, i);
  std::stable_sort(group.cells.begin(), group.cells.end(),
                   [&](const Cell *a, const Cell *b) { return first.at(a->label) < first.at(b->label); });
}

} // namespace

std::string Group::title() const {
  std::string text = benchmark;
  if (!scene.empty())
    text += " / " + scene;
  if (!variant.empty())
    text += ", " + variant;
  const std::string level = common_level();
  return level.empty() ? text : text + ", " + level;
}

std::string Group::common_level() const {
  for (const Cell *cell : cells)
    if (cell->level != cells.front()->level)
      return {};
  return cells.empty() ? std::string() : cells.front()->level;
}

std::vector<Group> group_cells(const Results &results) {
  std::vector<Group> groups;
  for (const Cell &cell : results.cells)
    if (!is_hard_case(cell) && !is_solver_case(cell))
      group_of(groups, cell).cells.push_back(&cell);
  std::vector<std::string> benchmarks;
  for (Group &group : groups) {
    put_labels_together(group);
    if (std::find(benchmarks.begin(), benchmarks.end(), group.benchmark) == benchmarks.end())
      benchmarks.push_back(group.benchmark);
  }
  const auto rank = [&](const Group &group) {
    const auto benchmark = std::find(benchmarks.begin(), benchmarks.end(), group.benchmark) - benchmarks.begin();
    return 2 * benchmark + (group.scene == "scene" ? 0 : 1);
  };
  std::stable_sort(groups.begin(), groups.end(), [&](const Group &a, const Group &b) { return rank(a) < rank(b); });
  return groups;
}

std::string cell_name(const Cell &cell) { return fmt::format("{}, {}", cell.label, cell.level); }

std::optional<double> observed_rate(const Group &group, const Cell &cell, std::string_view name) {
  const auto error = reportable(cell, name);
  const auto spacing = relative_spacing(cell);
  const Cell *previous = nullptr;
  for (const Cell *other : group.cells) {
    if (other == &cell)
      break;
    if (other->label == cell.label && other->level != cell.level)
      previous = other;
  }
  if (!previous || !error || !spacing)
    return std::nullopt;
  const auto previous_error = reportable(*previous, name);
  const auto previous_spacing = relative_spacing(*previous);
  if (!previous_error || !previous_spacing || *previous_spacing == *spacing)
    return std::nullopt;
  if (!(*error > rounding_level) || !(*previous_error > rounding_level))
    return std::nullopt;
  return std::log(*previous_error / *error) / std::log(*previous_spacing / *spacing);
}

} // namespace comparisons::reports
