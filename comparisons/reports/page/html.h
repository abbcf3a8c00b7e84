#pragma once

#include "comparisons/reports/table.h"

#include <string>

namespace comparisons::reports {

/// One block as HTML: tables with a caption, in a region that scrolls by itself.
/// @param caption of a table, as it stands in the heading above
std::string html_block(const Block &block, const std::string &caption);

/// "Seconds by phase" -> "seconds-by-phase".
std::string html_identifier(const std::string &text);

} // namespace comparisons::reports
