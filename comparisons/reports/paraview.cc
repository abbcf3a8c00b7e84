#include "comparisons/reports/paraview.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/files.h"
#include "comparisons/reports/gnuplot.h"
#include "comparisons/reports/plot.h"
#include "comparisons/reports/vtu.h"

#include <algorithm>
#include <cmath>

namespace comparisons::reports {

namespace fs = std::filesystem;

namespace {

/// A table whose first column is x; empty if it is none, or holds what is no number to VTK.
std::string state_text(const NumberTable &table) {
  if (table.n_rows() == 0 || table.names.front() != "x")
    return {};
  FieldGrid grid;
  for (const double x : table.columns.front()) {
    grid.cells.push_back({grid.points.size()});
    grid.points.push_back({x, 0});
  }
  std::vector<PointField> fields;
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    const auto &column = table.columns[j];
    if (!std::all_of(column.begin(), column.end(), [](double value) { return std::isfinite(value); }))
      return {};
    if (j > 0)
      fields.push_back({table.names[j], {}, column});
  }
  return vtu_text(grid, fields);
}

} // namespace

std::vector<TextFile> paraview_files(const Group &group, const fs::path &series, const fs::path &directory) {
  std::vector<TextFile> files;
  std::vector<CollectionEntry> levels, times;
  std::size_t n_labels = 0, n_cells = 0;
  for (const MethodSeries &one : series_of(group)) {
    for (std::size_t level = 0; level < one.cells.size(); ++level) {
      const std::string name = one.label + ", " + one.cells[level]->level;
      for (const Series &entry : one.cells[level]->series) {
        if (entry.file.ends_with(".vtu"))
          levels.push_back(
              {static_cast<double>(level), n_labels, name, fs::proximate(series / entry.file, directory).string()});
        if (!entry.time || !entry.file.ends_with(".csv"))
          continue;
        std::string text = state_text(parse_number_table(file_contents(series / entry.file)));
        if (text.empty())
          continue;
        files.push_back({fs::path(entry.file).replace_extension(".vtu").string(), std::move(text)});
        times.push_back({*entry.time, n_cells, name, files.back().name});
      }
      ++n_cells;
    }
    ++n_labels;
  }
  std::stable_sort(times.begin(), times.end(), [](const auto &a, const auto &b) { return a.time < b.time; });
  const auto &entries = times.empty() ? levels : times;
  if (!entries.empty())
    files.push_back({file_stem(group) + ".pvd", pvd_text(entries)});
  return files;
}

} // namespace comparisons::reports
