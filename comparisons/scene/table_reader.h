#pragma once

#include "comparisons/scene/document.h"
#include "comparisons/scene/parameters.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace comparisons::scene {

/// One declared key of a table: its values (more than one if the scene gives a list).
struct ResolvedKey {
  Declaration declaration;
  /// Empty if the key is absent and has no default.
  std::vector<std::pair<Value, Location>> values;
  bool given = false;
  /// Place in the order of the file, for the keys that vary.
  std::size_t order = 0;
};

/// A table of the scene read against its declarations.
class ResolvedTable {
public:
  /// In the order of the declarations.
  std::vector<ResolvedKey> keys;
  /// No finding about this table.
  bool valid = true;
  /// Every required key has a value, so that checks can read it, if need be with defaults in
  /// place of values that are wrong.
  bool complete = true;

  /// Product of the lengths of all lists.
  double n_combinations() const;

  struct Combination {
    Parameters parameters;
    /// "order=2 support=4" of the keys that vary; empty if none does.
    std::string label;
  };
  /// One Parameters for every combination, keys in the order of the file, the first slowest.
  std::vector<Combination> combinations() const;
};

/// How a table is read.
struct TableRules {
  std::span<const Declaration> declarations;
  /// "study", "method[2]".
  std::string name;
  /// "[study]", "weak1": who has these keys, for messages.
  std::string title;
  /// A list in place of a scalar makes combinations.
  bool lists_allowed = false;
  /// Keys that the caller reads itself.
  std::vector<std::string> other_keys;
};

/// Where a key that is unknown here belongs, if it is known elsewhere.
struct KeyHome {
  std::string key;
  std::string home;
};

/// Reads one value as declared; nothing and a finding if it is wrong.
std::optional<Value> read_value(const Node &node, const Declaration &declaration, const std::string &key,
                                Diagnostics &diagnostics);

/// Reads a table; `node` may be null (no such table: all defaults).
ResolvedTable read_table(const Node *node, const TableRules &rules, std::span<const KeyHome> homes,
                         const Location &missing_at, Diagnostics &diagnostics);

/// A finding about a key that is not known here, with the allowed ones and a near miss.
void unknown_key(const Entry &entry, const std::string &name, const std::string &title,
                 const std::vector<std::string> &allowed, std::span<const KeyHome> homes, Diagnostics &diagnostics);

/// "greater than 0", "from 1 to 1000", "in (-1, 0.5]".
std::string range_text(const Range &range, const Dimension &dimension);

} // namespace comparisons::scene
