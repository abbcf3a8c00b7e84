#include "comparisons/reports/page/html.h"

#include "comparisons/reports/page/svg.h"

#include <fmt/format.h>

#include <cctype>

namespace comparisons::reports {

namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// Most entries are numbers: they need no class.
std::string cell_class(const Column &column) {
  return column.align == Align::right ? "" : column.prose ? " class=p" : " class=l";
}

std::string html_table(const Table &table, const std::string &caption) {
  std::string html = fmt::format("<div class='scroll' tabindex='0' role='region' aria-label='{0}'><table><caption>{0}"
                                 "</caption><thead><tr>",
                                 html_escaped(caption));
  for (const Column &column : table.columns()) {
    const std::string header = html_escaped(one_line(column.header));
    html += fmt::format("<th scope=col{}>{}</th>", cell_class(column), header);
  }
  html += "</tr></thead><tbody>\n";
  for (const auto &row : table.rows()) {
    html += "<tr>";
    for (std::size_t j = 0; j < row.size(); ++j)
      html += j == 0 ? fmt::format("<th scope=row{}>{}</th>", cell_class(table.columns()[j]), html_escaped(row[j]))
                     : fmt::format("<td{}>{}</td>", cell_class(table.columns()[j]), html_escaped(row[j]));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string list(const std::vector<std::string> &items) {
  std::string html = "<ul>";
  for (const std::string &item : items)
    html += "<li>" + html_escaped(item) + "</li>";
  return html + "</ul>\n";
}

std::string notes(const Notes &given) {
  std::string html = "<ul class='notes'>";
  int number = given.first;
  for (const std::string &item : given.items)
    html += fmt::format("<li>[{}] {}</li>", number++, html_escaped(item));
  return html + "</ul>\n";
}

} // namespace

std::string html_block(const Block &block, const std::string &caption) {
  return std::visit(
      Overloaded{[](const Heading &heading) {
                   return fmt::format("<h{0}>{1}</h{0}>\n", heading.level, html_escaped(heading.text));
                 },
                 [](const Paragraph &paragraph) { return "<p>" + html_escaped(paragraph.text) + "</p>\n"; },
                 [](const Alarm &alarm) { return "<p class='alarm'>" + html_escaped(alarm.text) + "</p>\n"; },
                 [](const Bullets &bullets) { return list(bullets.items); },
                 [](const Notes &given) { return notes(given); },
                 [&](const Table &table) { return html_table(table, caption); }},
      block);
}

std::string html_identifier(const std::string &text) {
  std::string name;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)))
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  while (name.ends_with('-'))
    name.pop_back();
  return name;
}

} // namespace comparisons::reports
