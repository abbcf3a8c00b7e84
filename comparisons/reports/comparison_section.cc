#include "comparisons/reports/comparison_section.h"

#include "comparisons/reports/facts_section.h"
#include "comparisons/reports/numbers.h"
#include "comparisons/reports/recoveries_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace comparisons::reports {

namespace {

constexpr const char *main_error = "displacement_l2_relative";
constexpr std::array<const char *, 4> compared{main_error, "displacement_log10_E", "u2_max_relative",
                                               "stress_l2_relative"};

std::string count(const Cell &cell, std::int64_t number) {
  return number > 0 || cell.status == Status::ok ? fmt::format("{}", number) : no_number;
}

/// Errors of a benchmark that has no displacement: its own, in the order of their names, as many as fit.
std::vector<std::string> own_errors(const Group &group) {
  constexpr std::size_t most = 6;
  std::set<std::string> names;
  for (const Cell *cell : group.cells) {
    if (cell->errors.contains(main_error))
      return {};
    for (const auto &entry : cell->errors)
      if (reportable(*cell, entry.first))
        names.insert(entry.first);
  }
  std::vector<std::string> result(names.begin(), names.end());
  result.resize(std::min(result.size(), most));
  return result;
}

/// Long names are broken so that several columns fit.
std::string header_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', '\n');
  return name;
}

Table own_error_table(const Group &group, const std::vector<std::string> &names) {
  std::vector<Column> columns{{"method", Align::left, true}, {"level", Align::left}, {"points"}, {"dofs"}};
  for (const std::string &name : names)
    columns.push_back({header_of(name)});
  columns.insert(columns.end(), {{"total\ns"}, {"memory\nMB"}, {"status", Align::left, true}});
  Table table(columns);
  const bool all_ok =
      std::all_of(group.cells.begin(), group.cells.end(), [](const Cell *cell) { return status_text(*cell) == "ok"; });
  for (const Cell *cell : group.cells) {
    const bool ok = cell->status == Status::ok;
    std::vector<std::string> row{cell->label, group.common_level().empty() ? cell->level : no_number,
                                 count(*cell, cell->n_points), count(*cell, cell->n_dofs)};
    for (const std::string &name : names)
      row.push_back(scientific(reportable(*cell, name)));
    row.push_back(ok ? seconds(median_seconds(*cell, "total")) : no_number);
    row.push_back(ok ? megabytes(cell->memory_bytes) : no_number);
    row.push_back(all_ok ? no_number : status_text(*cell));
    table.add_row(std::move(row));
  }
  table.drop_columns_without(no_number);
  return table;
}

Table comparison_table(const Group &group) {
  if (const auto names = own_errors(group); !names.empty())
    return own_error_table(group, names);
  Table table({{"method", Align::left, true},
               {"level", Align::left},
               {"points"},
               {"dofs"},
               {"u L2\nrelative"},
               {"rate"},
               {"log10 E"},
               {"u2 max\nrelative"},
               {"stress L2\nrelative"},
               {"total\ns"},
               {"memory\nMB"},
               {"status", Align::left, true}});
  const bool one_level = !group.common_level().empty();
  const bool all_ok =
      std::all_of(group.cells.begin(), group.cells.end(), [](const Cell *cell) { return status_text(*cell) == "ok"; });
  for (const Cell *cell : group.cells) {
    const bool ok = cell->status == Status::ok;
    table.add_row({cell->label, one_level ? no_number : cell->level, count(*cell, cell->n_points),
                   count(*cell, cell->n_dofs), scientific(reportable(*cell, compared[0])),
                   rate(observed_rate(group, *cell, main_error)), logarithm(reportable(*cell, compared[1])),
                   scientific(reportable(*cell, compared[2])), scientific(reportable(*cell, compared[3])),
                   ok ? seconds(median_seconds(*cell, "total")) : no_number,
                   ok ? megabytes(cell->memory_bytes) : no_number, all_ok ? no_number : status_text(*cell)});
  }
  table.drop_columns_without(no_number);
  return table;
}

/// Warnings that all cells with a result have, if there are several: about the problem rather than a method.
std::vector<std::string> common_warnings(const Group &group) {
  std::vector<std::string> common;
  std::size_t n_ok = 0;
  for (const Cell *cell : group.cells) {
    if (cell->status != Status::ok)
      continue;
    if (++n_ok == 1)
      common = cell->warnings;
    std::erase_if(common, [&](const std::string &warning) {
      return std::find(cell->warnings.begin(), cell->warnings.end(), warning) == cell->warnings.end();
    });
  }
  return n_ok > 1 ? common : std::vector<std::string>{};
}

std::vector<std::string> reasons(const Group &group) {
  const auto common = common_warnings(group);
  std::vector<std::string> items;
  for (const std::string &warning : common)
    items.push_back("all: " + warning);
  for (const Cell *cell : group.cells) {
    if (cell->status != Status::ok || !cell->expected)
      items.push_back(fmt::format("{}: {}{}", cell_name(*cell), status_text(*cell),
                                  cell->reason.empty() ? std::string() : ": " + cell->reason));
    for (const std::string &warning : cell->warnings)
      if (cell->status != Status::ok || std::find(common.begin(), common.end(), warning) == common.end())
        items.push_back(fmt::format("{}: {}", cell_name(*cell), warning));
  }
  return items;
}

bool is_compared(const Group &group, const std::string &name) {
  const auto own = own_errors(group);
  return std::find(compared.begin(), compared.end(), name) != compared.end() ||
         std::find(own.begin(), own.end(), name) != own.end();
}

std::vector<std::string> further_names(const Group &group) {
  std::set<std::string> names;
  for (const Cell *cell : group.cells)
    for (const auto *map : {&cell->errors, &cell->quantities})
      for (const auto &entry : *map)
        if (!is_compared(group, entry.first) && !entry.first.starts_with("cloud_") && !is_fact(entry.first) &&
            !is_recovery(entry.first) && reportable(*cell, entry.first))
          names.insert(entry.first);
  return {names.begin(), names.end()};
}

Table further_table(const Group &group, const std::vector<std::string> &names) {
  std::vector<Column> columns{{"method", Align::left, true}, {"level", Align::left}};
  for (const std::string &name : names)
    columns.push_back({header_of(name)});
  Table table(columns);
  for (const Cell *cell : group.cells) {
    if (cell->status != Status::ok)
      continue;
    std::vector<std::string> row{cell->label, group.common_level().empty() ? cell->level : no_number};
    for (const std::string &name : names)
      row.push_back(by_name(name, reportable(*cell, name)));
    table.add_row(std::move(row));
  }
  table.drop_columns_without(no_number);
  return table;
}

/// Which timings are to be taken with caution; the first few by name.
std::string wide_spreads(const Group &group) {
  constexpr std::size_t most_names = 4;
  std::vector<std::string> names;
  std::size_t n_timed = 0;
  for (const Cell *cell : group.cells)
    if (const auto spread = relative_spread(*cell); spread && cell->status == Status::ok) {
      ++n_timed;
      if (*spread > wide_spread)
        names.push_back(cell_name(*cell));
    }
  if (names.empty())
    return {};
  const std::size_t n_wide = names.size();
  names.resize(std::min(n_wide, most_names));
  return fmt::format("Spread above {:.0f} %: {} of {} cells ({}{}); their medians are uncertain by as much.",
                     100 * wide_spread, n_wide, n_timed, fmt::join(names, "; "), n_wide > most_names ? "; ..." : "");
}

} // namespace

std::string status_text(const Cell &cell) {
  const std::string status = to_text(cell.status);
  if (cell.expected)
    return cell.status == Status::ok ? status : status + " (expected)";
  return status + " (UNEXPECTED)";
}

void append_comparison(Document &document, const std::vector<Group> &groups) {
  document.push_back(Heading{2, "Comparison"});
  if (groups.empty())
    document.push_back(Paragraph{"No cells were computed."});
  for (const Group &group : groups) {
    document.push_back(Heading{3, group.title()});
    document.push_back(comparison_table(group));
    if (std::vector<std::string> items = reasons(group); !items.empty())
      document.push_back(Bullets{std::move(items)});
  }
}

void append_phases(Document &document, const std::vector<Group> &groups) {
  bool has_heading = false;
  std::vector<const char *> shown(phases.begin(), phases.end());
  std::erase_if(shown, [](std::string_view phase) { return phase == "setup"; }); // in the linear solvers' own tables
  for (const Group &group : groups) {
    std::vector<Column> columns{{"method", Align::left, true}, {"level", Align::left}};
    for (const char *phase : shown)
      columns.push_back({std::string_view(phase) == "neighbours" ? "neigh-\nbours" : phase});
    columns.insert(columns.end(),
                   {{"total\nminimum"}, {"total\nmaximum"}, {"spread\n%"}, {"runs"}, {"rows\ncopied %"}});
    Table table(columns);
    for (const Cell *cell : group.cells) {
      if (cell->status != Status::ok || cell->seconds.empty())
        continue;
      std::vector<std::string> row{cell->label, group.common_level().empty() ? cell->level : no_number};
      for (const char *phase : shown)
        row.push_back(seconds(median_seconds(*cell, phase)));
      const auto total = cell->seconds.find("total");
      const bool timed = total != cell->seconds.end();
      row.push_back(timed ? seconds(total->second.minimum) : no_number);
      row.push_back(timed ? seconds(total->second.maximum) : no_number);
      row.push_back(percent(relative_spread(*cell)));
      row.push_back(fmt::format("{}", cell->repeats));
      const auto copied = cell->quantities.find("repeated_rows"); // of a grid: less work than other particles take
      row.push_back(copied != cell->quantities.end() && cell->n_points > 0
                        ? percent(copied->second / static_cast<double>(cell->n_points))
                        : no_number);
      table.add_row(std::move(row));
    }
    if (table.rows().empty())
      continue;
    table.drop_columns_without(no_number);
    if (!has_heading)
      document.push_back(Heading{2, "Seconds by phase"});
    has_heading = true;
    document.push_back(Heading{3, group.title()});
    document.push_back(std::move(table));
    if (const std::string wide = wide_spreads(group); !wide.empty())
      document.push_back(Paragraph{wide});
  }
}

void append_clouds(Document &document, const std::vector<Group> &groups) {
  bool has_heading = false;
  for (const Group &group : groups) {
    Table table({{"method", Align::left, true},
                 {"level", Align::left},
                 {"neighbours\nfewest"},
                 {"median"},
                 {"most"},
                 {"least\ndistance / h"},
                 {"least\npivot ratio"},
                 {"at x\nm"},
                 {"at y\nm"},
                 {"particles\nenlarged"}});
    for (const Cell *cell : group.cells) {
      if (cell->status != Status::ok || !cell->quantities.contains("cloud_pivot_ratio"))
        continue;
      std::vector<std::string> row{cell->label, group.common_level().empty() ? cell->level : no_number};
      for (const char *name :
           {"cloud_fewest_neighbours", "cloud_median_neighbours", "cloud_most_neighbours", "cloud_smallest_distance",
            "cloud_pivot_ratio", "cloud_worst_x", "cloud_worst_y", "n_enlarged"})
        row.push_back(significant(reportable(*cell, name)));
      table.add_row(std::move(row));
    }
    if (table.rows().empty())
      continue;
    table.drop_columns_without(no_number);
    if (!has_heading) {
      document.push_back(Heading{2, "Particles and bases"});
      document.push_back(Paragraph{
          "Neighbours are the particles in whose support a particle lies; the least distance is that of two particles "
          "over the smoothing length; the least pivot of a moment matrix over its diagonal entry (1 at best, near 0 "
          "where the basis hardly exists) is looked for at the particles and around them in their subdomains."});
    }
    has_heading = true;
    document.push_back(Heading{3, group.title()});
    document.push_back(std::move(table));
  }
}

void append_further_quantities(Document &document, const std::vector<Group> &groups) {
  constexpr std::size_t names_per_table = 6;
  bool has_heading = false;
  for (const Group &group : groups) {
    const std::vector<std::string> names = further_names(group);
    for (std::size_t begin = 0; begin < names.size(); begin += names_per_table) {
      if (!has_heading)
        document.push_back(Heading{2, "Further errors and quantities"});
      has_heading = true;
      if (begin == 0)
        document.push_back(Heading{3, group.title()});
      const std::size_t end = std::min(names.size(), begin + names_per_table);
      document.push_back(further_table(group, {names.begin() + static_cast<std::ptrdiff_t>(begin),
                                               names.begin() + static_cast<std::ptrdiff_t>(end)}));
    }
  }
}

} // namespace comparisons::reports
