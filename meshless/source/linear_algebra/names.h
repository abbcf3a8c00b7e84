#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace meshless::linear_algebra {

/// The line of a table whose `member` is `value`; there is one for every value of an enumeration.
template <typename Line, typename Value>
const Line &entry_of(std::span<const Line> table, Value Line::*member, Value value) {
  return *std::find_if(table.begin(), table.end(), [&](const Line &line) { return line.*member == value; });
}

/// The line of a table with this name.
/// @throws std::invalid_argument listing the names there are
template <typename Line>
const Line &entry_named(std::span<const Line> table, std::string_view name, const char *kind) {
  std::string names;
  for (const Line &line : table) {
    if (line.name == name)
      return line;
    names += (names.empty() ? "" : ", ") + std::string(line.name);
  }
  throw std::invalid_argument(fmt::format("no {} '{}'; there are {}", kind, name, names));
}

} // namespace meshless::linear_algebra
