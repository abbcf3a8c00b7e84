#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

#include <string>
#include <string_view>

namespace comparisons::reports {

/// Blocks as LaTeX with the tables of booktabs: needs the packages booktabs, longtable and array, and nothing else.
/// Characters that pdflatex does not know become their names in mathematics, or '?'.
std::string render_latex(const Document &document);

/// An article, A4 across, that inputs `tables` (a file name without its ending).
std::string latex_article(const Results &results, const std::string &tables);

/// Text that LaTeX prints as it is.
std::string latex_escaped(std::string_view text);

} // namespace comparisons::reports
