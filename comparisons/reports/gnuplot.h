#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace comparisons::reports {

/// Text in single quotes for gnuplot.
std::string gnuplot_quoted(std::string_view text);

/// A script that draws twice, as SVG and as PDF; `body` has the settings and the plot. gnuplot's variable `prefix`, if
/// it is set (gnuplot -e), goes before the names of both files.
std::string gnuplot_script(const std::string &name, const std::string &title, const std::string &body);

/// A CSV file of numbers with a header.
struct NumberTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  /// Position of a column; names.size() if there is none.
  std::size_t find(std::string_view name) const;
  std::size_t n_rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// Empty if the text is no such table.
NumberTable parse_number_table(const std::string &text);

} // namespace comparisons::reports
