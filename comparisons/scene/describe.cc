#include "comparisons/scene/describe.h"

#include "comparisons/scene/table_reader.h"
#include "comparisons/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace comparisons::scene {

namespace {

/// Characters, not bytes.
std::size_t width(const std::string &text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Rows with columns padded to the widest cell, two spaces apart.
std::string aligned(const std::vector<std::array<std::string, 5>> &rows) {
  std::array<std::size_t, 5> widths{};
  for (const auto &row : rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], width(row[i]));
  std::string text;
  for (const auto &row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - width(row[i]) + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

bool is_unbounded(const Range &range) { return std::isinf(range.lower) && std::isinf(range.upper); }

} // namespace

std::string type_text(const Declaration &declaration) {
  const bool plain = declaration.dimension == dimensions::none;
  const std::string quantity =
      plain ? "number"
            : fmt::format("{} [{}]", dimension_name(declaration.dimension), unit_text(declaration.dimension));
  switch (declaration.type) {
  case Type::boolean:
    return "true or false";
  case Type::integer:
    return declaration.is_bytes ? "memory [B]" : "whole number";
  case Type::real:
    return quantity;
  case Type::text:
    return "text";
  case Type::choice:
    return "one of";
  case Type::expression:
    return quantity + " or expression of x, y";
  case Type::expressions:
    return "two of " + quantity + " or expression of x, y";
  case Type::point:
    return plain ? "point" : fmt::format("point [{}]", unit_text(declaration.dimension));
  }
  return {};
}

std::string default_text(const Declaration &declaration) {
  if (!declaration.default_value)
    return declaration.required ? "required" : "-";
  const Value &value = *declaration.default_value;
  if (const auto *real = std::get_if<double>(&value))
    return quantity_text(*real, declaration.dimension);
  return to_text(value);
}

std::string allowed_text(const Declaration &declaration) {
  if (!declaration.choices.empty())
    return fmt::format("{}", fmt::join(declaration.choices, ", "));
  return is_unbounded(declaration.range) ? "" : range_text(declaration.range, declaration.dimension);
}

std::string describe_declarations(std::span<const Declaration> declarations) {
  std::vector<std::array<std::string, 5>> rows{{"key", "type", "default", "allowed", "meaning"}};
  for (const Declaration &declaration : declarations)
    rows.push_back({declaration.name, type_text(declaration), default_text(declaration), allowed_text(declaration),
                    declaration.meaning});
  return aligned(rows);
}

std::string describe_effects(const Scene &scene, const Vocabulary &vocabulary) {
  std::size_t widest = 0;
  for (const auto &effect : vocabulary.effects)
    widest = std::max(widest, effect.name.size());
  std::string active;
  std::string absent;
  for (const auto &effect : vocabulary.effects) {
    const bool called = std::ranges::find(scene.effects, effect.name) != scene.effects.end();
    (called ? active : absent) += fmt::format("  {:{}}  {}\n", effect.name, widest, effect.meaning);
  }
  return "effects called for:\n" + (active.empty() ? "  none\n" : active) +
         "effects absent (not computed, not allocated):\n" + (absent.empty() ? "  none\n" : absent);
}

} // namespace comparisons::scene
