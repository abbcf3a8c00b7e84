#include "comparisons/scene/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace comparisons::scene {

namespace {

struct KnownDimension {
  Dimension dimension;
  std::string_view name;
  std::string_view unit;
  /// Units to print a value in, besides `unit`.
  std::array<std::string_view, 3> alternatives;
};

constexpr std::array known_dimensions{
    KnownDimension{{}, "plain number", "", {}},
    KnownDimension{{.length = 1}, "length", "m", {"mm", "km", "um"}},
    KnownDimension{{.time = 1}, "time", "s", {"ms", "us", "ns"}},
    KnownDimension{{.temperature = 1}, "temperature", "K", {}},
    KnownDimension{{.mass = 1}, "mass", "kg", {"g", "t", ""}},
    KnownDimension{{.mass = 1, .length = -1, .time = -2}, "pressure", "Pa", {"GPa", "MPa", "kPa"}},
    KnownDimension{{.length = 1, .time = -1}, "velocity", "m/s", {"km/s", "mm/s", ""}},
    KnownDimension{{.length = 1, .time = -2}, "acceleration", "m/s^2", {}},
    KnownDimension{{.mass = 1, .length = -3}, "density", "kg/m^3", {}},
    KnownDimension{{.mass = 1, .length = 1, .time = -2}, "force", "N", {"kN", "MN", "mN"}},
    KnownDimension{{.mass = 1, .time = -2}, "force per length", "N/m", {"kN/m", "MN/m", ""}},
    KnownDimension{{.mass = 1, .length = -2, .time = -2}, "force per volume", "N/m^3", {}},
    KnownDimension{{.mass = 1, .length = 2, .time = -2}, "energy", "J", {"kJ", "MJ", ""}},
    KnownDimension{{.mass = 1, .length = 2, .time = -3}, "power", "W", {"kW", "MW", ""}},
    KnownDimension{{.length = 2, .time = -2}, "energy per mass", "J/kg", {"kJ/kg", "MJ/kg", ""}},
    KnownDimension{{.time = -1}, "frequency", "Hz", {"kHz", "MHz", ""}},
    KnownDimension{{.length = 2}, "area", "m^2", {"mm^2", "", ""}},
    KnownDimension{{.length = 3}, "volume", "m^3", {"mm^3", "", ""}},
    KnownDimension{{.temperature = -1}, "thermal expansion", "1/K", {}},
    KnownDimension{{.length = 2, .time = -2, .temperature = -1}, "specific heat", "J/(kg K)", {}},
    KnownDimension{{.mass = 1, .length = 1, .time = -3, .temperature = -1}, "heat conductivity", "W/(m K)", {}},
    KnownDimension{{.mass = 1, .length = -1, .time = -1}, "viscosity", "Pa s", {}},
};

const KnownDimension *find(const Dimension &dimension) {
  for (const auto &known : known_dimensions)
    if (known.dimension == dimension)
      return &known;
  return nullptr;
}

/// "number unit" if it reads back as exactly this value.
std::string in_unit(double value, const Dimension &dimension, std::string_view unit) {
  const auto one = parse_quantity(fmt::format("1 {}", unit));
  const double number = value / std::get<Quantity>(one).value;
  // The quotient may be off by a last digit; fifteen digits restore the decimal number meant.
  for (const auto &digits : {fmt::format("{:.15g}", number), fmt::format("{}", number)}) {
    const std::string text = fmt::format("{} {}", digits, unit);
    const auto back = parse_quantity(text);
    const auto *quantity = std::get_if<Quantity>(&back);
    if (quantity != nullptr && quantity->value == value && quantity->dimension == dimension)
      return text;
  }
  return {};
}

} // namespace

std::string dimension_name(const Dimension &dimension) {
  const KnownDimension *known = find(dimension);
  return known != nullptr ? std::string(known->name) : "quantity";
}

std::string unit_text(const Dimension &dimension) {
  if (const KnownDimension *known = find(dimension))
    return std::string(known->unit);
  std::vector<std::string> factors;
  const auto factor = [&](std::string_view unit, int exponent) {
    if (exponent == 1)
      factors.emplace_back(unit);
    else if (exponent != 0)
      factors.push_back(fmt::format("{}^{}", unit, exponent));
  };
  factor("kg", dimension.mass);
  factor("m", dimension.length);
  factor("s", dimension.time);
  factor("K", dimension.temperature);
  return fmt::format("{}", fmt::join(factors, " "));
}

std::string quantity_text(double value, const Dimension &dimension) {
  if (dimension == dimensions::none || !std::isfinite(value))
    return fmt::format("{}", value);
  const std::string unit = unit_text(dimension);
  const std::string in_base = fmt::format("{} {}", value, unit);
  const auto readable = [](double number) { return std::abs(number) >= 1.0 && std::abs(number) < 1000.0; };
  const KnownDimension *known = find(dimension);
  if (value == 0.0 || readable(value) || known == nullptr)
    return in_base;
  for (const auto alternative : known->alternatives) {
    if (alternative.empty())
      continue;
    const auto one = parse_quantity(fmt::format("1 {}", alternative));
    if (!readable(value / std::get<Quantity>(one).value))
      continue;
    if (const std::string text = in_unit(value, dimension, alternative); !text.empty())
      return text;
  }
  return in_base;
}

} // namespace comparisons::scene
