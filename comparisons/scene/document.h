#pragma once

#include "comparisons/scene/diagnostics.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons::scene {

struct Entry;

/// A TOML value with its place, free of the parser's types. Entries keep the order of the file.
struct Node {
  enum class Kind { boolean, integer, real, text, date, array, table };

  Kind kind = Kind::table;
  Location location;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;
  std::vector<Node> items;
  std::vector<Entry> entries;

  const Entry *find(std::string_view key) const;
  Entry *find(std::string_view key);
  bool is(Kind wanted) const { return kind == wanted; }
};

struct Entry {
  std::string key;
  Location key_location;
  Node value;
};

/// What was found, for messages: "the text 'abc'", "the number 2.5", "a list".
std::string describe(const Node &node);

/// The bytes of a scene file. A missing file, a directory, an unreadable file and one of more than
/// 16 MiB are errors.
std::optional<std::string> read_file(const std::filesystem::path &file, Diagnostics &diagnostics);

/// Parses a TOML text. Text that is not UTF-8, zero bytes, keys nested too deep and wrong syntax
/// are errors; the first one ends the parse.
std::optional<Node> parse_document(std::string_view text, const std::string &file, Diagnostics &diagnostics);

/// One TOML value such as `0.3` or `["16x4"]`, placed at `location`; nothing if the text is none.
std::optional<Node> parse_value(std::string_view text, const Location &location);

/// True if the bytes are valid UTF-8 without zero bytes; else `position` is the first bad byte.
bool is_plain_utf8(std::string_view text, std::size_t &position);

} // namespace comparisons::scene
