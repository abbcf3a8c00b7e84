#include "comparisons/scene/unit_table.h"

#include <array>
#include <cstdlib>
#include <utility>

namespace comparisons::scene {

namespace {

struct Unit {
  std::string_view symbol;
  double numerator;
  double denominator;
  int exponent10;
  Dimension dimension;
  bool takes_prefix;
};

// The order decides between equally near suggestions.
constexpr std::array units{
    Unit{"Pa", 1, 1, 0, {.mass = 1, .length = -1, .time = -2}, true},
    Unit{"m", 1, 1, 0, {.length = 1}, true},
    Unit{"N", 1, 1, 0, {.mass = 1, .length = 1, .time = -2}, true},
    Unit{"g", 1, 1, -3, {.mass = 1}, true},
    Unit{"s", 1, 1, 0, {.time = 1}, true},
    Unit{"K", 1, 1, 0, {.temperature = 1}, true},
    Unit{"J", 1, 1, 0, {.mass = 1, .length = 2, .time = -2}, true},
    Unit{"W", 1, 1, 0, {.mass = 1, .length = 2, .time = -3}, true},
    Unit{"Hz", 1, 1, 0, {.time = -1}, true},
    Unit{"t", 1, 1, 3, {.mass = 1}, true}, // tonne
    Unit{"bar", 1, 1, 5, {.mass = 1, .length = -1, .time = -2}, true},
    Unit{"min", 6, 1, 1, {.time = 1}, false},
    Unit{"h", 36, 1, 2, {.time = 1}, false},
    Unit{"in", 127, 5000, 0, {.length = 1}, false},
    Unit{"ft", 381, 1250, 0, {.length = 1}, false},
    // 0.45359237 kg * 9.80665 m/s^2 / (0.0254 m)^2
    Unit{"psi", 6894.757293168361, 1, 0, {.mass = 1, .length = -1, .time = -2}, false},
    Unit{"%", 1, 1, -2, {}, false},
    Unit{"rad", 1, 1, 0, {}, false},
    Unit{"deg", 0.017453292519943295, 1, 0, {}, false},
};

struct Prefix {
  std::string_view symbol;
  int exponent10;
};

constexpr std::array prefixes{
    Prefix{"k", 3},   Prefix{"M", 6},   Prefix{"G", 9},  Prefix{"m", -3}, Prefix{"c", -2},
    Prefix{"d", -1},  Prefix{"h", 2},   Prefix{"da", 1}, Prefix{"u", -6}, Prefix{"n", -9},
    Prefix{"p", -12}, Prefix{"f", -15}, Prefix{"T", 12}, Prefix{"P", 15},
};

} // namespace

std::optional<Factor> find_unit(std::string_view symbol) {
  const auto factor = [](const Unit &unit, int prefix) {
    return Factor{unit.numerator, unit.denominator, unit.exponent10 + prefix, unit.dimension};
  };
  for (const auto &unit : units)
    if (unit.symbol == symbol)
      return factor(unit, 0);
  for (const auto &prefix : prefixes)
    for (const auto &unit : units)
      if (unit.takes_prefix && symbol.size() == prefix.symbol.size() + unit.symbol.size() &&
          symbol.starts_with(prefix.symbol) && symbol.ends_with(unit.symbol))
        return factor(unit, prefix.exponent10);
  return std::nullopt;
}

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const auto &unit : units)
    names.emplace_back(unit.symbol);
  for (const auto &prefix : prefixes)
    for (const auto &unit : units)
      if (unit.takes_prefix)
        names.push_back(std::string(prefix.symbol) + std::string(unit.symbol));
  return names;
}

Factor power(const Factor &factor, int exponent) {
  const int n = std::abs(exponent);
  Factor result;
  for (int i = 0; i < n; ++i) {
    result.numerator *= factor.numerator;
    result.denominator *= factor.denominator;
  }
  if (exponent < 0)
    std::swap(result.numerator, result.denominator);
  result.exponent10 = factor.exponent10 * exponent;
  result.dimension = {factor.dimension.mass * exponent, factor.dimension.length * exponent,
                      factor.dimension.time * exponent, factor.dimension.temperature * exponent};
  return result;
}

Factor product(const Factor &a, const Factor &b) {
  return {a.numerator * b.numerator,
          a.denominator * b.denominator,
          a.exponent10 + b.exponent10,
          {a.dimension.mass + b.dimension.mass, a.dimension.length + b.dimension.length,
           a.dimension.time + b.dimension.time, a.dimension.temperature + b.dimension.temperature}};
}

} // namespace comparisons::scene
