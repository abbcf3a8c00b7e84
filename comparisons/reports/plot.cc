#include "comparisons/reports/plot.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/answers_section.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <functional>
#include <set>

namespace comparisons::reports {

namespace {

using Abscissa = std::function<std::optional<double>(const Cell &)>;

Plot make_plot(const Group &group, const std::string &error, const Abscissa &x) {
  Plot plot;
  plot.y_label = words_of(error);
  std::size_t style = 0;
  for (const MethodSeries &series : series_of(group)) {
    Curve curve{series.label, style, {}, {}};
    for (const Cell *cell : series.cells) {
      const auto value = target_error(*cell, error);
      const auto place = x(*cell);
      if (cell->status != Status::ok)
        plot.not_drawn.push_back(
            {series.label, style, cell->level,
             std::string(to_text(cell->status)) + (cell->reason.empty() ? "" : ": ") + cell->reason});
      else if (value && place && *place > 0) {
        curve.points.push_back({*place, *value});
        curve.names.push_back(cell->level);
      }
    }
    if (!curve.points.empty())
      plot.curves.push_back(std::move(curve));
    ++style;
  }
  return plot;
}

std::size_t n_points(const Plot &plot) {
  std::size_t n = 0;
  for (const Curve &curve : plot.curves)
    n += curve.points.size();
  return n;
}

} // namespace

std::vector<Plot> cost_plots(const Group &group) {
  std::vector<Plot> plots;
  for (const std::string &error : headline_errors(group)) {
    Plot plot = make_plot(group, error, [](const Cell &cell) { return median_seconds(cell, "total"); });
    if (n_points(plot) < 2)
      continue;
    plot.name = file_stem(group) + "-" + error + "-cost";
    plot.title = fmt::format("{}: {} against seconds", group.title(), words_of(error));
    plot.x_label = "seconds (median of total)";
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<Plot> convergence_plots(const Group &group) {
  std::vector<Plot> plots;
  if (!group.common_level().empty())
    return plots;
  for (const std::string &error : headline_errors(group)) {
    Plot plot = make_plot(group, error, [](const Cell &cell) { return relative_spacing(cell); });
    std::set<double> spacings;
    for (const Curve &curve : plot.curves)
      for (const auto &point : curve.points)
        spacings.insert(point[0]);
    if (spacings.size() < 2)
      continue;
    plot.name = file_stem(group) + "-" + error + "-convergence";
    plot.title = fmt::format("{}: {} against spacing", group.title(), words_of(error));
    plot.x_label = "spacing (relative)";
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::string file_stem(const Group &group) {
  std::string stem = group.benchmark + "-" + group.scene;
  if (!group.variant.empty())
    stem += "-" + group.variant;
  for (char &c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-')
      c = '_';
  return stem;
}

std::vector<double> logarithmic_ticks(double lower, double upper) {
  std::vector<double> ticks;
  for (const bool fine : {false, true}) {
    ticks.clear();
    const int first = static_cast<int>(std::floor(std::log10(lower)));
    const int last = static_cast<int>(std::ceil(std::log10(upper)));
    // Not more than about eight labels on an axis.
    const int step = std::max(1, (last - first + 7) / 8);
    for (int exponent = first; exponent <= last; ++exponent)
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(10.0, exponent);
        const bool wanted = factor == 1 ? fine || (exponent - first) % step == 0 : fine;
        if (wanted && value >= lower * (1 - 1e-9) && value <= upper * (1 + 1e-9))
          ticks.push_back(value);
      }
    if (ticks.size() >= 3)
      break;
  }
  return ticks;
}

std::string tick_text(double value) {
  return value >= 0.999e-3 && value < 9.99e3 ? fmt::format("{:.3g}", value) : fmt::format("{:.0e}", value);
}

} // namespace comparisons::reports
