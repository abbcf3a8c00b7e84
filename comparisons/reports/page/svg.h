#pragma once

#include "comparisons/reports/plot.h"

#include <string>
#include <string_view>

namespace comparisons::reports {

/// Text that HTML shows as it is, in attributes too.
std::string html_escaped(std::string_view text);

/// Styles (colour, marker, dash) there are before they repeat.
inline constexpr std::size_t n_plot_styles = 8;

/// The markers that plots refer to; once in a page.
std::string marker_definitions();

/// A figure with its legend. Colours are classes c0 ... c7 of the page's style sheet; points name their values.
std::string svg_figure(const Plot &plot);

/// Seconds by phase as stacked bars, one for the finest level of each label; empty if nothing was timed.
std::string svg_phase_bars(const Group &group);

} // namespace comparisons::reports
