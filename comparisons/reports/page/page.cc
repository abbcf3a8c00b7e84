#include "comparisons/reports/page/page.h"

#include "comparisons/reports/answers.h"
#include "comparisons/reports/hard_cases_section.h"
#include "comparisons/reports/json.h"
#include "comparisons/reports/page/html.h"
#include "comparisons/reports/page/svg.h"
#include "comparisons/reports/reports.h"
#include "comparisons/reports/solvers_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <zlib.h>

namespace comparisons::reports {

namespace {

constexpr std::array<const char *, 2> chart_libraries{"/usr/share/javascript/chart.js/chart.min.js",
                                                      "/usr/share/nodejs/chart.js/dist/chart.min.js"};

std::string base64(const std::string &bytes) {
  constexpr const char *digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = (three << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[(three >> (18 - 6 * k)) & 63] : '=';
  }
  return text;
}

std::string read(const std::filesystem::path &file) {
  std::ifstream stream(file, std::ios::binary);
  return stream ? std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()) : std::string();
}

void replace_all(std::string &text, std::string_view from, std::string_view to) {
  for (auto place = text.find(from); place != std::string::npos; place = text.find(from, place + to.size()))
    text.replace(place, from.size(), to);
}

/// A script within HTML ends at the first "</script"; a source map would be asked for over the network.
std::string inline_script(std::string script) {
  replace_all(script, "</script", "<\\/script");
  replace_all(script, "sourceMappingURL=", "");
  return script.empty() ? std::string() : "<script>" + script + "</script>\n";
}

/// results.json without its white space, deflated and in base64: a tenth of its size.
std::string packed_json(const Results &results) {
  const std::string json = to_json(results).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  uLongf size = compressBound(json.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef *>(packed.data()), &size, reinterpret_cast<const Bytef *>(json.data()),
                json.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("the results could not be compressed");
  packed.resize(size);
  return base64(packed);
}

/// Groups whose figures stand in the page: the main comparisons, those with several levels, and failures. The explorer
/// draws all.
bool has_figures(const Group &group) {
  const bool has_failed =
      std::any_of(group.cells.begin(), group.cells.end(), [](const Cell *cell) { return cell->status != Status::ok; });
  return group.scene == "scene" || has_several_levels(group) || has_failed;
}

std::string group_figures(const Group &group) {
  constexpr std::size_t most = 2;
  std::string html;
  if (has_figures(group))
    for (std::vector<Plot> plots = cost_plots(group); const Plot &plot : plots)
      if (&plot < plots.data() + most)
        html += svg_figure(plot);
  return html.empty() ? html : "<div class='figures'>" + html + "</div>\n";
}

const Group *find_group(const std::vector<Group> &groups, const std::string &title) {
  for (const Group &group : groups)
    if (group.title() == title)
      return &group;
  return nullptr;
}

/// The report's blocks as sections, one a heading of level 2, with figures behind the tables of the comparison.
class Body {
public:
  explicit Body(const Results &results) : groups_(group_cells(results)) {
    for (const Block &block : report_document(results))
      add(block);
    close();
  }

  const std::string &html() const { return html_; }
  const std::string &title() const { return title_; }
  const std::string &summary() const { return summary_; }
  const std::string &links() const { return links_; }

private:
  void close() {
    if (section_.empty() || open_.empty())
      return;
    std::string &target = section_ == "Summary" ? summary_ : html_;
    const std::string name = html_identifier(section_);
    target += fmt::format("<section id='{0}' aria-labelledby='{0}-title'><h2 id='{0}-title'>{1}</h2>\n{2}</section>\n",
                          name, html_escaped(section_), open_);
    links_ += fmt::format("<li><a href='#{}'>{}</a></li>", name, html_escaped(section_));
    open_.clear();
  }

  /// Numbers in full stand in the data, and the explorer draws them; a page of all tables would be slow to load.
  bool is_left_out(const Block &block) const {
    if (section_ == "Further errors and quantities")
      return true;
    const Group *group = find_group(groups_, caption_);
    return section_ == "Seconds by phase" && group != nullptr && group->scene != "scene" &&
           !std::holds_alternative<Heading>(block);
  }

  void add(const Block &block) {
    if (const auto *heading = std::get_if<Heading>(&block)) {
      caption_ = heading->text;
      if (heading->level == 1) {
        title_ = heading->text;
        section_ = "Program and machine";
        return;
      }
      if (heading->level == 2) {
        close();
        section_ = heading->text;
        return;
      }
    }
    if (is_left_out(block))
      return;
    open_ += html_block(block, caption_);
    const Group *group = std::holds_alternative<Table>(block) ? find_group(groups_, caption_) : nullptr;
    if (group != nullptr && section_ == "Comparison")
      open_ += group_figures(*group);
    if (group != nullptr && section_ == "Seconds by phase")
      open_ += svg_phase_bars(*group);
  }

  std::vector<Group> groups_;
  std::string title_;
  std::string section_;
  std::string caption_;
  std::string open_;
  std::string html_;
  std::string summary_;
  std::string links_;
};

/// What a script fills; hidden without one.
constexpr const char *explorer = R"(<section id='explore' aria-labelledby='explore-title' hidden>
<h2 id='explore-title'>Explore</h2>
<form id='choices'>
<label>Comparison <select id='group'></select></label>
<label>Error <select id='error'></select></label>
<label>Against <select id='axis'><option value='seconds'>seconds</option><option value='dofs'>unknowns</option><option value='memory'>memory in MB</option></select></label>
<fieldset id='methods'><legend>Methods</legend></fieldset>
</form>
<div id='chart-frame'><canvas id='chart' role='img' aria-label='Error of the methods chosen; the same numbers are in the tables below'></canvas></div>
<p id='no-chart' hidden>The interactive chart needs Chart.js (Debian's package libjs-chart.js), which was not there when this page was written. The figures below show the same.</p>
<ul id='not-drawn'></ul>
<h3 id='equal-title'>Seconds for an equal error</h3>
<p><label for='target'>Target error</label> <input type='range' id='target' step='any' aria-describedby='target-value'> <output id='target-value' for='target'></output></p>
<div class='scroll' tabindex='0' role='region' aria-labelledby='equal-title'><table id='equal'><caption>Interpolated between two measured levels, never beyond</caption><thead><tr><th scope='col' class='p'>method</th><th scope='col'>seconds</th><th scope='col'>over the best</th><th scope='col' class='p'>why not</th></tr></thead><tbody></tbody></table></div>
</section>
)";

} // namespace

PageFiles load_page_files(const std::filesystem::path &directory) {
  PageFiles files;
  if (!directory.empty()) {
    files.style = read(directory / "page.css");
    files.script = read(directory / "page.js");
  }
  for (const char *library : chart_libraries)
    if (!files.script.empty() && files.charts.empty()) // nothing else would draw with it
      files.charts = read(library);
  return files;
}

std::string html_page(const Results &results, const PageFiles &files) {
  const Body body(results);
  std::string alarms;
  for (const std::string &reason : results.not_comparable)
    alarms += fmt::format("<p class='alarm'>NOT COMPARABLE: {}</p>\n", html_escaped(reason));
  if (results.interrupted)
    alarms += "<p class='alarm'>INTERRUPTED: the cells that had not been computed are missing.</p>\n";
  const bool to_explore = !std::all_of(results.cells.begin(), results.cells.end(),
                                       [](const Cell &cell) { return is_hard_case(cell) || is_solver_case(cell); });
  return fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
      "<meta name='viewport' content='width=device-width, initial-scale=1'>\n"
      "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; style-src 'unsafe-inline'; script-src "
      "'unsafe-inline'; img-src data:\">\n<meta name='color-scheme' content='light dark'>\n"
      "<link rel='icon' href='data:,'>\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n"
      "<a class='skip' href='#main'>To the results</a>\n"
      "<header><h1>{0}</h1>\n<p>Error against time, the seconds for equal errors and the numbers printed in papers. "
      "{2} {3}, commit {4}.</p>\n{5}</header>\n<nav aria-label='Sections'><ul>{14}{6}</ul></nav>\n{7}<main id='main' "
      "tabindex='-1'>\n{8}{9}{10}"
      "<section id='data-files' aria-labelledby='data-title'><h2 id='data-title'>Data</h2>\n<p id='downloads'>The "
      "numbers "
      "of this page in full: results.json and results.csv beside it. <span class='scripted' hidden>Or from within it: "
      "<button type='button' id='download-json'>results.json</button> <button type='button' "
      "id='download-csv'>results.csv</button></span></p>\n</section>\n</main>\n"
      "<script type='text/plain' id='results'>{11}</script>\n{12}{13}</body>\n</html>\n",
      html_escaped(body.title()), files.style, html_escaped(results.program.name),
      html_escaped(results.program.version), html_escaped(results.program.commit), alarms, body.links(),
      marker_definitions(), body.summary(), explorer, body.html(), packed_json(results), inline_script(files.charts),
      inline_script(files.script), to_explore ? "<li class='scripted' hidden><a href='#explore'>Explore</a></li>" : "");
}

} // namespace comparisons::reports
