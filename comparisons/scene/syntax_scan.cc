#include "comparisons/scene/syntax_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace comparisons::scene {

namespace {

/// Keys of a scene have at most three parts.
constexpr int deepest_key = 8;

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::optional<SyntaxFinding> scan() {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.starts_with(byte_order_mark))
      position_ = byte_order_mark.size();
    while (position_ < text_.size() && !finding_)
      step();
    return std::move(finding_);
  }

private:
  char at(std::size_t position) const { return position < text_.size() ? text_[position] : '\0'; }

  void find(std::string message, std::string suggestion) {
    finding_ = {position_, std::move(message), std::move(suggestion)};
  }

  void step() {
    const char c = text_[position_];
    if (c == '"' || c == '\'')
      return skip_string();
    if (c == '#') {
      dots_ = 0;
      position_ = std::min(text_.find('\n', position_), text_.size());
      return;
    }
    if (!is_ascii(c))
      return find("wrong TOML syntax: a character beyond ASCII outside quotes and comments",
                  "names and texts with such characters are written in quotes");
    const bool in_key =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == ' ' || c == '\t' || c == '.';
    dots_ = !in_key ? 0 : dots_ + (c == '.' ? 1 : 0);
    if (dots_ > deepest_key)
      return find(fmt::format("a key of more than {} parts", deepest_key), {});
    ++position_;
  }

  /// Moves behind the string that begins here, of any of the four kinds.
  void skip_string() {
    const char quote = text_[position_];
    const std::string three(3, quote);
    const bool multi_line = text_.substr(position_, 3) == three;
    position_ += multi_line ? 3 : 1;
    while (position_ < text_.size() && !finding_) {
      const char c = text_[position_];
      if (quote == '"' && c == '\\') {
        skip_escape(multi_line);
      } else if (multi_line && text_.substr(position_, 3) == three) {
        position_ += 3;
        return;
      } else {
        ++position_;
        if (!multi_line && (c == quote || c == '\n'))
          return;
      }
    }
  }

  /// An escape; in a text of several lines also a backslash that joins lines.
  void skip_escape(bool multi_line) {
    ++position_;
    const bool joins_lines = multi_line && is_space(at(position_));
    while (joins_lines && is_space(at(position_)))
      ++position_;
    if (!is_ascii(at(position_)))
      return find("a character beyond ASCII directly behind a backslash", "put another character between them");
    if (!joins_lines && at(position_) != '\n')
      ++position_;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  int dots_ = 0;
  std::optional<SyntaxFinding> finding_;
};

} // namespace

std::optional<SyntaxFinding> scan_syntax(std::string_view text) { return Scanner(text).scan(); }

} // namespace comparisons::scene
