#include "comparisons/scene/expression.h"
#include "comparisons/scene/table_reader.h"
#include "comparisons/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace comparisons::scene {

namespace {

bool contains(const Range &range, double value) {
  const bool above = range.lower_open ? value > range.lower : value >= range.lower;
  const bool below = range.upper_open ? value < range.upper : value <= range.upper;
  return above && below;
}

std::string with_unit(const std::string &number, const Dimension &dimension) {
  const std::string unit = unit_text(dimension);
  return unit.empty() ? number : number + " " + unit;
}

/// Reads the value of one key; every finding names the key and the place.
class ValueReader {
public:
  ValueReader(const Declaration &declaration, const std::string &key, Diagnostics &diagnostics)
      : declaration_(declaration), key_(key), diagnostics_(diagnostics) {}

  std::optional<Value> read(const Node &node) const {
    switch (declaration_.type) {
    case Type::boolean:
      if (node.is(Node::Kind::boolean))
        return Value(node.boolean);
      return wrong_type(node, "true or false", flag_suggestion(node));
    case Type::integer:
      return declaration_.is_bytes && node.is(Node::Kind::text) ? read_bytes(node) : read_integer(node);
    case Type::real:
      if (const auto value = read_real(node))
        return Value(*value);
      return std::nullopt;
    case Type::text:
      if (node.is(Node::Kind::text))
        return Value(node.text);
      return wrong_type(node, "a text in quotes", quote_suggestion(node));
    case Type::choice:
      return read_choice(node);
    case Type::point:
      return read_point(node);
    case Type::expression:
      if (is_word(node))
        return Value(node.text);
      if (auto value = read_expression(node))
        return Value(std::move(*value));
      return std::nullopt;
    case Type::expressions:
      return read_expressions(node);
    }
    return std::nullopt;
  }

private:
  std::nullopt_t fail(const Node &node, std::string message, std::string suggestion = {}) const {
    diagnostics_.error(node.location, key_, std::move(message), std::move(suggestion));
    return std::nullopt;
  }

  std::nullopt_t wrong_type(const Node &node, const std::string &expected, std::string suggestion = {}) const {
    return fail(node, fmt::format("expected {}, found {}", expected, describe(node)), std::move(suggestion));
  }

  static std::string flag_suggestion(const Node &node) {
    if (node.is(Node::Kind::text) && (node.text == "true" || node.text == "false"))
      return "write " + node.text + " without quotes";
    return {};
  }

  static std::string quote_suggestion(const Node &node) {
    if (node.is(Node::Kind::integer))
      return fmt::format("write \"{}\"", node.integer);
    if (node.is(Node::Kind::real))
      return fmt::format("write \"{}\"", node.real);
    return {};
  }

  std::optional<Value> read_integer(const Node &node) const {
    const std::string expected =
        declaration_.is_bytes ? "an amount of memory such as \"4 GiB\", or bytes" : "a whole number";
    if (node.is(Node::Kind::integer))
      return in_range(node, static_cast<double>(node.integer), fmt::format("{}", node.integer))
                 ? std::optional(Value(node.integer))
                 : std::nullopt;
    constexpr double largest = 1e15;
    if (node.is(Node::Kind::real) && std::abs(node.real) < largest && node.real == std::trunc(node.real))
      return wrong_type(node, expected, fmt::format("write {}", static_cast<std::int64_t>(node.real)));
    if (node.is(Node::Kind::text)) {
      const auto quantity = parse_quantity(node.text);
      const auto *number = std::get_if<Quantity>(&quantity);
      if (number != nullptr && !number->has_unit)
        return wrong_type(node, expected, "write it without quotes");
    }
    return wrong_type(node, expected);
  }

  std::optional<Value> read_bytes(const Node &node) const {
    const auto bytes = parse_bytes(node.text);
    if (const auto *error = std::get_if<QuantityError>(&bytes))
      return fail(node, error->message, error->suggestion);
    const auto value = std::get<std::int64_t>(bytes);
    return in_range(node, static_cast<double>(value), in_quotes(node.text)) ? std::optional(Value(value))
                                                                            : std::nullopt;
  }

  std::optional<double> read_real(const Node &node) const {
    if (node.is(Node::Kind::text))
      return read_quantity(node);
    if (!node.is(Node::Kind::integer) && !node.is(Node::Kind::real))
      return wrong_type(node, expected_number());
    const double value = node.is(Node::Kind::integer) ? static_cast<double>(node.integer) : node.real;
    if (!std::isfinite(value))
      return fail(node, fmt::format("{} is not a finite number", value));
    return in_range(node, value, with_unit(fmt::format("{}", value), declaration_.dimension)) ? std::optional(value)
                                                                                              : std::nullopt;
  }

  std::string expected_number() const {
    if (declaration_.dimension == dimensions::none)
      return "a number";
    return fmt::format("a {} (a text such as \"{}\", or a number in SI)", dimension_name(declaration_.dimension),
                       example("1"));
  }

  /// A number with the unit that this key would usually have.
  std::string example(const std::string &number) const {
    return declaration_.dimension == dimensions::pressure ? number + " GPa" : with_unit(number, declaration_.dimension);
  }

  std::optional<double> read_quantity(const Node &node) const {
    const auto result = parse_quantity(node.text);
    if (const auto *error = std::get_if<QuantityError>(&result))
      return fail(node, fmt::format("{}; expected {}", error->message, expected_number()), error->suggestion);
    const auto &quantity = std::get<Quantity>(result);
    const bool dimensional = declaration_.dimension != dimensions::none;
    if (dimensional && !quantity.has_unit)
      return fail(node, fmt::format("{} has no unit", in_quotes(node.text)),
                  unit_suggestion(node.text, quantity.value));
    if (quantity.dimension != declaration_.dimension) {
      const std::string found =
          fmt::format("{} is a {} [{}]", in_quotes(node.text), dimension_name(quantity.dimension),
                      quantity.dimension == dimensions::none ? "-" : unit_text(quantity.dimension));
      return fail(node,
                  dimensional ? fmt::format("{}; expected a {} [{}]", found, dimension_name(declaration_.dimension),
                                            unit_text(declaration_.dimension))
                              : found + "; expected a plain number",
                  dimensional ? fmt::format("write for example \"{}\"", example("1"))
                              : "write the number without a unit");
    }
    return in_range(node, quantity.value, in_quotes(node.text)) ? std::optional(quantity.value) : std::nullopt;
  }

  /// For a pressure that reads like a modulus in GPa the bare number needs its power of ten.
  std::string unit_suggestion(const std::string &text, double value) const {
    constexpr double least_modulus_in_pascal = 1e5;
    const bool giga = declaration_.dimension == dimensions::pressure && std::abs(value) < least_modulus_in_pascal &&
                      text.find_first_of("eE") == std::string::npos;
    if (giga)
      return fmt::format("write \"{0} GPa\" or the bare number {0}e9 in SI", text);
    return fmt::format("write \"{}\" or the bare number {} in SI", with_unit(text, declaration_.dimension), text);
  }

  bool in_range(const Node &node, double value, const std::string &found) const {
    if (contains(declaration_.range, value))
      return true;
    diagnostics_.error(node.location, key_,
                       fmt::format("{} is out of range; it must be {}", found,
                                   range_text(declaration_.range, declaration_.dimension)));
    return false;
  }

  std::optional<Value> read_choice(const Node &node) const {
    const std::string allowed = fmt::format("{}", fmt::join(declaration_.choices, ", "));
    if (!node.is(Node::Kind::text))
      return wrong_type(node, "a text, one of " + allowed);
    if (std::ranges::find(declaration_.choices, node.text) != declaration_.choices.end())
      return Value(node.text);
    return fail(node, fmt::format("unknown {} {}; allowed: {}", declaration_.name, in_quotes(node.text), allowed),
                did_you_mean(node.text, declaration_.choices));
  }

  std::optional<Value> read_point(const Node &node) const {
    if (!node.is(Node::Kind::array) || node.items.size() != 2)
      return wrong_type(node, "a point of two numbers [x, y]");
    const auto x = read_real(node.items[0]);
    const auto y = read_real(node.items[1]);
    return x && y ? std::optional(Value(Point{*x, *y})) : std::nullopt;
  }

  /// One of the words that may stand in place of an expression.
  bool is_word(const Node &node) const {
    return node.is(Node::Kind::text) &&
           std::ranges::find(declaration_.choices, node.text) != declaration_.choices.end();
  }

  /// True for "2 MPaa": more likely a quantity with a slip than an expression.
  static bool looks_like_quantity(const std::string &text) {
    const auto end = text.find_first_not_of("+-0123456789.eE_ ");
    return end != std::string::npos && end > 0 && text.find_first_of("0123456789") < end &&
           text.find_first_of("*()xy") == std::string::npos;
  }

  /// The text in SI of a number, a quantity, or an expression that parses.
  std::optional<std::string> read_expression(const Node &node) const {
    if (!node.is(Node::Kind::text)) {
      const auto value = read_real(node);
      return value ? std::optional(fmt::format("{}", *value)) : std::nullopt;
    }
    const auto result = parse_quantity(node.text);
    if (const auto *quantity = std::get_if<Quantity>(&result); quantity != nullptr && !quantity->has_unit)
      return fmt::format("{}", quantity->value);
    if (std::holds_alternative<Quantity>(result) || looks_like_quantity(node.text)) {
      const auto value = read_quantity(node);
      return value ? std::optional(fmt::format("{}", *value)) : std::nullopt;
    }
    try {
      const Expression expression(node.text, 2);
    } catch (const std::invalid_argument &error) {
      fail(node, error.what(), "an expression is of x and y in SI, such as \"1e6*y*(1-y)\"; a constant has its unit");
      return std::nullopt;
    }
    return node.text;
  }

  std::optional<Value> read_expressions(const Node &node) const {
    if (is_word(node))
      return Value(node.text);
    if (!node.is(Node::Kind::array) || node.items.size() != 2)
      return wrong_type(node, "a list of two components", "for example [\"0\", \"-2e6*y\"]");
    const auto first = read_expression(node.items[0]);
    const auto second = read_expression(node.items[1]);
    return first && second ? std::optional(Value(*first + "; " + *second)) : std::nullopt;
  }

  const Declaration &declaration_;
  const std::string &key_;
  Diagnostics &diagnostics_;
};

} // namespace

std::string range_text(const Range &range, const Dimension &dimension) {
  const bool has_lower = std::isfinite(range.lower);
  const bool has_upper = std::isfinite(range.upper);
  const auto bound = [&](double value) {
    return value == 0.0 ? std::string("0") : with_unit(fmt::format("{}", value), dimension);
  };
  if (has_lower && has_upper && !range.lower_open && !range.upper_open)
    return fmt::format("from {} to {}", bound(range.lower), bound(range.upper));
  if (has_lower && has_upper)
    return fmt::format("in {}{}, {}{}", range.lower_open ? "(" : "[", bound(range.lower), bound(range.upper),
                       range.upper_open ? ")" : "]");
  if (has_lower)
    return fmt::format("{} {}", range.lower_open ? "greater than" : "at least", bound(range.lower));
  if (has_upper)
    return fmt::format("{} {}", range.upper_open ? "less than" : "at most", bound(range.upper));
  return "any number";
}

std::optional<Value> read_value(const Node &node, const Declaration &declaration, const std::string &key,
                                Diagnostics &diagnostics) {
  return ValueReader(declaration, key, diagnostics).read(node);
}

} // namespace comparisons::scene
