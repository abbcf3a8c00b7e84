#include "comparisons/reports/page/svg.h"

#include "comparisons/reports/numbers.h"
#include "comparisons/reports/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::reports {

namespace {

// User units of a figure, and the frame of its axes.
constexpr double width = 640;
constexpr double height = 420;
constexpr double left = 70;
constexpr double right = 625;
constexpr double top = 34;
constexpr double bottom = 372;

/// A logarithmic axis with some room around the data.
class Axis {
public:
  Axis(double lower, double upper, double begin, double end) : begin_(begin), end_(end) {
    const double room = std::max(0.08, 0.04 * std::log10(upper / lower));
    lower_ = std::log10(lower) - room;
    upper_ = std::log10(upper) + room;
  }
  double operator()(double value) const {
    return begin_ + (std::log10(value) - lower_) / (upper_ - lower_) * (end_ - begin_);
  }
  std::vector<double> ticks() const { return logarithmic_ticks(std::pow(10, lower_), std::pow(10, upper_)); }

private:
  double begin_;
  double end_;
  double lower_ = 0;
  double upper_ = 0;
};

Axis axis_of(const Plot &plot, std::size_t k, double begin, double end) {
  double lower = plot.curves.front().points.front()[k];
  double upper = lower;
  for (const Curve &curve : plot.curves)
    for (const auto &point : curve.points) {
      lower = std::min(lower, point[k]);
      upper = std::max(upper, point[k]);
    }
  return {lower, upper, begin, end};
}

std::string grid(const Axis &x, const Axis &y, const Plot &plot) {
  std::string svg;
  std::string labels;
  for (const double tick : x.ticks()) {
    svg += fmt::format("M{:.1f} {}V{}", x(tick), top, bottom);
    labels +=
        fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>", x(tick), bottom + 17, tick_text(tick));
  }
  for (const double tick : y.ticks()) {
    svg += fmt::format("M{} {:.1f}H{}", left, y(tick), right);
    labels +=
        fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{}</text>", left - 6, y(tick) + 4, tick_text(tick));
  }
  return fmt::format("<path class='grid' d='{}'/><rect class='frame' x='{}' y='{}' width='{}' height='{}'/>{}"
                     "<text x='{}' y='{}' text-anchor='middle'>{}</text>"
                     "<text transform='translate(14 {}) rotate(-90)' text-anchor='middle'>{}</text>",
                     svg, left, top, right - left, bottom - top, labels, (left + right) / 2, bottom + 38,
                     html_escaped(plot.x_label), (top + bottom) / 2, html_escaped(plot.y_label));
}

std::string curve_svg(const Curve &curve, const Axis &x, const Axis &y) {
  const std::size_t style = curve.style % n_plot_styles;
  std::string path;
  std::string marks;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const auto &point = curve.points[i];
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', x(point[0]), y(point[1]));
    marks += fmt::format("<use href='#m{}' x='{:.1f}' y='{:.1f}'><title>{}, {}: {}, {}</title></use>", style,
                         x(point[0]), y(point[1]), html_escaped(curve.label), html_escaped(curve.names[i]),
                         significant(point[0]), scientific(point[1]));
  }
  return fmt::format("<g class='c{0}'><path class='d{0}' d='{1}'/>{2}</g>", style, path, marks);
}

/// Crosses above the frame, with the reasons as their titles.
std::string crosses(const Plot &plot) {
  std::string svg;
  double x = left + 8;
  for (const NotDrawn &cell : plot.not_drawn) {
    svg += fmt::format("<use class='c{}' href='#mx' x='{:.1f}' y='{}'><title>{}, {}: {}</title></use>",
                       cell.style % n_plot_styles, x, top - 12, html_escaped(cell.label), html_escaped(cell.level),
                       html_escaped(cell.reason));
    x += std::min(18.0, (right - left - 16) / static_cast<double>(plot.not_drawn.size()));
  }
  return svg;
}

std::string legend(const Plot &plot) {
  std::string html = "<ul class='legend'>";
  for (const Curve &curve : plot.curves) {
    const std::size_t style = curve.style % n_plot_styles;
    html +=
        fmt::format("<li><svg viewBox='0 0 36 12' aria-hidden='true' class='key c{0}'><path class='d{0}' d='M0 6H36'/>"
                    "<use href='#m{0}' x='18' y='6'/></svg>{1}</li>",
                    style, html_escaped(curve.label));
  }
  for (const NotDrawn &cell : plot.not_drawn)
    html += fmt::format(
        "<li class='missing'><svg viewBox='0 0 36 12' aria-hidden='true' class='key c{}'><use href='#mx' "
        "x='18' y='6'/></svg>{}, {}: {}</li>",
        cell.style % n_plot_styles, html_escaped(cell.label), html_escaped(cell.level), html_escaped(cell.reason));
  return html + "</ul>";
}

constexpr std::array<const char *, 7> bar_phases{"points", "neighbours", "basis",     "assembly",
                                                 "solve",  "recovery",   "evaluation"};

/// The last ok level of its label: one bar a label, or the page would be all bars.
bool is_finest(const Group &group, const Cell &cell) {
  const Cell *finest = nullptr;
  for (const Cell *other : group.cells)
    if (other->label == cell.label && other->status == Status::ok)
      finest = other;
  return finest == &cell;
}

} // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text)
    switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    case '\'':
      result += "&#39;";
      break;
    default:
      result += c;
    }
  return result;
}

std::string marker_definitions() {
  constexpr std::array<const char *, n_plot_styles> markers{"<circle r='4'/>",
                                                            "<path d='M-4-4H4V4H-4Z'/>",
                                                            "<path d='M0-5L5 4H-5Z'/>",
                                                            "<path d='M0-5.5L5.5 0L0 5.5L-5.5 0Z'/>",
                                                            "<path d='M0 5L5-4H-5Z'/>",
                                                            "<circle r='4' class='hollow'/>",
                                                            "<path class='hollow' d='M-4-4H4V4H-4Z'/>",
                                                            "<path class='hollow' d='M0-5L5 4H-5Z'/>"};
  std::string svg = "<svg class='definitions' aria-hidden='true' focusable='false'><defs>";
  for (std::size_t i = 0; i < markers.size(); ++i)
    svg += fmt::format("<g id='m{}'>{}</g>", i, markers[i]);
  return svg + "<g id='mx'><path class='cross' d='M-4-4L4 4M-4 4L4-4'/></g></defs></svg>";
}

std::string svg_figure(const Plot &plot) {
  if (plot.curves.empty())
    return {};
  const Axis x = axis_of(plot, 0, left, right);
  const Axis y = axis_of(plot, 1, bottom, top);
  std::string svg =
      fmt::format("<figure class='plot'><figcaption>{0}</figcaption><svg viewBox='0 0 {1} {2}' role='img' "
                  "aria-label='{0}'>{3}",
                  html_escaped(plot.title), width, height, grid(x, y, plot));
  for (const Curve &curve : plot.curves)
    svg += curve_svg(curve, x, y);
  return svg + crosses(plot) + "</svg>" + legend(plot) + "</figure>\n";
}

std::string svg_phase_bars(const Group &group) {
  std::vector<const Cell *> cells;
  double longest = 0;
  for (const Cell *cell : group.cells)
    if (is_finest(group, *cell) && median_seconds(*cell, "total").value_or(0) > 0) {
      cells.push_back(cell);
      longest = std::max(longest, *median_seconds(*cell, "total"));
    }
  if (cells.empty())
    return {};
  constexpr double row = 20;
  constexpr double begin = 190;
  const std::string caption = html_escaped(group.title() + ": seconds by phase");
  std::string svg = fmt::format("<figure class='plot'><figcaption>{0}</figcaption><svg viewBox='0 0 {1} {2:.0f}' "
                                "role='img' aria-label='{0}'>",
                                caption, width, row * static_cast<double>(cells.size()) + 8);
  double y = 4;
  for (const Cell *cell : cells) {
    const std::string name = group.common_level().empty() ? cell_name(*cell) : cell->label;
    svg += fmt::format("<text x='{}' y='{:.0f}' text-anchor='end'>{}</text>", begin - 6, y + 13,
                       html_escaped(display_width(name) > 28 ? name.substr(0, 27) + "." : name));
    double x = begin;
    for (std::size_t k = 0; k + 1 < bar_phases.size(); ++k) { // without evaluation
      const double seconds = median_seconds(*cell, bar_phases[k]).value_or(0);
      const double extent = seconds / longest * (right - begin - 62);
      if (extent > 0.05)
        svg += fmt::format(
            "<rect class='b{}' x='{:.1f}' y='{:.0f}' width='{:.1f}' height='15'><title>{}: {} s</title></rect>", k, x,
            y + 1, extent, bar_phases[k], significant(seconds));
      x += extent;
    }
    svg +=
        fmt::format("<text x='{:.1f}' y='{:.0f}'>{} s</text>", x + 5, y + 13, seconds(median_seconds(*cell, "total")));
    y += row;
  }
  svg += "</svg><ul class='legend'>";
  for (std::size_t k = 0; k + 1 < bar_phases.size(); ++k)
    svg += fmt::format("<li><svg viewBox='0 0 14 12' aria-hidden='true' class='key short'><rect class='b{}' width='14' "
                       "height='12'/></svg>{}</li>",
                       k, bar_phases[k]);
  return svg + "</ul></figure>\n";
}

} // namespace comparisons::reports
