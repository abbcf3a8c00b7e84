#include "comparisons/reports/theory.h"

#include <array>
#include <utility>

namespace comparisons::reports {

namespace {

/// Which derivative of the solution an error measures, by the first words of its name.
std::optional<int> derivative_of(std::string_view error) {
  constexpr std::array<std::pair<std::string_view, int>, 8> beginnings{
      {{"displacement", 0}, {"u1_", 0}, {"u2_", 0}, {"stress_l2", 1}, {"energy", 1}, {"l2", 0}, {"h1", 1}, {"h2", 2}}};
  for (const auto &[beginning, derivative] : beginnings)
    if (error.starts_with(beginning))
      return derivative;
  return std::nullopt;
}

std::optional<int> degree_of(const Cell &cell) {
  const auto found = cell.parameters.find("element");
  if (found == cell.parameters.end() || !found->is_string())
    return std::nullopt;
  const std::string element = found->get<std::string>();
  const int degree = element.empty() ? 0 : element.back() - '0';
  return degree >= 1 && degree <= 9 ? std::optional(degree) : std::nullopt;
}

/// The order that was solved.
std::optional<int> order_of(const Cell &cell) {
  const auto found = cell.parameters.find("order");
  if (found == cell.parameters.end() || !found->is_number_integer())
    return std::nullopt;
  return found->get<int>() - static_cast<int>(reportable(cell, "n_orders_lowered").value_or(0));
}

/// Bases that are exact up to their order; SPH and its corrections are not.
bool is_exact_up_to_order(const Cell &cell) {
  const auto found = cell.parameters.find("basis");
  if (found == cell.parameters.end() || !found->is_string())
    return true;
  for (const char *exact : {"ssph", "msph", "mls", "rkpm"})
    if (found->get<std::string>() == exact)
      return true;
  return false;
}

} // namespace

std::optional<double> theoretical_rate(const Cell &cell, std::string_view error) {
  const auto derivative = derivative_of(error);
  if (!derivative)
    return std::nullopt;
  if (const auto degree = degree_of(cell)) {
    const int rate = *degree + 1 - *derivative;
    return rate > 0 ? std::optional<double>(rate) : std::nullopt;
  }
  const auto order = order_of(cell);
  if (!order || !is_exact_up_to_order(cell))
    return std::nullopt;
  int rate = 0;
  if (cell.method == "weak2" || cell.method == "estimate")
    rate = *order + 1 - *derivative;
  else if (cell.method == "weak1")
    rate = *order;
  else if (cell.method == "strong")
    rate = *order % 2 == 0 ? *order : *order - 1;
  return rate > 0 ? std::optional<double>(rate) : std::nullopt;
}

} // namespace comparisons::reports
