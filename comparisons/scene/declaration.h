#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace comparisons::scene {

/// Physical dimension of a quantity: exponents of kg, m, s and K.
struct Dimension {
  int mass = 0;
  int length = 0;
  int time = 0;
  int temperature = 0;

  friend bool operator==(const Dimension &, const Dimension &) = default;
};

namespace dimensions {
inline constexpr Dimension none{};
inline constexpr Dimension length{.length = 1};
inline constexpr Dimension time{.time = 1};
inline constexpr Dimension temperature{.temperature = 1};
inline constexpr Dimension velocity{.length = 1, .time = -1};
inline constexpr Dimension density{.mass = 1, .length = -3};
inline constexpr Dimension pressure{.mass = 1, .length = -1, .time = -2};
inline constexpr Dimension force_per_length{.mass = 1, .time = -2};
inline constexpr Dimension bytes{};
} // namespace dimensions

/// What a key of a scene may hold.
enum class Type {
  boolean,
  integer,
  real,   ///< a number in SI or a string with a unit, if the dimension is not none
  text,   ///< any string; the method or benchmark checks its form
  choice, ///< one of `choices`
  point,  ///< two reals with the declared dimension
  /// A real as above, or a function of x and y in SI ("1e6*y*(1-y)"), or one of `choices`; held as a text in SI.
  expression,
  /// A list of two of them, or one of `choices`; held as a text: "0; 1e6*y" (split_expressions).
  expressions,
};

using Point = std::array<double, 2>;

/// A resolved value in SI units. A choice is held as its text.
using Value = std::variant<bool, std::int64_t, double, std::string, Point>;

/// Allowed interval of a number; open ends exclude the bound itself.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;
};

/// One key of a scene, declared once: it serves validation, `explain`, `list`, `init` and the
/// reference page.
struct Declaration {
  std::string name;
  Type type = Type::real;
  Dimension dimension = dimensions::none;
  Range range = {};
  std::vector<std::string> choices = {};
  /// Empty: the key stays absent when it is not given, unless `required`.
  std::optional<Value> default_value = {};
  bool required = false;
  /// One line, with the unit.
  std::string meaning;
  /// Only for Type::integer: an amount of memory in bytes; a string such as "4 GiB" is allowed.
  bool is_bytes = false;
};

} // namespace comparisons::scene
