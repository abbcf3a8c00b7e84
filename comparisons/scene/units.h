#pragma once

#include "comparisons/scene/declaration.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace comparisons::scene {

/// A number with its unit taken in: value in SI.
struct Quantity {
  double value = 0;
  Dimension dimension;
  bool has_unit = false;
};

/// Why a text is no quantity, and what to write instead.
struct QuantityError {
  std::string message;
  std::string suggestion;
};

/// Reads "226.9 GPa", "7850 kg/m^3", "1 kN m^-1", "4.18 J/(g K)", "0.33".
/// Units: m g t s min h N Pa bar psi J W Hz K in ft, %, rad, deg; SI prefixes from f to P; products
/// by space, '*' or a middle dot, quotients by '/', powers by '^', a digit or a superscript.
/// Decimal prefixes cost no rounding: "226.9 GPa" is exactly 226.9e9.
std::variant<Quantity, QuantityError> parse_quantity(std::string_view text);

/// Reads "4 GiB", "500 MB", "1048576" (bytes). Fractions are allowed as long as a byte is left.
std::variant<std::int64_t, QuantityError> parse_bytes(std::string_view text);

/// "pressure", "length", ... ; "quantity" if the dimension has no usual name.
std::string dimension_name(const Dimension &dimension);

/// The SI unit: "Pa", "m", "kg/m^3"; empty for a plain number.
std::string unit_text(const Dimension &dimension);

/// A value in SI with the unit that reads best: "226.9 GPa", "5 mm"; a plain number without
/// dimension. parse_quantity gives the same value again, bit for bit.
std::string quantity_text(double value, const Dimension &dimension);

} // namespace comparisons::scene
