#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace comparisons::reports {

namespace {

bool is_number(const std::optional<double> &value) { return value && std::isfinite(*value); }

} // namespace

std::string scientific(std::optional<double> value) {
  return is_number(value) ? fmt::format("{:.3e}", *value) : no_number;
}

std::string logarithm(std::optional<double> value) {
  return is_number(value) ? fmt::format("{:.4f}", *value) : no_number;
}

std::string rate(std::optional<double> value) { return is_number(value) ? fmt::format("{:.2f}", *value) : no_number; }

std::string seconds(std::optional<double> value) {
  return is_number(value) ? fmt::format("{:.3g}", *value) : no_number;
}

std::string percent(std::optional<double> value) {
  return is_number(value) ? fmt::format("{:.1f}", 100 * *value) : no_number;
}

std::string megabytes(std::int64_t bytes) {
  return bytes > 0 ? fmt::format("{:.1f}", static_cast<double>(bytes) / 1e6) : no_number;
}

std::string significant(std::optional<double> value) {
  return is_number(value) ? fmt::format("{:.4g}", *value) : no_number;
}

std::string exact(std::optional<double> value) { return is_number(value) ? fmt::format("{}", *value) : no_number; }

std::string by_name(std::string_view name, std::optional<double> value) {
  if (name.find("log10") != std::string_view::npos)
    return logarithm(value);
  const bool is_error = name.ends_with("_relative") || name.find("error") != std::string_view::npos;
  return is_error ? scientific(value) : significant(value);
}

} // namespace comparisons::reports
