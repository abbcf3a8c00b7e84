#pragma once

#include "comparisons/scene/declaration.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons::scene {

/// numerator * 10^exponent10 / denominator times the base units. Decimal powers stay apart, so
/// that they can be joined with the digits of the number without rounding.
struct Factor {
  double numerator = 1;
  double denominator = 1;
  int exponent10 = 0;
  Dimension dimension;
};

/// The factor of a unit with or without a prefix: "GPa", "mm", "min".
std::optional<Factor> find_unit(std::string_view symbol);

/// Every unit with every prefix that it takes, for suggestions.
std::vector<std::string> unit_names();

Factor power(const Factor &factor, int exponent);
Factor product(const Factor &a, const Factor &b);

} // namespace comparisons::scene
