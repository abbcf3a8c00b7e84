#include "comparisons/reports/answers.h"

#include "comparisons/metrics/slopes.h"
#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace comparisons::reports {

namespace {

constexpr double rounding_level = 1e-10;
/// Targets from 10 % down to where double precision ends.
constexpr int most_digits = 12;

/// Exact decimal powers, so that a target reads 0.001 and not 0.0010000000000000002.
double power_of_ten(int exponent) { return std::strtod(fmt::format("1e{}", exponent).c_str(), nullptr); }

int rank_of(const std::string &name) {
  if (name == "displacement_l2_relative")
    return 0;
  if (name == "stress_l2_relative")
    return 1;
  if (name.find("stress_concentration") != std::string::npos)
    return 2;
  if (name.starts_with("displacement") || name == "l2")
    return 3;
  return name.starts_with("stress") || name == "h1" ? 4 : name == "h2" ? 5 : 6;
}

/// Position of the cell whose level and the next have `target` between their errors; cells.size() if none.
std::size_t bracket(const std::vector<double> &errors, double target) {
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    if (errors[i] >= target && target >= errors[i + 1])
      return i;
  return errors.size();
}

bool falls(const std::vector<double> &errors) { return std::is_sorted(errors.rbegin(), errors.rend(), std::less<>()); }

double interpolate(const std::array<double, 2> &errors, const std::array<double, 2> &seconds, double target) {
  if (errors[0] == errors[1])
    return std::min(seconds[0], seconds[1]);
  const double weight = std::log(errors[0] / target) / std::log(errors[0] / errors[1]);
  return seconds[0] * std::pow(seconds[1] / seconds[0], weight);
}

/// The ok cells of a series with their errors and seconds; says which level broke the chain.
struct Measured {
  std::vector<double> errors;
  std::vector<double> seconds;
  std::vector<const Cell *> cells;
};

Measured measured(const MethodSeries &series, std::string_view error) {
  Measured all;
  for (const Cell *cell : series.cells) {
    const auto value = target_error(*cell, error);
    const auto seconds = median_seconds(*cell, "total");
    if (!value || !seconds || !(*seconds > 0))
      continue;
    all.errors.push_back(*value);
    all.seconds.push_back(*seconds);
    all.cells.push_back(cell);
  }
  return all;
}

/// A level between two measured ones that is not ok.
const Cell *failed_between(const MethodSeries &series, const Cell *a, const Cell *b) {
  bool inside = false;
  for (const Cell *cell : series.cells) {
    if (cell == b)
      return nullptr;
    if (inside && cell->status != Status::ok)
      return cell;
    inside = inside || cell == a;
  }
  return nullptr;
}

std::string at(double error, const Cell &cell) { return fmt::format("{} at {}", scientific(error), cell.level); }

} // namespace

std::vector<MethodSeries> series_of(const Group &group) {
  std::vector<MethodSeries> all;
  for (const Cell *cell : group.cells) {
    auto found = std::find_if(all.begin(), all.end(), [&](const auto &series) { return series.label == cell->label; });
    if (found == all.end())
      found = all.insert(all.end(), {cell->label, cell->method, {}});
    found->cells.push_back(cell);
  }
  // A cell that failed before it had points keeps its place among the levels.
  for (auto &series : all)
    if (std::all_of(series.cells.begin(), series.cells.end(),
                    [](const Cell *cell) { return relative_spacing(*cell).has_value(); }))
      std::stable_sort(series.cells.begin(), series.cells.end(), [](const Cell *a, const Cell *b) {
        return relative_spacing(*a).value() > relative_spacing(*b).value();
      });
  return all;
}

bool is_error_target(std::string_view name) {
  for (const char *other : {"log10", "slope", "_seed_", "backward_error", "iterations"})
    if (name.find(other) != std::string_view::npos)
      return false;
  return true;
}

std::optional<double> target_error(const Cell &cell, std::string_view name) {
  const auto value = reportable(cell, name);
  return value && *value != 0 ? std::optional(std::abs(*value)) : std::nullopt;
}

std::vector<std::string> error_targets(const Group &group) {
  std::set<std::string> names;
  for (const Cell *cell : group.cells) {
    for (const auto &entry : cell->errors)
      if (is_error_target(entry.first) && target_error(*cell, entry.first))
        names.insert(entry.first);
    for (const auto &entry : cell->quantities)
      if (is_error_target(entry.first) && entry.first.find("error") != std::string::npos &&
          target_error(*cell, entry.first))
        names.insert(entry.first);
  }
  std::vector<std::string> sorted(names.begin(), names.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto &a, const auto &b) { return rank_of(a) < rank_of(b); });
  return sorted;
}

std::vector<std::string> headline_errors(const Group &group) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names = error_targets(group);
  if (!names.empty() && rank_of(names.front()) == 0)
    std::erase_if(names, [](const auto &name) { return rank_of(name) > 2; });
  names.resize(std::min(names.size(), most));
  return names;
}

Cost seconds_for_error(const MethodSeries &series, std::string_view error, double target) {
  const Measured all = measured(series, error);
  if (all.errors.empty()) {
    const Cell *first = series.cells.empty() ? nullptr : series.cells.front();
    return {{}, first != nullptr && first->status != Status::ok ? to_text(first->status) : "no such error"};
  }
  const auto [least, largest] = std::minmax_element(all.errors.begin(), all.errors.end());
  if (*largest < target)
    return {{},
            fmt::format("smaller already: {} in {} s", at(all.errors.front(), *all.cells.front()),
                        seconds(all.seconds.front()))};
  if (*least > target)
    return {
        {},
        fmt::format("not reached: {}", at(*least, *all.cells[static_cast<std::size_t>(least - all.errors.begin())]))};
  if (all.errors.size() == 1)
    return {{}, "one level only"};
  if (!falls(all.errors))
    return {{}, "the error does not fall from level to level"};
  const std::size_t i = bracket(all.errors, target);
  if (const Cell *failed = failed_between(series, all.cells[i], all.cells[i + 1]))
    return {{}, fmt::format("{} at {} in between", to_text(failed->status), failed->level)};
  return {interpolate({all.errors[i], all.errors[i + 1]}, {all.seconds[i], all.seconds[i + 1]}, target), {}};
}

std::vector<double> equal_error_targets(const Group &group, std::string_view error) {
  std::vector<double> targets;
  for (int digits = 1; digits <= most_digits; ++digits) {
    const double target = power_of_ten(-digits);
    for (const auto &series : series_of(group))
      if (seconds_for_error(series, error, target).seconds) {
        targets.push_back(target);
        break;
      }
  }
  return targets;
}

std::vector<EqualError> equal_errors(const Results &results) {
  std::vector<EqualError> entries;
  for (const Group &group : group_cells(results))
    for (const std::string &error : headline_errors(group))
      for (const double target : equal_error_targets(group, error))
        for (const MethodSeries &series : series_of(group)) {
          Cost cost = seconds_for_error(series, error, target);
          entries.push_back({group.benchmark, group.scene, group.variant, error, target, series.label, cost.seconds,
                             std::move(cost.reason)});
        }
  return entries;
}

std::vector<const Cell *> pareto_front(const Group &group, std::string_view error) {
  std::vector<const Cell *> cells;
  for (const Cell *cell : group.cells)
    if (target_error(*cell, error) && median_seconds(*cell, "total").value_or(0) > 0)
      cells.push_back(cell);
  std::stable_sort(cells.begin(), cells.end(), [&](const Cell *a, const Cell *b) {
    return std::pair(*median_seconds(*a, "total"), *target_error(*a, error)) <
           std::pair(*median_seconds(*b, "total"), *target_error(*b, error));
  });
  std::vector<const Cell *> front;
  for (const Cell *cell : cells)
    if (front.empty() || *target_error(*cell, error) < *target_error(*front.back(), error))
      front.push_back(cell);
  return front;
}

bool has_several_levels(const Group &group) {
  for (const MethodSeries &series : series_of(group))
    for (const Cell *cell : series.cells)
      if (cell->level != series.cells.front()->level)
        return true;
  return false;
}

std::optional<double> efficiency(const Cell &cell, std::string_view error) {
  const auto value = target_error(cell, error);
  const auto seconds = median_seconds(cell, "total");
  return value && seconds && *seconds > 0 ? std::optional(1 / (*value * *seconds)) : std::nullopt;
}

std::optional<double> accuracy_per_megabyte(const Cell &cell, std::string_view error) {
  const auto value = target_error(cell, error);
  return value && cell.memory_bytes > 0 ? std::optional(1 / (*value * 1e-6 * static_cast<double>(cell.memory_bytes)))
                                        : std::nullopt;
}

std::optional<double> least_squares_rate(const MethodSeries &series, std::string_view error) {
  std::vector<double> counts;
  std::vector<double> errors;
  for (const Cell *cell : series.cells) {
    const auto value = target_error(*cell, error);
    const auto spacing = relative_spacing(*cell);
    if (!value || !spacing)
      return std::nullopt;
    if (*value <= rounding_level)
      continue;
    counts.push_back(1 / *spacing);
    errors.push_back(*value);
  }
  const std::set<double> different(counts.begin(), counts.end());
  return different.size() >= 3 ? std::optional(metrics::least_squares_slope(counts, errors)) : std::nullopt;
}

bool is_finite_element(const Cell &cell) { return cell.method.starts_with("fem"); }

bool is_finite_element(const MethodSeries &series) { return series.method.starts_with("fem"); }

} // namespace comparisons::reports
