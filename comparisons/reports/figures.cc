#include "comparisons/reports/figures.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/answers_section.h"
#include "comparisons/reports/files.h"
#include "comparisons/reports/gnuplot.h"
#include "comparisons/reports/plot.h"
#include "comparisons/reports/theory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <map>
#include <set>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace comparisons::reports {

namespace {

namespace fs = std::filesystem;

/// More curves than this nobody can tell apart.
constexpr std::size_t most_curves = 12;
/// Fields side by side.
constexpr std::size_t most_fields = 6;
/// Figures of the columns of one data file.
constexpr std::size_t most_columns = 8;

std::string safe(std::string text) {
  for (char &c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.')
      c = '_';
  return text;
}

/// Triangles that show theoretical slopes: one for every distinct rate, at the finest two levels of a curve.
std::string slope_triangles(const Group &group, const Plot &plot, std::size_t n_blocks, std::string &data,
                            std::string &labels) {
  const std::string error = [&] {
    for (const std::string &name : headline_errors(group))
      if (words_of(name) == plot.y_label)
        return name;
    return std::string();
  }();
  std::set<double> seen;
  std::string commands;
  for (const MethodSeries &series : series_of(group)) {
    const auto rate = theoretical_rate(*series.cells.front(), error);
    const auto curve = std::find_if(plot.curves.begin(), plot.curves.end(),
                                    [&](const Curve &one) { return one.label == series.label; });
    if (!rate || curve == plot.curves.end() || curve->points.size() < 2 || !seen.insert(*rate).second)
      continue;
    const auto &a = curve->points[curve->points.size() - 2];
    const auto &b = curve->points.back();
    const double low = 0.5 * b[1];
    const double high = low * std::pow(a[0] / b[0], *rate);
    data +=
        fmt::format("# slope {}\n{} {}\n{} {}\n{} {}\n{} {}\n\n\n", *rate, b[0], low, a[0], low, a[0], high, b[0], low);
    commands += fmt::format(", '{}.dat' index {} using 1:2 with lines lc rgb '#777777' dt 1 notitle", plot.name,
                            n_blocks + seen.size() - 1);
    labels += fmt::format("set label {} '{}' at {},{} left offset 0.4,0 tc rgb '#555555'\n", seen.size(), *rate, a[0],
                          std::sqrt(low * high));
  }
  return commands;
}

GnuplotFigure logarithmic_figure(const Group &group, const Plot &plot, bool with_slopes) {
  std::string data, curves, labels;
  std::size_t n = 0;
  for (const Curve &curve : plot.curves) {
    if (n == most_curves)
      break;
    data += "# " + curve.label + "\n";
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      data += fmt::format("{} {} # {}\n", curve.points[i][0], curve.points[i][1], curve.names[i]);
    data += "\n\n";
    curves += fmt::format("{}'{}.dat' index {} using 1:2 with linespoints lt {} title {}", n == 0 ? "" : ", \\\n  ",
                          plot.name, n, curve.style % 8 + 1, gnuplot_quoted(curve.label));
    ++n;
  }
  if (with_slopes)
    curves += slope_triangles(group, plot, n, data, labels);
  // What is not drawn stands in the key with its reason.
  for (const NotDrawn &cell : plot.not_drawn)
    curves += fmt::format(", \\\n  NaN with points pt 2 lc rgb '#777777' title {}",
                          gnuplot_quoted(fmt::format("{}, {}: {}", cell.label, cell.level,
                                                     cell.reason.substr(0, cell.reason.find(':')))));
  std::string body = fmt::format("set logscale xy\nset format '10^{{%L}}'\nset xlabel {} noenhanced\n"
                                 "set ylabel {} noenhanced\n{}plot {}\n",
                                 gnuplot_quoted(plot.x_label), gnuplot_quoted(plot.y_label), labels, curves);
  return {plot.name, gnuplot_script(plot.name, plot.title, body), data};
}

GnuplotFigure phase_figure(const Group &group) {
  GnuplotFigure figure;
  figure.name = file_stem(group) + "-phases";
  std::size_t n = 0;
  for (const Cell *cell : group.cells) {
    if (cell->status != Status::ok || median_seconds(*cell, "total").value_or(0) <= 0)
      continue;
    std::string name = cell_name(*cell);
    std::replace(name.begin(), name.end(), '"', '\'');
    figure.data += '"' + name + '"';
    for (std::size_t k = 0; k < 6; ++k)
      figure.data += fmt::format(" {}", median_seconds(*cell, phases[k]).value_or(0));
    figure.data += '\n';
    ++n;
  }
  std::string bars;
  for (std::size_t k = 0; k < 6; ++k)
    bars += fmt::format("{}'{}.dat' using {}{} title '{}'", k == 0 ? "" : ", ", figure.name, k + 2,
                        k == 0 ? ":xtic(1)" : "", phases[k]);
  const std::string body =
      fmt::format("set style data histograms\nset style histogram rowstacked\nset style fill solid 0.8 "
                  "border -1\nset boxwidth 0.8\nset xtics rotate by -60 noenhanced\nset ylabel "
                  "'seconds'\nplot {}\n",
                  bars);
  figure.script = gnuplot_script(figure.name, group.title() + ": seconds by phase", body);
  return n > 0 ? figure : GnuplotFigure();
}

/// One data file of the finest ok cell of a label.
struct LabelTable {
  std::string label;
  std::string level;
  NumberTable table;
};

/// By the names of the data files, in the order in which they appear.
std::vector<std::pair<std::string, std::vector<LabelTable>>> tables_of(const Group &group, const fs::path &directory) {
  std::vector<std::pair<std::string, std::vector<LabelTable>>> all;
  for (const MethodSeries &series : series_of(group)) {
    const auto finest = std::find_if(series.cells.rbegin(), series.cells.rend(),
                                     [](const Cell *cell) { return cell->status == Status::ok; });
    if (finest == series.cells.rend())
      continue;
    for (const Series &one : (*finest)->series) {
      if (!one.file.ends_with(".csv"))
        continue;
      NumberTable table = parse_number_table(file_contents(directory / one.file));
      if (table.n_rows() < 2 || table.names.size() < 2)
        continue;
      auto found = std::find_if(all.begin(), all.end(), [&](const auto &entry) { return entry.first == one.name; });
      if (found == all.end())
        found = all.insert(all.end(), {one.name, {}});
      if (found->second.size() < most_curves)
        found->second.push_back({series.label, (*finest)->level, std::move(table)});
    }
  }
  return all;
}

double extent(const std::vector<double> &column) {
  const auto [least, largest] = std::minmax_element(column.begin(), column.end());
  return *largest - *least;
}

/// Of the columns x1, x2 the one that varies more; otherwise the first.
std::size_t abscissa_of(const NumberTable &table) {
  const std::size_t second = table.find("x2");
  return table.names[0] == "x1" && second < table.names.size() &&
                 extent(table.columns[second]) > extent(table.columns[0])
             ? second
             : 0;
}

std::vector<GnuplotFigure> curve_figures(const Group &group, const std::string &name,
                                         const std::vector<LabelTable> &tables) {
  std::vector<GnuplotFigure> figures;
  const NumberTable &first = tables.front().table;
  const std::size_t x = abscissa_of(first);
  for (std::size_t y = 0; y < first.names.size() && figures.size() < most_columns; ++y) {
    const std::string &column = first.names[y];
    if (y == x || column.starts_with("exact_") || column == "x1" || column == "x2")
      continue;
    GnuplotFigure figure;
    figure.name = file_stem(group) + "-" + safe(name) + "-" + safe(column);
    std::string curves;
    std::size_t n = 0;
    const auto add = [&](const NumberTable &table, std::size_t j, const std::string &title, const std::string &style) {
      figure.data += "# " + title + "\n";
      for (std::size_t i = 0; i < table.n_rows(); ++i)
        figure.data += fmt::format("{} {}\n", table.columns[abscissa_of(table)][i], table.columns[j][i]);
      figure.data += "\n\n";
      curves += fmt::format("{}'{}.dat' index {} using 1:2 with lines {} title {}", n == 0 ? "" : ", \\\n  ",
                            figure.name, n, style, gnuplot_quoted(title));
      ++n;
    };
    if (const std::size_t exact = first.find("exact_" + column); exact < first.names.size())
      add(first, exact, "exact", "lc rgb '#000000' lw 2.5");
    for (std::size_t k = 0; k < tables.size(); ++k)
      if (const std::size_t j = tables[k].table.find(column); j < tables[k].table.names.size())
        add(tables[k].table, j, tables[k].label + ", " + tables[k].level, fmt::format("lt {}", k % 8 + 1));
    figure.script = gnuplot_script(figure.name, fmt::format("{}: {} of {}", group.title(), column, name),
                                   fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\nplot {}\n",
                                               gnuplot_quoted(first.names[x]), gnuplot_quoted(column), curves));
    figures.push_back(std::move(figure));
  }
  return figures;
}

/// Points of several methods side by side: coloured by the error on one scale, or moved by the displacement.
GnuplotFigure field_figure(const Group &group, const std::vector<LabelTable> &tables, bool deformed) {
  const char *coloured = deformed ? "von_mises" : "displacement_error";
  GnuplotFigure figure;
  figure.name = file_stem(group) + (deformed ? "-deformed" : "-error_field");
  double least = std::numeric_limits<double>::infinity(), largest = 0, wide = 0, high = 0, moved = 0;
  std::vector<const LabelTable *> shown;
  for (const LabelTable &one : tables) {
    const std::size_t j = one.table.find(coloured);
    if (j == one.table.names.size() || shown.size() == most_fields)
      continue;
    shown.push_back(&one);
    for (const double value : one.table.columns[j])
      if (value > 0) {
        least = std::min(least, value);
        largest = std::max(largest, value);
      }
    wide = std::max(wide, extent(one.table.columns[0]));
    high = std::max(high, extent(one.table.columns[1]));
    for (const char *u : {"displacement_1", "displacement_2"})
      for (const double value : one.table.columns[one.table.find(u)])
        moved = std::max(moved, std::abs(value));
  }
  if (shown.empty() || !(largest > 0) || !(moved > 0))
    return {};
  const double scale = deformed ? 0.1 * std::max(wide, high) / moved : 0;
  std::string plots;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const NumberTable &table = shown[k]->table;
    figure.data += "# x1 x2 " + std::string(coloured) + " of " + shown[k]->label + "\n";
    for (std::size_t i = 0; i < table.n_rows(); ++i)
      figure.data +=
          fmt::format("{} {} {}\n", table.columns[0][i] + scale * table.columns[table.find("displacement_1")][i],
                      table.columns[1][i] + scale * table.columns[table.find("displacement_2")][i],
                      table.columns[table.find(coloured)][i]);
    figure.data += "\n\n";
    plots +=
        fmt::format("set title {} noenhanced\nplot '{}.dat' index {} using 1:2:3 with points pt 7 ps 0.5 lc palette "
                    "notitle\n",
                    gnuplot_quoted(shown[k]->label + ", " + shown[k]->level), figure.name, k);
  }
  const std::size_t n_columns = wide > 2 * high || shown.size() == 1 ? 1 : 2; // long plates one below the other
  const std::string title =
      deformed ? fmt::format("{}: displacement times {:.3g}, colour: von Mises stress in Pa", group.title(), scale)
               : group.title() + ": |u_h - u| in m";
  const std::string body =
      fmt::format("set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 "
                  "'#fde725')\n{}set cbrange [{}:{}]\nset format cb '%.0e'\nset size ratio -1\nunset key\n"
                  "set multiplot layout {},{} title {} noenhanced\n{}unset multiplot\n",
                  deformed ? "" : "set logscale cb\n", deformed ? 0 : std::max(least, 1e-6 * largest), largest,
                  (shown.size() + n_columns - 1) / n_columns, n_columns, gnuplot_quoted(title), plots);
  figure.script = gnuplot_script(figure.name, "", body);
  return figure;
}

/// Of the files that gnuplot is writing: one that it is killed in must not pass for a figure.
constexpr const char *prefix = ".";
constexpr const char *endings[] = {".svg", ".pdf"};

/// Runs gnuplot once over all scripts, whose files get the prefix; 127 if it is not found.
int draw(const std::vector<GnuplotFigure> &figures, const fs::path &directory, std::string &complaint) {
  for (const GnuplotFigure &figure : figures) // of a run that was killed
    for (const char *ending : endings)
      fs::remove(directory / (prefix + figure.name + ending));
  std::vector<std::string> words{"gnuplot", "-e", fmt::format("prefix = {}", gnuplot_quoted(prefix))};
  for (const GnuplotFigure &figure : figures)
    words.push_back(figure.name + ".gp");
  std::vector<char *> argv;
  for (std::string &word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0)
    return -1;
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL); // does not draw on for a killed program
    dup2(ends[1], STDERR_FILENO);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    if (chdir(directory.c_str()) == 0)
      execvp("gnuplot", argv.data());
    _exit(127);
  }
  close(ends[1]);
  char buffer[4096];
  for (ssize_t n = 0; child > 0 && (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    complaint.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = -1;
  if (child > 0)
    waitpid(child, &status, 0);
  return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Takes the prefix off what gnuplot has drawn. It ends at the first script that it cannot follow: of that one nothing
/// is kept.
std::vector<fs::path> take_drawn(const std::vector<GnuplotFigure> &figures, const fs::path &directory, bool all) {
  const auto drawn = [&](const GnuplotFigure &figure, const char *ending) {
    return directory / (prefix + figure.name + ending);
  };
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const bool whole = all || (i + 1 < figures.size() && fs::exists(drawn(figures[i + 1], ".svg")));
    for (const char *ending : endings) {
      const fs::path from = drawn(figures[i], ending);
      if (!fs::exists(from))
        continue;
      if (!whole) {
        fs::remove(from);
        continue;
      }
      files.push_back(directory / (figures[i].name + ending));
      fs::rename(from, files.back());
    }
  }
  return files;
}

} // namespace

std::vector<GnuplotFigure> gnuplot_figures(const Results &results, const fs::path &series_directory) {
  std::vector<GnuplotFigure> figures;
  const std::vector<Group> groups = group_cells(results);
  for (const Group &group : groups) {
    for (const Plot &plot : cost_plots(group))
      figures.push_back(logarithmic_figure(group, plot, false));
    for (const Plot &plot : convergence_plots(group))
      figures.push_back(logarithmic_figure(group, plot, true));
    figures.push_back(phase_figure(group));
    for (const auto &[name, tables] : tables_of(group, series_directory))
      if (name == "field") {
        figures.push_back(field_figure(group, tables, false));
        figures.push_back(field_figure(group, tables, true));
      } else if (!tables.empty())
        for (GnuplotFigure &figure : curve_figures(group, name, tables))
          figures.push_back(std::move(figure));
  }
  std::erase_if(figures, [](const GnuplotFigure &figure) { return figure.data.empty(); });
  return figures;
}

std::vector<fs::path> write_figures(const std::vector<GnuplotFigure> &figures, const fs::path &directory,
                                    std::vector<std::string> &complaints) {
  std::vector<fs::path> files;
  if (figures.empty())
    return files;
  prepare_output_directory(directory);
  for (const GnuplotFigure &figure : figures) {
    files.push_back(directory / (figure.name + ".gp"));
    write_file_atomically(files.back(), figure.script);
    files.push_back(directory / (figure.name + ".dat"));
    write_file_atomically(files.back(), figure.data);
  }
  std::string said;
  const int code = draw(figures, directory, said);
  if (code == 127)
    complaints.push_back("gnuplot is not installed (gnuplot-nox): " + directory.string() +
                         " has scripts and data only");
  else if (code != 0)
    complaints.push_back(fmt::format("gnuplot ended with {} in {}: {}", code, directory.string(), said));
  const auto drawn = take_drawn(figures, directory, code == 0);
  files.insert(files.end(), drawn.begin(), drawn.end());
  return files;
}

} // namespace comparisons::reports
