#include "comparisons/reports/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <stdexcept>

namespace comparisons::reports {

namespace {

constexpr std::size_t gap = 2;
constexpr std::size_t narrowest_prose = 12;

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  return lines;
}

std::string joined(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string padded(const std::string &text, std::size_t width, Align align) {
  const std::string space(width - std::min(width, display_width(text)), ' ');
  return align == Align::right ? space + text : text + space;
}

std::vector<std::size_t> natural_widths(const Table &table) {
  std::vector<std::size_t> widths;
  for (std::size_t j = 0; j < table.columns().size(); ++j) {
    std::size_t width = 0;
    for (const std::string &line : lines_of(table.columns()[j].header))
      width = std::max(width, display_width(line));
    for (const auto &row : table.rows())
      width = std::max(width, display_width(row[j]));
    widths.push_back(width);
  }
  return widths;
}

/// A column of prose must hold its longest word, or the line would be pushed out of its columns.
std::size_t narrowest_width(const Table &table, std::size_t j) {
  std::size_t width = narrowest_prose;
  for (const auto &row : table.rows())
    for (const std::string &word : wrap(joined(row[j]), 1))
      width = std::max(width, display_width(word));
  return width;
}

/// Narrows the columns of prose, the widest first, until the table fits.
std::vector<std::size_t> fitted_widths(const Table &table, std::size_t limit) {
  std::vector<std::size_t> widths = natural_widths(table);
  std::vector<std::size_t> narrowest = widths;
  for (std::size_t j = 0; j < widths.size(); ++j)
    if (table.columns()[j].prose)
      narrowest[j] = std::min(widths[j], narrowest_width(table, j));
  const std::size_t gaps = gap * (widths.size() - std::min<std::size_t>(1, widths.size()));
  while (std::accumulate(widths.begin(), widths.end(), gaps) > limit) {
    std::size_t widest = widths.size();
    for (std::size_t j = 0; j < widths.size(); ++j)
      if (widths[j] > narrowest[j] && (widest == widths.size() || widths[j] > widths[widest]))
        widest = j;
    if (widest == widths.size())
      break;
    --widths[widest];
  }
  return widths;
}

void append_line(std::string &text, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  text += line + '\n';
}

/// One row whose entries have several lines.
void append_lines(std::string &text, const Table &table, const std::vector<std::size_t> &widths,
                  const std::vector<std::vector<std::string>> &entries) {
  std::size_t height = 0;
  for (const auto &entry : entries)
    height = std::max(height, entry.size());
  for (std::size_t i = 0; i < height; ++i) {
    std::string line;
    for (std::size_t j = 0; j < entries.size(); ++j) {
      if (j > 0)
        line += std::string(gap, ' ');
      line += padded(i < entries[j].size() ? entries[j][i] : std::string(), widths[j], table.columns()[j].align);
    }
    append_line(text, std::move(line));
  }
}

std::string text_table(const Table &table, std::size_t limit) {
  const std::vector<std::size_t> widths = fitted_widths(table, limit);
  std::string text;
  std::vector<std::vector<std::string>> headers;
  std::size_t height = 0;
  for (const Column &column : table.columns()) {
    headers.push_back(lines_of(column.header));
    height = std::max(height, headers.back().size());
  }
  for (auto &header : headers) // headers stand on the rule
    header.insert(header.begin(), height - header.size(), std::string());
  append_lines(text, table, widths, headers);
  std::vector<std::vector<std::string>> rules;
  for (const std::size_t width : widths)
    rules.push_back({std::string(width, '-')});
  append_lines(text, table, widths, rules);
  for (const auto &row : table.rows()) {
    std::vector<std::vector<std::string>> entries;
    for (std::size_t j = 0; j < row.size(); ++j)
      entries.push_back(table.columns()[j].prose ? wrap(joined(row[j]), widths[j])
                                                 : std::vector<std::string>{joined(row[j])});
    append_lines(text, table, widths, entries);
  }
  return text;
}

std::string indented(const std::string &mark, const std::string &text, std::size_t width) {
  std::string result;
  const std::vector<std::string> lines = wrap(joined(text), width - std::min(width, mark.size()));
  for (std::size_t i = 0; i < lines.size(); ++i)
    append_line(result, (i == 0 ? mark : std::string(mark.size(), ' ')) + lines[i]);
  return result;
}

/// Text that must not be read as Markdown. An underscore within a word is harmless.
std::string escaped(std::string_view text) {
  const auto is_word = [&](std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_emphasis = c == '_' && !(i > 0 && is_word(i - 1) && is_word(i + 1));
    if (is_emphasis || std::string_view("\\`*|<").find(c) != std::string_view::npos)
      result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string markdown_table(const Table &table) {
  std::string head = "|";
  std::string rule = "|";
  for (const Column &column : table.columns()) {
    head += ' ' + escaped(one_line(column.header)) + " |";
    rule += column.align == Align::right ? " ---: |" : " --- |";
  }
  std::string text = head + '\n' + rule + '\n';
  for (const auto &row : table.rows()) {
    text += '|';
    for (const std::string &entry : row)
      text += ' ' + escaped(entry) + " |";
    text += '\n';
  }
  return text;
}

} // namespace

void Table::add_row(std::vector<std::string> row) {
  if (row.size() != columns_.size())
    throw std::logic_error(fmt::format("a table of {} columns got a row of {}", columns_.size(), row.size()));
  rows_.push_back(std::move(row));
}

void Table::drop_columns_without(std::string_view empty) {
  for (std::size_t j = columns_.size(); j-- > 1;) {
    const bool none = std::all_of(rows_.begin(), rows_.end(), [&](const auto &row) { return row[j] == empty; });
    if (!none)
      continue;
    columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(j));
    for (auto &row : rows_)
      row.erase(row.begin() + static_cast<std::ptrdiff_t>(j));
  }
}

std::string one_line(std::string header) {
  for (auto place = header.find("-\n"); place != std::string::npos; place = header.find("-\n"))
    header.erase(place, 2);
  return joined(std::move(header));
}

std::size_t display_width(std::string_view text) {
  // Bytes 10xxxxxx continue a code point.
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  std::string line;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty())
      continue;
    if (!line.empty() && display_width(line) + 1 + display_width(word) > width) {
      lines.push_back(std::move(line));
      line.clear();
    }
    if (!line.empty())
      line += ' ';
    line += word;
  }
  if (!line.empty() || lines.empty())
    lines.push_back(std::move(line));
  return lines;
}

std::string render_text(const Document &document, std::size_t width) {
  std::string text;
  for (const Block &block : document) {
    if (!text.empty())
      text += '\n';
    text += std::visit(Overloaded{[&](const Heading &heading) {
                                    const char rule = heading.level == 1 ? '=' : heading.level == 2 ? '-' : 0;
                                    const std::string line = joined(heading.text) + '\n';
                                    return rule ? line + std::string(display_width(heading.text), rule) + '\n' : line;
                                  },
                                  [&](const Paragraph &paragraph) { return indented("", paragraph.text, width); },
                                  [&](const Alarm &alarm) { return indented("*** ", alarm.text, width); },
                                  [&](const Bullets &bullets) {
                                    std::string all;
                                    for (const std::string &item : bullets.items)
                                      all += indented("- ", item, width);
                                    return all;
                                  },
                                  [&](const Notes &notes) {
                                    std::string all;
                                    int number = notes.first;
                                    for (const std::string &item : notes.items)
                                      all += indented(fmt::format("[{}] ", number++), item, width);
                                    return all;
                                  },
                                  [&](const Table &table) { return text_table(table, width); }},
                       block);
  }
  return text;
}

std::string render_markdown(const Document &document) {
  std::string text;
  for (const Block &block : document) {
    if (!text.empty())
      text += '\n';
    text += std::visit(Overloaded{[](const Heading &heading) {
                                    return std::string(static_cast<std::size_t>(heading.level), '#') + ' ' +
                                           escaped(heading.text) + '\n';
                                  },
                                  [](const Paragraph &paragraph) { return escaped(paragraph.text) + '\n'; },
                                  [](const Alarm &alarm) { return "**" + escaped(alarm.text) + "**\n"; },
                                  [](const Bullets &bullets) {
                                    std::string all;
                                    for (const std::string &item : bullets.items)
                                      all += "- " + escaped(item) + '\n';
                                    return all;
                                  },
                                  [](const Notes &notes) {
                                    std::string all;
                                    int number = notes.first;
                                    for (const std::string &item : notes.items)
                                      all += fmt::format("- \\[{}\\] {}\n", number++, escaped(item));
                                    return all;
                                  },
                                  [](const Table &table) { return markdown_table(table); }},
                       block);
  }
  return text;
}

} // namespace comparisons::reports
