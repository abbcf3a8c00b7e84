#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace comparisons::reports {

enum class Align { left, right };

struct Column {
  std::string header; ///< lines separated by '\n', "-\n" within a word
  Align align = Align::right;
  /// A column of prose: broken between words when the table is too wide for the terminal.
  bool prose = false;
};

/// A table of texts. Every row has one entry a column.
class Table {
public:
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  void add_row(std::vector<std::string> row);
  /// Takes out the columns (other than the first) in which every entry is `empty`.
  void drop_columns_without(std::string_view empty);

  const std::vector<Column> &columns() const { return columns_; }
  const std::vector<std::vector<std::string>> &rows() const { return rows_; }

private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

struct Heading {
  int level = 1; ///< 1 is the title
  std::string text;
};
struct Paragraph {
  std::string text;
};
/// A paragraph that must not be overlooked.
struct Alarm {
  std::string text;
};
struct Bullets {
  std::vector<std::string> items;
};
/// Remarks with their numbers, as tables refer to them.
struct Notes {
  int first = 1;
  std::vector<std::string> items;
};

using Block = std::variant<Heading, Paragraph, Alarm, Bullets, Notes, Table>;

/// A report before it is text or Markdown; both say the same.
using Document = std::vector<Block>;

/// For the terminal: aligned columns, lines of at most `width` characters where the words allow it.
std::string render_text(const Document &document, std::size_t width = 120);
/// GitHub's Markdown.
std::string render_markdown(const Document &document);

/// A header on one line.
std::string one_line(std::string header);
/// Characters that a terminal shows (UTF-8, one column a code point).
std::size_t display_width(std::string_view text);
/// Lines of at most `width` characters, broken at spaces; a longer word keeps a line of its own.
std::vector<std::string> wrap(std::string_view text, std::size_t width);

} // namespace comparisons::reports
