#include "comparisons/scene/units.h"

#include "comparisons/scene/diagnostics.h"
#include "comparisons/scene/unit_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace comparisons::scene {

namespace {

/// Longer texts are refused before they are read; no unit comes near this.
constexpr std::size_t longest_text = 200;

/// Typographic signs in the plain characters of the grammar: a middle dot as '*', superscripts as
/// '^' and digits, a micro sign as 'u', special spaces as ' '.
std::string plain(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> signs{{{"\xC2\xB5", "u"},
                                                                                {"\xCE\xBC", "u"},
                                                                                {"\xC2\xB7", "*"},
                                                                                {"\xE2\x8B\x85", "*"},
                                                                                {"\xC2\xA0", " "},
                                                                                {"\xE2\x80\x89", " "},
                                                                                {"\xE2\x80\xAF", " "},
                                                                                {"\xE2\x88\x92", "-"},
                                                                                {"\xC3\x97", "*"}}};
  constexpr std::array<std::pair<std::string_view, char>, 11> superscripts{{{"\xE2\x81\xB0", '0'},
                                                                            {"\xC2\xB9", '1'},
                                                                            {"\xC2\xB2", '2'},
                                                                            {"\xC2\xB3", '3'},
                                                                            {"\xE2\x81\xB4", '4'},
                                                                            {"\xE2\x81\xB5", '5'},
                                                                            {"\xE2\x81\xB6", '6'},
                                                                            {"\xE2\x81\xB7", '7'},
                                                                            {"\xE2\x81\xB8", '8'},
                                                                            {"\xE2\x81\xB9", '9'},
                                                                            {"\xE2\x81\xBB", '-'}}};
  std::string result;
  bool raised = false;
  while (!text.empty()) {
    const auto starts = [&](const auto &sign) { return text.starts_with(sign.first); };
    if (const auto sign = std::ranges::find_if(signs, starts); sign != signs.end()) {
      result += sign->second;
      text.remove_prefix(sign->first.size());
      raised = false;
    } else if (const auto digit = std::ranges::find_if(superscripts, starts); digit != superscripts.end()) {
      result += raised ? "" : "^";
      result += digit->second;
      text.remove_prefix(digit->first.size());
      raised = true;
    } else {
      result += text.front();
      text.remove_prefix(1);
      raised = false;
    }
  }
  return result;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_symbol(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || static_cast<unsigned char>(c) >= 0x80;
}

/// product := [ '1' ] { ('*' | '/' | ' ') factor };  factor := ( symbol | '(' product ')' ) power
class UnitParser {
public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::optional<Factor> parse() {
    auto result = parse_product();
    if (result && position_ < text_.size())
      return fail(fmt::format("unexpected '{}' in the unit {}", text_[position_], in_quotes(text_)));
    return result;
  }

  const QuantityError &error() const { return error_; }

private:
  char peek() const { return position_ < text_.size() ? text_[position_] : '\0'; }

  void skip_spaces() {
    while (peek() == ' ' || peek() == '\t')
      ++position_;
  }

  std::nullopt_t fail(std::string message, std::string suggestion = {}) {
    if (error_.message.empty())
      error_ = {std::move(message), std::move(suggestion)};
    return std::nullopt;
  }

  std::optional<Factor> parse_product() {
    Factor result;
    bool divided = false;
    skip_spaces();
    if (peek() == '1' && !is_digit(text_.size() > position_ + 1 ? text_[position_ + 1] : ' ')) {
      ++position_; // "1/s"
      skip_spaces();
    }
    for (bool first = true;; first = false) {
      skip_spaces();
      if (peek() == '\0' || peek() == ')')
        return first ? fail(fmt::format("a unit is missing in {}", in_quotes(text_))) : std::optional(result);
      const bool divide = peek() == '/';
      if (divide || (peek() == '*' && !first)) {
        ++position_;
        skip_spaces();
      }
      if (divided && !divide)
        return fail(fmt::format("the unit {} is ambiguous after its '/'", in_quotes(text_)),
                    "write parentheses or powers: \"J/(kg K)\" or \"J kg^-1 K^-1\"");
      divided = divided || divide;
      const auto factor = parse_factor();
      if (!factor)
        return std::nullopt;
      result = product(result, divide ? power(*factor, -1) : *factor);
    }
  }

  std::optional<Factor> parse_factor() {
    std::optional<Factor> base;
    if (peek() == '(') {
      ++position_;
      base = parse_product();
      if (base && peek() != ')')
        return fail(fmt::format("a ')' is missing in the unit {}", in_quotes(text_)));
      ++position_;
    } else {
      base = parse_symbol();
    }
    if (!base)
      return std::nullopt;
    const auto exponent = parse_exponent();
    return exponent ? std::optional(power(*base, *exponent)) : std::nullopt;
  }

  std::optional<Factor> parse_symbol() {
    const std::size_t begin = position_;
    while (is_symbol(peek()))
      ++position_;
    const std::string symbol(text_.substr(begin, position_ - begin));
    if (symbol.empty())
      return fail(fmt::format("a unit is missing in {}", in_quotes(text_)));
    if (auto unit = find_unit(symbol))
      return unit;
    if (symbol == "\xC2\xB0"
                  "C" ||
        symbol == "degC" || symbol == "C")
      return fail("temperatures are in kelvin", "write for example \"300 K\"");
    return fail(fmt::format("unknown unit {}", in_quotes(symbol)), did_you_mean(symbol, unit_names()));
  }

  /// "^-2", "^2", "2", "-2" or nothing (1).
  std::optional<int> parse_exponent() {
    const bool caret = peek() == '^';
    const std::size_t begin = position_ + (caret ? 1 : 0);
    std::size_t end = begin;
    if (end < text_.size() && (text_[end] == '-' || (caret && text_[end] == '+')))
      ++end;
    const std::size_t digits = end;
    while (end < text_.size() && is_digit(text_[end]))
      ++end;
    if (end == digits && !caret)
      return 1;
    const bool single = end == digits + 1;
    const bool fraction = end < text_.size() && text_[end] == '.';
    if (!single || fraction)
      return fail(fmt::format("the power in the unit {} is not a whole number from -9 to 9", in_quotes(text_)));
    position_ = end;
    const int value = text_[digits] - '0';
    return text_[begin] == '-' ? -value : value;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  QuantityError error_;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

/// The digits of a number, its decimal exponent, and what follows it.
struct SplitNumber {
  std::string digits;
  int exponent10 = 0;
  std::string_view rest;
};

std::optional<SplitNumber> split_number(std::string_view text) {
  std::size_t end = 0;
  std::size_t n_digits = 0;
  const auto at = [&](std::size_t i) { return i < text.size() ? text[i] : '\0'; };
  if (at(end) == '+' || at(end) == '-')
    ++end;
  const auto take_digits = [&] {
    for (; is_digit(at(end)); ++end)
      ++n_digits;
  };
  take_digits();
  if (at(end) == '.') {
    ++end;
    take_digits();
  }
  if (n_digits == 0)
    return std::nullopt;
  SplitNumber result{std::string(text.substr(text[0] == '+' ? 1 : 0, end - (text[0] == '+'))), 0, {}};
  if (at(end) == 'e' || at(end) == 'E') {
    const std::size_t sign = end + 1;
    const std::size_t first = sign + (at(sign) == '+' || at(sign) == '-' ? 1 : 0);
    std::size_t last = first;
    while (is_digit(at(last)))
      ++last;
    if (last > first) {
      // Exponents beyond this overflow anyway; the cut keeps the integer in range.
      const std::string exponent(text.substr(first, std::min<std::size_t>(last - first, 6)));
      result.exponent10 = (at(sign) == '-' ? -1 : 1) * std::stoi(exponent);
      end = last;
    }
  }
  result.rest = text.substr(end);
  return result;
}

/// digits * 10^exponent10, correctly rounded; nothing if a double does not hold it.
std::optional<double> assemble(const SplitNumber &number, int exponent10) {
  const std::string text = fmt::format("{}e{}", number.digits, number.exponent10 + exponent10);
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

QuantityError no_number(std::string_view text) {
  return {fmt::format("{} does not begin with a finite number", in_quotes(text)),
          "write a number and a unit, for example \"226.9 GPa\""};
}

} // namespace

std::variant<Quantity, QuantityError> parse_quantity(std::string_view text) {
  if (text.size() > longest_text)
    return QuantityError{fmt::format("{} is too long for a number with a unit", in_quotes(text)), {}};
  const std::string plain_text = plain(text);
  const std::string_view whole = trimmed(plain_text);
  const auto number = split_number(whole);
  if (!number)
    return no_number(text);
  const QuantityError overflow{fmt::format("{} is beyond the range of numbers", in_quotes(text)), {}};
  const std::string_view unit = trimmed(number->rest);
  if (unit.empty()) {
    const auto value = assemble(*number, 0);
    if (!value)
      return overflow;
    return Quantity{*value, {}, false};
  }
  if (unit.front() == ',')
    return QuantityError{fmt::format("{} has a comma in its number", in_quotes(text)), "the decimal sign is a point"};
  UnitParser parser(unit);
  const auto factor = parser.parse();
  if (!factor)
    return parser.error();
  const auto value = assemble(*number, factor->exponent10);
  if (!value)
    return overflow;
  const double scaled = *value * factor->numerator / factor->denominator;
  if (!std::isfinite(scaled))
    return overflow;
  return Quantity{scaled, factor->dimension, true};
}

std::variant<std::int64_t, QuantityError> parse_bytes(std::string_view text) {
  struct Size {
    std::string_view symbol;
    double bytes;
  };
  constexpr std::array sizes{Size{"GiB", 1073741824.0},
                             Size{"MiB", 1048576.0},
                             Size{"KiB", 1024.0},
                             Size{"TiB", 1099511627776.0},
                             Size{"GB", 1e9},
                             Size{"MB", 1e6},
                             Size{"kB", 1e3},
                             Size{"TB", 1e12},
                             Size{"B", 1.0}};
  if (text.size() > longest_text)
    return QuantityError{fmt::format("{} is too long for an amount of memory", in_quotes(text)), {}};
  const std::string_view whole = trimmed(text);
  const auto number = split_number(whole);
  const auto value = number ? assemble(*number, 0) : std::nullopt;
  if (!value)
    return QuantityError{fmt::format("{} is not an amount of memory", in_quotes(text)), "write for example \"4 GiB\""};
  const std::string unit(trimmed(number->rest));
  double bytes = unit.empty() ? 1.0 : 0.0;
  std::vector<std::string> names;
  for (const auto &size : sizes) {
    names.emplace_back(size.symbol);
    if (size.symbol == unit)
      bytes = size.bytes;
  }
  if (bytes == 0.0)
    return QuantityError{fmt::format("unknown unit {} of memory; allowed: {}", in_quotes(unit), fmt::join(names, ", ")),
                         did_you_mean(unit, names)};
  const double total = *value * bytes;
  if (!(total >= 1.0 && total < 9.0e18))
    return QuantityError{fmt::format("{} must be from 1 byte to 9e18 bytes", in_quotes(text)), {}};
  return static_cast<std::int64_t>(total);
}

} // namespace comparisons::scene
