#include "comparisons/reports/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace comparisons::reports {

std::string gnuplot_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'')
      quoted += '\'';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + "'";
}

std::string gnuplot_script(const std::string &name, const std::string &title, const std::string &body) {
  // Okabe and Ito's colours, as on the page; markers and dashes tell the curves apart without them.
  return fmt::format(
      "# gnuplot {0}.gp makes {0}.svg and {0}.pdf.\nreset\nset encoding utf8\n"
      "set linetype 1 lc rgb '#0072b2' pt 7 dt 1 lw 1.5\nset linetype 2 lc rgb '#d55e00' pt 5 dt 2 lw 1.5\n"
      "set linetype 3 lc rgb '#009e73' pt 9 dt 3 lw 1.5\nset linetype 4 lc rgb '#cc79a7' pt 13 dt 4 lw 1.5\n"
      "set linetype 5 lc rgb '#e69f00' pt 11 dt 5 lw 1.5\nset linetype 6 lc rgb '#222222' pt 6 dt 1 lw 1.5\n"
      "set linetype 7 lc rgb '#56b4e9' pt 4 dt 2 lw 1.5\nset linetype 8 lc rgb '#8a1c1c' pt 8 dt 3 lw 1.5\n"
      "set linetype cycle 8\nset key noenhanced outside right top\nset title {1} noenhanced\nset grid\n"
      "do for [ending in 'svg pdf'] {{\n"
      "if (ending eq 'svg') {{ set terminal svg size 900,560 background 'white' }} else "
      "{{ set terminal pdfcairo size 9,5.6 }}\nset output (exists('prefix') ? prefix : '').'{0}.'.ending\n{2}unset "
      "output\n}}\n",
      name, gnuplot_quoted(title), body);
}

std::size_t NumberTable::find(std::string_view name) const {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

NumberTable parse_number_table(const std::string &text) {
  NumberTable table;
  std::istringstream stream(text);
  std::string line;
  if (!std::getline(stream, line))
    return table;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');)
    table.names.push_back(name);
  table.columns.resize(table.names.size());
  while (std::getline(stream, line)) {
    const char *at = line.c_str();
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
      char *end = nullptr;
      const double number = std::strtod(at, &end);
      const bool complete = *end == (j + 1 < table.columns.size() ? ',' : '\0');
      if (end == at || !complete)
        return {};
      table.columns[j].push_back(number);
      at = end + 1;
    }
  }
  return table;
}

} // namespace comparisons::reports
