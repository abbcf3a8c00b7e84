#pragma once

#include "comparisons/reports/results.h"

#include <filesystem>
#include <string>

namespace comparisons::reports {

/// Texts that the page carries within itself.
struct PageFiles {
  std::string style;  ///< page.css; without it the page is plain
  std::string script; ///< page.js; without it the page is only to be read
  std::string charts; ///< Chart.js; without it the page has no interactive chart
};

/// Reads page.css and page.js from `directory` and Chart.js where Debian's package libjs-chart.js installs it. What is
/// missing stays empty.
PageFiles load_page_files(const std::filesystem::path &directory);

/// The page: one file that asks nothing of a network, figures and tables readable without scripts.
std::string html_page(const Results &results, const PageFiles &files);

} // namespace comparisons::reports
