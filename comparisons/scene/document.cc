#include "comparisons/scene/document.h"

#include "comparisons/scene/syntax_scan.h"
#include "comparisons/scene/toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace comparisons::scene {

namespace {

/// Values in one file. A scene at the limit of 100 000 cells needs fewer.
constexpr std::size_t most_values = 400000;

Location place(std::string_view text, std::size_t position, const std::string &file) {
  Location location{file, 1, 1};
  for (std::size_t i = 0; i < position && i < text.size(); ++i) {
    if (text[i] == '\n') {
      ++location.line;
      location.column = 1;
    } else if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) {
      ++location.column;
    }
  }
  return location;
}

/// Converts the parser's tree, up to `most_values` values.
class Converter {
public:
  explicit Converter(std::string file) : file_(std::move(file)) {}

  bool overflowed() const { return n_values_ > most_values; }

  Node convert(const toml::node &source) {
    Node node;
    node.location = location(source.source());
    if (++n_values_ > most_values)
      return node;
    if (const auto *table = source.as_table()) {
      node.kind = Node::Kind::table;
      for (const auto &[key, value] : *table)
        node.entries.push_back({std::string(key.str()), location(key.source()), convert(value)});
      // The parser sorts by name; the order of the file decides the order of combinations.
      std::ranges::stable_sort(node.entries, {}, [](const Entry &entry) {
        return std::pair(entry.key_location.line, entry.key_location.column);
      });
    } else if (const auto *array = source.as_array()) {
      node.kind = Node::Kind::array;
      for (const auto &item : *array) {
        if (overflowed())
          break;
        node.items.push_back(convert(item));
      }
    } else {
      convert_scalar(source, node);
    }
    return node;
  }

private:
  Location location(const toml::source_region &region) const { return {file_, region.begin.line, region.begin.column}; }

  static void convert_scalar(const toml::node &source, Node &node) {
    if (const auto *boolean = source.as_boolean()) {
      node.kind = Node::Kind::boolean;
      node.boolean = boolean->get();
    } else if (const auto *integer = source.as_integer()) {
      node.kind = Node::Kind::integer;
      node.integer = integer->get();
    } else if (const auto *real = source.as_floating_point()) {
      node.kind = Node::Kind::real;
      node.real = real->get();
    } else if (const auto *text = source.as_string()) {
      node.kind = Node::Kind::text;
      node.text = text->get();
    } else {
      node.kind = Node::Kind::date;
    }
  }

  std::string file_;
  std::size_t n_values_ = 0;
};

std::string_view line_of(std::string_view text, unsigned line) {
  for (unsigned i = 1; i < line && !text.empty(); ++i) {
    const auto end = text.find('\n');
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return text.substr(0, text.find_first_of("\r\n"));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The usual slips in a line that does not parse.
std::string suggest_syntax(std::string_view line, std::string_view description) {
  if (description.find("redefine") != std::string_view::npos)
    return "a key stands once in its table";
  constexpr std::size_t longest = 100;
  const auto equals = line.find('=');
  if (line.size() > longest)
    return {};
  if (equals == std::string_view::npos)
    return trimmed(line).starts_with('[') ? "a table is written [name], a list of tables [[name]]"
                                          : "a key is written name = value";
  const std::string_view key = trimmed(line.substr(0, equals));
  std::string_view value = line.substr(equals + 1);
  value = trimmed(value.substr(0, value.find('#')));
  if (value.empty())
    return "a value is missing after '='";
  if (value.find_first_of("\"'[]{}=") != std::string_view::npos || parse_value(value, {}))
    return {};
  if (value.find(',') != std::string_view::npos)
    return fmt::format("a list is written in brackets: {} = [{}]", key, value);
  return fmt::format("texts, and numbers with a unit, are written in quotes: {} = \"{}\"", key, value);
}

} // namespace

const Entry *Node::find(std::string_view key) const {
  const auto found = std::ranges::find_if(entries, [&](const Entry &e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

Entry *Node::find(std::string_view key) { return const_cast<Entry *>(std::as_const(*this).find(key)); }

std::string describe(const Node &node) {
  switch (node.kind) {
  case Node::Kind::boolean:
    return node.boolean ? "true" : "false";
  case Node::Kind::integer:
    return fmt::format("the whole number {}", node.integer);
  case Node::Kind::real:
    // "2.0" shows why it is no whole number.
    return std::isfinite(node.real) && node.real == std::trunc(node.real) && std::abs(node.real) < 1e6
               ? fmt::format("the number {:.1f}", node.real)
               : fmt::format("the number {}", node.real);
  case Node::Kind::text:
    return "the text " + in_quotes(node.text);
  case Node::Kind::date:
    return "a date or time";
  case Node::Kind::array:
    return node.items.empty() ? "an empty list" : "a list";
  case Node::Kind::table:
    return "a table";
  }
  return "a value";
}

namespace {

/// '?' in place of every character beyond ASCII: the same syntax in the same columns. When the parser has met an error
/// it reads on to the end of the word, over quotes too, and its tests of characters (toml++ 3.3) are undefined for some
/// beyond ASCII; so a text is parsed as it stands only after its shadow was right.
std::string ascii_shadow(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string shadow;
  if (text.starts_with(byte_order_mark))
    shadow = byte_order_mark;
  for (const char c : text.substr(shadow.size())) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
      shadow += c;
    else if (byte >= 0xC0) // the first byte of a character
      shadow += '?';
  }
  return shadow;
}

toml::parse_result parse_text(std::string_view text, std::string_view file) {
  if (std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
    if (auto shadow = toml::parse(std::string_view(ascii_shadow(text)), file); !shadow)
      return shadow;
  return toml::parse(text, file);
}

} // namespace

std::optional<Node> parse_document(std::string_view text, const std::string &file, Diagnostics &diagnostics) {
  std::size_t position = 0;
  if (!is_plain_utf8(text, position)) {
    diagnostics.error(place(text, position, file), {},
                      text[position] == '\0' ? "the file holds a zero byte; a scene is plain text"
                                             : "the text is not UTF-8",
                      "save the file as UTF-8 text");
    return std::nullopt;
  }
  if (const auto finding = scan_syntax(text)) {
    diagnostics.error(place(text, finding->position, file), {}, finding->message, finding->suggestion);
    return std::nullopt;
  }
  const auto result = parse_text(text, file);
  if (!result) {
    const auto begin = result.error().source().begin;
    diagnostics.error({file, begin.line, begin.column}, {},
                      fmt::format("wrong TOML syntax: {}", result.error().description()),
                      suggest_syntax(line_of(text, begin.line), result.error().description()));
    return std::nullopt;
  }
  Converter converter(file);
  Node root = converter.convert(result.table());
  if (converter.overflowed()) {
    diagnostics.error({.file = file}, {}, fmt::format("more than {} values; this is no scene", most_values));
    return std::nullopt;
  }
  return root;
}

std::optional<Node> parse_value(std::string_view text, const Location &location) {
  const std::string line = fmt::format("value = {}", text);
  if (scan_syntax(line))
    return std::nullopt;
  const auto result = parse_text(line, {});
  if (!result || result.table().size() != 1)
    return std::nullopt;
  Converter converter({});
  Node root = converter.convert(result.table());
  if (converter.overflowed())
    return std::nullopt;
  const auto move_to = [&](const auto &self, Node &node) -> void {
    node.location = location;
    for (Node &item : node.items)
      self(self, item);
    for (Entry &entry : node.entries) {
      entry.key_location = location;
      self(self, entry.value);
    }
  };
  move_to(move_to, root.entries.front().value);
  return std::move(root.entries.front().value);
}

} // namespace comparisons::scene
