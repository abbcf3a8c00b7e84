#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace comparisons::reports {

// The same results always give the same bytes; nothing here reads a clock or the machine.

/// Aligned tables for the terminal, at most 120 columns where the words allow it. The main comparison comes first,
/// unexpected outcomes last.
std::string text_report(const Results &results);

/// What a reader of many benchmarks wants on the terminal: of every benchmark the main comparison, then what was not as
/// expected, and the summary. The rest stands in the files.
std::string brief_report(const Results &results);

/// The same content as text_report in Markdown.
std::string markdown_report(const Results &results);

/// The same content in LaTeX, to be \input into an article that loads booktabs, longtable and array.
std::string latex_report(const Results &results);

/// The same content as blocks, before it has a form.
Document report_document(const Results &results);

/// Tidy table: a header and one row for every cell and number, in full digits. A cell that is not ok has one row with
/// an empty value and its reason. Fields follow RFC 4180, lines end in '\n'.
std::string csv_report(const Results &results);

/// The ledger as CSV, one row an entry.
std::string csv_published(const Results &results);

/// The formats that write_reports knows: text (stem.txt), md (stem.md), csv (stem.csv and, with published
/// numbers, stem_published.csv), json (stem.json), tex (stem_tables.tex to be \input, and stem.tex, an article of it),
/// html (report.html), figures (gnuplot's scripts and data, SVG and PDF, in figures/) and vtu (states
/// of runs in time, and collections .pvd of them or of the fields that the run wrote).
const std::vector<std::string> &report_formats();

/// Where write_reports finds what is not in the results.
struct ReportSources {
  std::filesystem::path page_directory;   ///< page.css and page.js
  std::filesystem::path series_directory; ///< folder that the cells' data files are relative to; empty: the output's
};

/// Writes the formats asked for into `directory`, each file atomically, and returns their paths in the order of
/// writing (of the figures the folder). The directory is made if it does not exist. Throws OutputError, and
/// std::invalid_argument for an unknown format before anything is written. What gnuplot complains of is added to
/// `complaints` if that is given.
std::vector<std::filesystem::path> write_reports(const Results &results, const std::filesystem::path &directory,
                                                 const std::vector<std::string> &formats, const std::string &stem,
                                                 const ReportSources &sources = {},
                                                 std::vector<std::string> *complaints = nullptr);

/// Unexpected outcomes, one line each: cells first, then published numbers; empty if all is as expected.
std::vector<std::string> unexpected_outcomes(const Results &results);

} // namespace comparisons::reports
