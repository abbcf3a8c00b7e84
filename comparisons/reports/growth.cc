#include "comparisons/reports/growth.h"

#include "comparisons/metrics/slopes.h"
#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace comparisons::reports {

namespace {

constexpr double least_growth = 10;
constexpr double least_seconds = 1e-3;
constexpr std::array<const char *, 7> costs{"neighbours", "basis", "assembly", "solve",
                                            "evaluation", "total", "memory"};

std::optional<double> cost_of(const Cell &cell, std::string_view cost) {
  if (cost == "memory")
    return cell.memory_bytes > 0 ? std::optional(static_cast<double>(cell.memory_bytes)) : std::nullopt;
  return median_seconds(cell, cost);
}

} // namespace

std::optional<double> growth_exponent(const MethodSeries &series, std::string_view cost) {
  std::vector<double> counts;
  std::vector<double> values;
  for (const Cell *cell : series.cells) {
    const auto value = cost_of(*cell, cost);
    if (cell->status != Status::ok || cell->n_dofs <= 0 || !value || !(*value > 0))
      continue;
    counts.push_back(static_cast<double>(cell->n_dofs));
    values.push_back(*value);
  }
  if (counts.size() < 3 || (cost != "memory" && std::ranges::max(values) < least_seconds))
    return {};
  const auto [least, most] = std::ranges::minmax(counts);
  if (most < least_growth * least)
    return {};
  return -metrics::least_squares_slope(counts, values); // the slope is against 1 / N
}

void append_growth(Document &document, const std::vector<Group> &groups) {
  bool has_heading = false;
  for (const Group &group : groups) {
    std::vector<Column> columns{{"method", Align::left, true}};
    for (const char *cost : costs)
      columns.push_back({std::string_view(cost) == "neighbours" ? "neigh-\nbours" : cost});
    Table table(columns);
    for (const MethodSeries &series : series_of(group)) {
      std::vector<std::string> row{series.label};
      bool any = false;
      for (const char *cost : costs) {
        const auto exponent = growth_exponent(series, cost);
        any = any || exponent;
        row.push_back(exponent ? fmt::format("{:.2f}", *exponent) : no_number);
      }
      if (any)
        table.add_row(std::move(row));
    }
    if (table.rows().empty())
      continue;
    table.drop_columns_without(no_number);
    if (!has_heading) {
      document.push_back(Heading{2, "Growth of cost"});
      document.push_back(Paragraph{
          "Exponents p of seconds and of the peak memory as N^p, N the number of unknowns, by least squares over "
          "all levels of a method: 1 is proportional to the work. Phases below a millisecond are left out."});
    }
    has_heading = true;
    document.push_back(Heading{3, group.title()});
    document.push_back(std::move(table));
  }
}

} // namespace comparisons::reports
