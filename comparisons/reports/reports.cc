#include "comparisons/reports/reports.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/answers_section.h"
#include "comparisons/reports/comparison_section.h"
#include "comparisons/reports/facts_section.h"
#include "comparisons/reports/figures.h"
#include "comparisons/reports/files.h"
#include "comparisons/reports/growth.h"
#include "comparisons/reports/hard_cases_section.h"
#include "comparisons/reports/json.h"
#include "comparisons/reports/latex.h"
#include "comparisons/reports/ledger_section.h"
#include "comparisons/reports/numbers.h"
#include "comparisons/reports/page/page.h"
#include "comparisons/reports/paraview.h"
#include "comparisons/reports/plot.h"
#include "comparisons/reports/recoveries_section.h"
#include "comparisons/reports/scene_section.h"
#include "comparisons/reports/solvers_section.h"
#include "comparisons/reports/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace comparisons::reports {

namespace {

void append_header(Document &document, const Results &results, const std::vector<Group> &groups) {
  std::vector<std::string> benchmarks;
  for (const Group &group : groups)
    if (std::find(benchmarks.begin(), benchmarks.end(), group.benchmark) == benchmarks.end())
      benchmarks.push_back(group.benchmark);
  if (has_hard_cases(results))
    benchmarks.emplace_back("hard_cases");
  if (has_solver_cases(results))
    benchmarks.emplace_back("solvers");
  const Program &program = results.program;
  const Machine &machine = results.machine;
  document.push_back(Heading{1, fmt::format("{}: {}", program.name, fmt::join(benchmarks, ", "))});
  std::vector<std::string> lines;
  lines.push_back(fmt::format("program: {} {}, commit {}, {} build, flags {}", program.name, program.version,
                              program.commit, program.build_type, program.flags));
  lines.push_back(fmt::format("machine: {}, {} cores, {} MB, load {}{}", machine.cpu, machine.cores,
                              megabytes(machine.memory_bytes), significant(machine.load),
                              machine.load_at_end ? ", at the end " + significant(machine.load_at_end) : ""));
  if (machine.competing_cores)
    lines.push_back(
        fmt::format("other processes kept {} cores busy while the cells ran", significant(machine.competing_cores)));
  lines.push_back(
      fmt::format("threads: {}, BLAS: {}, SIMD lanes: {}", machine.threads, machine.blas, machine.simd_lanes));
  std::vector<std::string> libraries;
  for (const auto &[name, version] : machine.libraries)
    libraries.push_back(fmt::format("{} {}", name, version));
  if (!libraries.empty())
    lines.push_back(fmt::format("libraries: {}", fmt::join(libraries, ", ")));
  if (!results.effects_active.empty())
    lines.push_back(fmt::format("effects: {}; neither computed nor allocated: {}",
                                fmt::join(results.effects_active, ", "), fmt::join(results.effects_absent, ", ")));
  document.push_back(Bullets{std::move(lines)});
  for (const std::string &reason : results.not_comparable)
    document.push_back(Alarm{"NOT COMPARABLE: " + reason});
  if (results.interrupted)
    document.push_back(Alarm{"INTERRUPTED: the cells that had not been computed are missing."});
}

void append_reading_aid(Document &document) {
  document.push_back(Paragraph{
      "Errors called relative are over the norm of the exact solution; one quadrature serves all methods; judge by the "
      "L2 norm. log10 E is the difference of two norms as printed in the paper, not an error norm. Rates are observed "
      "between a level and the one before. Seconds are medians over the repeats; 'total' is points, neighbours, basis, "
      "assembly, solve and "
      "recovery, and excludes the evaluation of errors. Memory is the peak of the cell alone."});
}

void append_unexpected(Document &document, const Results &results) {
  const std::vector<std::string> outcomes = unexpected_outcomes(results);
  if (outcomes.empty())
    return;
  document.push_back(Heading{2, fmt::format("UNEXPECTED OUTCOMES ({})", outcomes.size())});
  for (const std::string &outcome : outcomes)
    document.push_back(Alarm{outcome});
}

} // namespace

Document report_document(const Results &results) {
  const std::vector<Group> groups = group_cells(results);
  Document document;
  append_header(document, results, groups);
  append_reading_aid(document);
  if (!groups.empty() || !(has_hard_cases(results) || has_solver_cases(results)))
    append_comparison(document, groups);
  append_equal_error(document, results);
  append_pareto(document, groups);
  append_rates(document, groups);
  append_recoveries(document, groups);
  append_ledger(document, results);
  append_hard_cases(document, results);
  append_solvers(document, results);
  append_facts(document, groups);
  append_phases(document, groups);
  append_used_solvers(document, groups);
  append_growth(document, groups);
  append_clouds(document, groups);
  append_further_quantities(document, groups);
  std::size_t n_series = 0;
  for (const Cell &cell : results.cells)
    n_series += cell.series.size();
  if (n_series > 0)
    document.push_back(Paragraph{fmt::format(
        "Curves and fields written beside the results: {}; the cells of results.json name them.", n_series)});
  append_scenes(document, results);
  append_unexpected(document, results);
  append_summary(document, results);
  return document;
}

namespace {

std::string published_line(const Published &entry) {
  std::string text = fmt::format("{}, {}", entry.source, entry.entry);
  if (!entry.method.empty())
    text += fmt::format(" ({}{}{})", entry.method, entry.level.empty() ? "" : ", ", entry.level);
  text += ": " + verdict_text(entry);
  if (entry.published && entry.computed)
    text += fmt::format(": {} published {}, computed {}, tolerance {}", entry.quantity, exact(entry.published),
                        significant(entry.computed), significant(entry.tolerance));
  return entry.finding.empty() ? text : text + ": " + entry.finding;
}

} // namespace

std::vector<std::string> unexpected_outcomes(const Results &results) {
  std::vector<std::string> outcomes;
  for (const Cell &cell : results.cells)
    if (!cell.expected)
      outcomes.push_back(fmt::format("{} / {}{}{}, {}: {}{}{}", cell.benchmark, cell.scene,
                                     cell.variant.empty() ? "" : ", ", cell.variant, cell_name(cell), status_text(cell),
                                     cell.reason.empty() ? "" : ": ", cell.reason));
  for (const Published &entry : results.published)
    if (!entry.expected)
      outcomes.push_back(published_line(entry));
  return outcomes;
}

std::string text_report(const Results &results) { return render_text(report_document(results)); }

std::string brief_report(const Results &results) {
  const std::vector<Group> groups = group_cells(results);
  std::vector<Group> main;
  for (const Group &group : groups) // the first of a benchmark is its main one
    if (main.empty() || main.back().benchmark != group.benchmark)
      main.push_back(group);
  Document document;
  append_header(document, results, groups);
  if (!groups.empty() || !(has_hard_cases(results) || has_solver_cases(results)))
    append_comparison(document, main);
  if (groups.size() > main.size())
    document.push_back(Paragraph{fmt::format(
        "{} further comparisons, the published numbers one by one, the seconds for equal errors, rates and phases are "
        "in the files.",
        groups.size() - main.size())});
  append_hard_cases_in_brief(document, results);
  append_solvers_in_brief(document, results);
  append_unexpected(document, results);
  append_summary(document, results);
  return render_text(document);
}

std::string markdown_report(const Results &results) { return render_markdown(report_document(results)); }

std::string latex_report(const Results &results) { return render_latex(report_document(results)); }

const std::vector<std::string> &report_formats() {
  static const std::vector<std::string> formats{"text", "md", "csv", "json", "tex", "html", "figures", "vtu"};
  return formats;
}

namespace {

/// Writes one format after the other.
class Writer {
public:
  Writer(const Results &results, std::filesystem::path directory, std::string stem, const ReportSources &sources)
      : results_(results), directory_(std::move(directory)), stem_(std::move(stem)), sources_(sources),
        series_(sources.series_directory.empty() ? directory_ : sources.series_directory) {}

  void write(const std::string &format, std::vector<std::string> &complaints) {
    if (format == "text")
      add(stem_ + ".txt", text_report(results_));
    else if (format == "md")
      add(stem_ + ".md", markdown_report(results_));
    else if (format == "json")
      add(stem_ + ".json", json_text(results_));
    else if (format == "html")
      add("report.html", html_page(results_, load_page_files(sources_.page_directory)));
    else if (format == "tex") {
      add(stem_ + "_tables.tex", latex_report(results_));
      add(stem_ + ".tex", latex_article(results_, stem_ + "_tables"));
    } else if (format == "csv") {
      add(stem_ + ".csv", csv_report(results_));
      if (!results_.published.empty())
        add(stem_ + "_published.csv", csv_published(results_));
    } else if (format == "vtu") {
      for (const Group &group : group_cells(results_))
        for (const TextFile &file : paraview_files(group, series_, directory_)) {
          prepare_output_directory((directory_ / file.name).parent_path());
          add(file.name, file.text);
        }
    } else if (!write_figures(gnuplot_figures(results_, series_), directory_ / "figures", complaints).empty())
      files_.push_back(directory_ / "figures");
  }

  const std::vector<std::filesystem::path> &files() const { return files_; }

private:
  void add(const std::string &name, const std::string &contents) {
    files_.push_back(directory_ / name);
    write_file_atomically(files_.back(), contents);
  }

  const Results &results_;
  std::filesystem::path directory_;
  std::string stem_;
  const ReportSources &sources_;
  std::filesystem::path series_;
  std::vector<std::filesystem::path> files_;
};

} // namespace

std::vector<std::filesystem::path> write_reports(const Results &results, const std::filesystem::path &directory,
                                                 const std::vector<std::string> &formats, const std::string &stem,
                                                 const ReportSources &sources, std::vector<std::string> *complaints) {
  const std::vector<std::string> &known = report_formats();
  for (const std::string &format : formats)
    if (std::find(known.begin(), known.end(), format) == known.end())
      throw std::invalid_argument(
          fmt::format("unknown report format '{}'; known are {}", format, fmt::join(known, ", ")));
  prepare_output_directory(directory);
  std::vector<std::string> unheard;
  Writer writer(results, directory, stem, sources);
  for (const std::string &format : formats)
    writer.write(format, complaints != nullptr ? *complaints : unheard);
  return writer.files();
}

} // namespace comparisons::reports
