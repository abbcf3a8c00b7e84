#include "comparisons/benchmarks/rod/measurement.h"

#include "comparisons/metrics/slopes.h"
#include "comparisons/reports/files.h"
#include "comparisons/study/experiment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace comparisons::benchmarks::rod {

namespace {

/// Errors of this size are made of rounding; their order means nothing.
constexpr double rounding_level = 1e-11;

const std::string seed_mark = "_seed_";

/// One error over the levels of a series, from coarse to fine; empty if there are no slopes.
std::vector<double> error_over_levels(const std::vector<reports::Cell *> &series, const std::string &name) {
  std::vector<double> errors;
  for (const reports::Cell *cell : series) {
    const auto value = reports::reportable(*cell, name);
    if (!value || !(*value > rounding_level))
      return {};
    errors.push_back(*value);
  }
  return errors;
}

/// Numbers of intervals: what a spacing is inverse to.
std::vector<double> intervals(const std::vector<reports::Cell *> &series) {
  std::vector<double> counts;
  for (const reports::Cell *cell : series)
    counts.push_back(static_cast<double>(cell->n_points - 1));
  return counts;
}

void add_slopes(const std::vector<reports::Cell *> &series, const std::string &name) {
  const std::vector<double> counts = intervals(series);
  const std::size_t n = series.size();
  auto &quantities = series.back()->quantities;
  const std::vector<double> errors = error_over_levels(series, name);
  if (errors.empty())
    return;
  const auto between = [&](std::size_t i) {
    return std::log(errors[i] / errors[i + 1]) / std::log(counts[i + 1] / counts[i]);
  };
  quantities[name + "_slope"] = metrics::least_squares_slope(counts, errors);
  if (!name.ends_with("_inside"))
    quantities[name + "_slope_first"] = between(0);
  quantities[name + "_slope_last"] = between(n - 2);
  std::vector<double> single;
  for (int k = 1;; ++k) {
    const std::vector<double> own = error_over_levels(series, fmt::format("{}{}{}", name, seed_mark, k));
    if (own.empty())
      break;
    single.push_back(metrics::least_squares_slope(counts, own));
  }
  if (single.size() > 1) {
    quantities[name + "_slope_least"] = *std::min_element(single.begin(), single.end());
    quantities[name + "_slope_largest"] = *std::max_element(single.begin(), single.end());
  }
}

} // namespace

void Measurement::add(const std::map<std::string, double> &errors) {
  for (const auto &[name, value] : errors)
    errors_[name].push_back(value);
}

void Measurement::write(reports::Cell &cell) const {
  cell.dimension = 1;
  cell.memory_bytes = memory_.bytes();
  double total = 0;
  for (const auto &[phase, value] : seconds) {
    cell.seconds[phase] = {value, value, value};
    total += phase == "evaluation" ? 0 : value;
  }
  cell.seconds["total"] = {total, total, total};
  if (n_pivoted > 0)
    cell.quantities["n_pivoted"] = static_cast<double>(n_pivoted);
  for (const auto &[name, values] : errors_) {
    if (values.size() == 1) {
      cell.errors[name] = values.front();
      continue;
    }
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      sum += std::log(values[k]);
      cell.quantities[fmt::format("{}{}{}", name, seed_mark, k + 1)] = values[k];
    }
    cell.errors[name] = std::exp(sum / static_cast<double>(values.size()));
  }
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    if (!(difference <= largest)) // keeps what is not a number
      largest = difference;
  }
  return largest;
}

void add_slopes(std::vector<reports::Cell> &cells) {
  std::map<std::string, std::vector<reports::Cell *>> all_series;
  for (auto &cell : cells)
    all_series[cell.variant + "|" + cell.label].push_back(&cell);
  for (auto &[key, series] : all_series) {
    std::stable_sort(series.begin(), series.end(),
                     [](const reports::Cell *a, const reports::Cell *b) { return a->n_points < b->n_points; });
    const bool complete = std::all_of(series.begin(), series.end(), [](const reports::Cell *cell) {
      return cell->status == reports::Status::ok && cell->n_points > 1;
    });
    if (!complete || series.size() < 2 || series.front()->n_points == series.back()->n_points)
      continue;
    for (const auto &[name, value] : std::map(series.back()->errors))
      add_slopes(series, name);
  }
  for (auto &cell : cells)
    std::erase_if(cell.quantities, [](const auto &entry) { return entry.first.find(seed_mark) != std::string::npos; });
}

void write_series(const std::filesystem::path &directory, const std::string &name,
                  const std::vector<std::string> &headings, const std::vector<std::vector<double>> &columns,
                  reports::Cell &cell, std::optional<double> time) {
  std::string text = fmt::format("{}\n", fmt::join(headings, ","));
  for (std::size_t i = 0; i < columns.front().size(); ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += fmt::format("{}{}", columns[c][i], c + 1 < columns.size() ? "," : "\n");
  const std::string file = study::series_file(cell, name);
  reports::write_file_atomically(directory / file, text);
  cell.series.push_back({name, file, time});
}

} // namespace comparisons::benchmarks::rod
