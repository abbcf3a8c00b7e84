#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace comparisons::reports {

/// What a table shows where there is no number.
inline constexpr const char *no_number = "-";

// Numbers for people. Every one is a rounding of the value in results.json; not finite gives no_number.

/// Error norms and unknown quantities: three decimals, scientific ("1.043e-02").
std::string scientific(std::optional<double> value);
/// Decimal logarithms: four decimals ("-2.0170").
std::string logarithm(std::optional<double> value);
/// Observed rates: two decimals.
std::string rate(std::optional<double> value);
/// Seconds: three significant digits ("0.0123").
std::string seconds(std::optional<double> value);
/// A part of one in per cent: one decimal.
std::string percent(std::optional<double> value);
/// Bytes in 10^6 bytes; 0 means not measured.
std::string megabytes(std::int64_t bytes);
/// Four significant digits, whatever the size ("3.002", "0.1951", "1.2e-07").
std::string significant(std::optional<double> value);
/// As few digits as read back the same value.
std::string exact(std::optional<double> value);

/// The format that fits an error or quantity of this name.
std::string by_name(std::string_view name, std::optional<double> value);

} // namespace comparisons::reports
