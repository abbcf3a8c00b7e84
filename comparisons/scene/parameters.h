#pragma once

#include "comparisons/scene/declaration.h"
#include "comparisons/scene/diagnostics.h"

#include <string>
#include <string_view>
#include <vector>

namespace comparisons::scene {

/// One resolved key: its declaration, value in SI, whether the scene gave it, and where.
struct Parameter {
  Declaration declaration;
  Value value;
  bool given = false;
  Location location;
};

/// The resolved keys of one table of a scene, in the order of their declarations. Keys that
/// have no default and were not given are absent.
class Parameters {
public:
  void add(Parameter parameter);

  bool has(std::string_view name) const;
  /// True if the scene itself (or --set) gave the key.
  bool is_given(std::string_view name) const;
  /// The place of a key, for a check that finds fault with its value; empty if not given.
  Location location(std::string_view name) const;

  // Access by type. Asking for a key that is absent or of another type is a programming error
  // and throws std::logic_error naming the key.
  bool boolean(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  double real(std::string_view name) const;             ///< SI
  const std::string &text(std::string_view name) const; ///< Type::text and Type::choice
  Point point(std::string_view name) const;             ///< SI

  const std::vector<Parameter> &all() const { return parameters_; }

private:
  std::vector<Parameter> parameters_;
};

/// A value as text, as short as reads back the same ("4", "0.33", "1e-06", "[0, 1]").
std::string to_text(const Value &value);

} // namespace comparisons::scene
