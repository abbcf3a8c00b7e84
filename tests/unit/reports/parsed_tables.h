#pragma once

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// The tables of a written report, read back from text, Markdown, LaTeX and HTML.
namespace reports_sample {

struct ParsedTable {
  std::string section; ///< heading of level 2
  std::string title;   ///< heading of level 3
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

inline std::string trimmed(const std::string &text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

inline std::vector<std::string> lines_of(const std::string &text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

inline std::vector<std::string> markdown_fields(const std::string &line) {
  std::vector<std::string> fields(1);
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i] == '\\' && i + 1 < line.size())
      fields.back() += line[++i];
    else if (line[i] == '|')
      fields.emplace_back();
    else
      fields.back() += line[i];
  fields.pop_back();
  for (std::string &field : fields)
    field = trimmed(field);
  return fields;
}

inline std::vector<ParsedTable> parse_markdown(const std::string &text) {
  std::vector<ParsedTable> tables;
  std::string section, title, previous;
  for (const std::string &line : lines_of(text)) {
    if (line.starts_with("## "))
      section = line.substr(3), title.clear();
    if (line.starts_with("### "))
      title = line.substr(4);
    if (line.starts_with("| ---"))
      tables.push_back({section, title, markdown_fields(previous), {}});
    else if (line.starts_with("|") && previous.starts_with("|"))
      tables.back().rows.push_back(markdown_fields(line));
    previous = line;
  }
  return tables;
}

/// Columns of a text table are where its rule has dashes.
inline std::vector<std::string> text_fields(const std::string &line, const std::string &rule) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin < rule.size();) {
    const std::size_t end = std::min(rule.find(' ', begin), rule.size());
    fields.push_back(begin < line.size() ? trimmed(line.substr(begin, end - begin)) : "");
    begin = std::min(rule.find('-', end), rule.size());
  }
  return fields;
}

inline bool is_rule(const std::string &line) {
  return line.find("--  --") != std::string::npos && line.find_first_not_of(" -") == std::string::npos;
}

/// A line without a number goes on with the words of the row above.
inline void append_row(ParsedTable &table, const std::vector<std::string> &fields) {
  const auto is_words = [](const std::string &field) {
    return field.empty() || field.find_first_of("0123456789-") == std::string::npos;
  };
  const std::size_t n_words = static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), is_words));
  if (table.rows.empty() || n_words < fields.size()) {
    table.rows.push_back(fields);
    return;
  }
  for (std::size_t j = 0; j < fields.size(); ++j)
    table.rows.back()[j] = trimmed(table.rows.back()[j] + " " + fields[j]);
}

inline std::vector<ParsedTable> parse_text(const std::string &text) {
  std::vector<ParsedTable> tables;
  const std::vector<std::string> lines = lines_of(text);
  std::string section, title;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i + 1 < lines.size() && lines[i + 1].starts_with("--") && !is_rule(lines[i + 1]) && !lines[i].empty())
      section = lines[i], title.clear();
    if (!is_rule(lines[i]))
      continue;
    std::size_t top = i;
    while (top > 0 && !lines[top - 1].empty())
      --top;
    if (top >= 2 && !lines[top - 2].empty() && !lines[top - 2].starts_with("--"))
      title = lines[top - 2];
    ParsedTable table{section, title, std::vector<std::string>(text_fields("", lines[i]).size()), {}};
    for (std::size_t k = top; k < i; ++k) {
      const auto fields = text_fields(lines[k], lines[i]);
      for (std::size_t j = 0; j < fields.size(); ++j)
        table.header[j] = trimmed(table.header[j] + " " + fields[j]);
    }
    for (std::size_t k = i + 1; k < lines.size() && !lines[k].empty(); ++k)
      append_row(table, text_fields(lines[k], lines[i]));
    tables.push_back(std::move(table));
  }
  return tables;
}

/// What LaTeX shows for an entry.
inline std::string latex_shown(std::string text) {
  const std::vector<std::pair<std::string, std::string>> replacements{
      {"{\\char34}", "\""}, {"$-$", "-"}, {"$<$", "<"}, {"$>$", ">"}, {"$|$", "|"}, {"\\textbackslash{}", "\x01"}};
  for (const auto &[from, to] : replacements)
    for (auto place = text.find(from); place != std::string::npos; place = text.find(from, place + to.size()))
      text.replace(place, from.size(), to);
  std::erase(text, '\\');
  std::replace(text.begin(), text.end(), '\x01', '\\');
  return trimmed(text);
}

inline std::vector<std::string> latex_fields(std::string line) {
  line.resize(line.size() - std::string(" \\\\").size());
  std::vector<std::string> fields(1);
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line.compare(i, 3, " & ") == 0)
      fields.emplace_back(), i += 2;
    else
      fields.back() += line[i];
  for (std::string &field : fields)
    field = latex_shown(field);
  return fields;
}

inline std::vector<ParsedTable> parse_latex(const std::string &text) {
  std::vector<ParsedTable> tables;
  std::string section, title;
  enum { outside, head, repeated_head, body } place = outside;
  const auto argument = [](const std::string &line) {
    const auto begin = line.find('{') + 1;
    return latex_shown(line.substr(begin, line.rfind('}') - begin));
  };
  for (const std::string &line : lines_of(text)) {
    if (line.starts_with("\\subsection*"))
      section = argument(line), title.clear();
    else if (line.starts_with("\\subsubsection*"))
      title = argument(line);
    else if (line.starts_with("\\begin{longtable}"))
      tables.push_back({section, title, {}, {}}), place = head;
    else if (line == "\\endfirsthead")
      place = repeated_head;
    else if (line == "\\endlastfoot")
      place = body;
    else if (line.starts_with("\\end{longtable}"))
      place = outside;
    else if (line.ends_with(" \\\\") && place == head) {
      const auto fields = latex_fields(line);
      tables.back().header.resize(fields.size());
      for (std::size_t j = 0; j < fields.size(); ++j)
        tables.back().header[j] = trimmed(tables.back().header[j] + " " + fields[j]);
    } else if (line.ends_with(" \\\\") && place == body)
      tables.back().rows.push_back(latex_fields(line));
  }
  return tables;
}

/// Text between the tags of an element's content, entities resolved.
inline std::string html_shown(const std::string &html) {
  std::string text;
  bool in_tag = false;
  for (const char c : html) {
    if (c == '<')
      in_tag = true;
    if (!in_tag)
      text += c;
    if (c == '>')
      in_tag = false;
  }
  const std::vector<std::pair<std::string, std::string>> entities{
      {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}};
  for (const auto &[from, to] : entities)
    for (auto place = text.find(from); place != std::string::npos; place = text.find(from, place + to.size()))
      text.replace(place, from.size(), to);
  return trimmed(text);
}

/// Contents of the elements of these names, in order.
inline std::vector<std::string> html_elements(const std::string &html, const std::vector<std::string> &names) {
  std::vector<std::string> found;
  std::size_t at = 0;
  while (true) {
    std::size_t begin = std::string::npos;
    std::string name;
    for (const std::string &candidate : names)
      for (const char *after : {">", " "})
        if (const auto place = html.find("<" + candidate + after, at); place < begin)
          begin = place, name = candidate;
    if (begin == std::string::npos)
      return found;
    const auto content = html.find('>', begin) + 1;
    const auto end = html.find("</" + name + ">", content);
    found.push_back(html.substr(content, end - content));
    at = end;
  }
}

/// The tables of the report's sections; that of the explorer is filled by a script and is left out.
inline std::vector<ParsedTable> parse_html(const std::string &html) {
  std::vector<ParsedTable> tables;
  for (const std::string &section : html_elements(html, {"section"})) {
    const std::string name = html_shown(html_elements(section, {"h2"}).at(0));
    if (name == "Explore")
      continue;
    for (const std::string &table : html_elements(section, {"table"})) {
      const std::string caption = html_shown(html_elements(table, {"caption"}).at(0));
      ParsedTable parsed{name, caption == name ? "" : caption, {}, {}};
      for (const std::string &header : html_elements(html_elements(table, {"thead"}).at(0), {"th"}))
        parsed.header.push_back(html_shown(header));
      for (const std::string &row : html_elements(html_elements(table, {"tbody"}).at(0), {"tr"})) {
        parsed.rows.emplace_back();
        for (const std::string &field : html_elements(row, {"th", "td"}))
          parsed.rows.back().push_back(html_shown(field));
      }
      tables.push_back(std::move(parsed));
    }
  }
  return tables;
}

} // namespace reports_sample
