#include "comparisons/scene/table_reader.h"

#include "comparisons/scene/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace comparisons::scene {

namespace {

/// True if the value is a list of values rather than one: for a point, a list of lists.
bool is_list(const Node &node, const Declaration &declaration) {
  if (!node.is(Node::Kind::array))
    return false;
  return (declaration.type != Type::point && declaration.type != Type::expressions) ||
         std::ranges::any_of(node.items, [](const Node &n) { return n.is(Node::Kind::array); });
}

/// Reads a list in place of a scalar. False after a finding.
bool read_list(const Node &node, ResolvedKey &target, const TableRules &rules, const std::string &key,
               Diagnostics &diagnostics) {
  if (!rules.lists_allowed) {
    diagnostics.error(node.location, key, "found a list; this key takes one value",
                      "lists are for the keys of [[method]] and [problem]");
    return false;
  }
  if (node.items.empty() || node.items.size() > most_cells) {
    diagnostics.error(node.location, key,
                      node.items.empty()
                          ? "an empty list; give at least one value"
                          : fmt::format("a list of {} values; at most {}", node.items.size(), most_cells));
    return false;
  }
  bool valid = true;
  std::set<std::string> texts;
  for (const Node &item : node.items) {
    auto value = read_value(item, target.declaration, key, diagnostics);
    if (value && !texts.insert(to_text(*value)).second) {
      diagnostics.error(item.location, key, fmt::format("the value {} stands twice", to_text(*value)),
                        "remove one of them");
      valid = false;
    } else if (value) {
      target.values.emplace_back(std::move(*value), item.location);
    } else {
      valid = false;
    }
  }
  return valid;
}

std::vector<std::string> allowed_keys(const TableRules &rules) {
  std::vector<std::string> names;
  for (const auto &declaration : rules.declarations)
    names.push_back(declaration.name);
  names.insert(names.end(), rules.other_keys.begin(), rules.other_keys.end());
  return names;
}

/// Reads the entries that the table has.
void read_entries(const Node &node, const TableRules &rules, std::span<const KeyHome> homes, ResolvedTable &table,
                  Diagnostics &diagnostics) {
  const auto allowed = allowed_keys(rules);
  std::size_t order = 0;
  for (const Entry &entry : node.entries) {
    const auto target =
        std::ranges::find_if(table.keys, [&](const ResolvedKey &k) { return k.declaration.name == entry.key; });
    if (target == table.keys.end()) {
      if (std::ranges::find(rules.other_keys, entry.key) == rules.other_keys.end()) {
        unknown_key(entry, rules.name, rules.title, allowed, homes, diagnostics);
        table.valid = false;
      }
      continue;
    }
    const std::string key = rules.name + "." + entry.key;
    target->order = order++;
    bool valid = true;
    if (is_list(entry.value, target->declaration)) {
      valid = read_list(entry.value, *target, rules, key, diagnostics);
    } else {
      auto value = read_value(entry.value, target->declaration, key, diagnostics);
      valid = value.has_value();
      if (value)
        target->values.emplace_back(std::move(*value), entry.value.location);
    }
    target->given = !target->values.empty();
    table.valid = table.valid && valid;
  }
}

/// A near miss of a key of another table.
std::string nearest_elsewhere(const std::string &key, std::span<const KeyHome> homes) {
  std::vector<std::string> names;
  for (const KeyHome &home : homes)
    names.push_back(home.key);
  const std::string near = nearest_name(key, names);
  if (near.empty())
    return {};
  return fmt::format("did you mean '{}', which belongs to {}?", near,
                     std::ranges::find(homes, near, &KeyHome::key)->home);
}

bool is_written(const Node *node, const std::string &key) { return node != nullptr && node->find(key) != nullptr; }

} // namespace

double ResolvedTable::n_combinations() const {
  double n = 1;
  for (const ResolvedKey &key : keys)
    n *= static_cast<double>(std::max<std::size_t>(key.values.size(), 1));
  return n;
}

std::vector<ResolvedTable::Combination> ResolvedTable::combinations() const {
  std::vector<const ResolvedKey *> varying;
  for (const ResolvedKey &key : keys)
    if (key.values.size() > 1)
      varying.push_back(&key);
  std::ranges::sort(varying, {}, &ResolvedKey::order);

  std::vector<Combination> result;
  std::vector<std::size_t> index(varying.size(), 0);
  while (true) {
    Combination combination;
    for (const ResolvedKey &key : keys) {
      if (key.values.empty())
        continue;
      const auto place = std::ranges::find(varying, &key);
      const auto &[value, location] = key.values[place == varying.end() ? 0 : index[place - varying.begin()]];
      combination.parameters.add({key.declaration, value, key.given, location});
    }
    for (std::size_t i = 0; i < varying.size(); ++i)
      combination.label += fmt::format("{}{}={}", i == 0 ? "" : " ", varying[i]->declaration.name,
                                       to_text(varying[i]->values[index[i]].first));
    result.push_back(std::move(combination));
    // The next combination: the last key runs fastest.
    std::size_t i = varying.size();
    while (i > 0 && ++index[i - 1] == varying[i - 1]->values.size())
      index[--i] = 0;
    if (i == 0)
      return result;
  }
}

ResolvedTable read_table(const Node *node, const TableRules &rules, std::span<const KeyHome> homes,
                         const Location &missing_at, Diagnostics &diagnostics) {
  ResolvedTable table;
  for (const Declaration &declaration : rules.declarations)
    table.keys.push_back({.declaration = declaration, .values = {}, .given = false, .order = 0});
  if (node != nullptr && !node->is(Node::Kind::table)) {
    diagnostics.error(node->location, rules.name, fmt::format("expected a table, found {}", describe(*node)),
                      fmt::format("write [{}] and its keys below", rules.name));
    table.valid = false;
    node = nullptr;
  }
  if (node != nullptr)
    read_entries(*node, rules, homes, table, diagnostics);
  for (ResolvedKey &key : table.keys) {
    if (!key.values.empty())
      continue;
    const Declaration &declaration = key.declaration;
    if (declaration.default_value) {
      key.values.emplace_back(*declaration.default_value, Location{});
    } else if (declaration.required) {
      table.complete = false;
      if (!is_written(node, declaration.name)) {
        table.valid = false;
        diagnostics.error(node != nullptr ? node->location : missing_at, rules.name + "." + declaration.name,
                          fmt::format("the required key '{}' is missing: {}", declaration.name, declaration.meaning));
      }
    }
  }
  return table;
}

void unknown_key(const Entry &entry, const std::string &name, const std::string &title,
                 const std::vector<std::string> &allowed, std::span<const KeyHome> homes, Diagnostics &diagnostics) {
  if (diagnostics.all().size() > Diagnostics::limit)
    return; // a search for near misses would be in vain
  std::string suggestion;
  const auto home = std::ranges::find(homes, entry.key, &KeyHome::key);
  const std::string near = nearest_name(entry.key, allowed);
  if (home != homes.end() && home->home != title)
    suggestion = fmt::format("{} belongs to {}", in_quotes(entry.key), home->home);
  else if (!near.empty())
    suggestion = "did you mean " + in_quotes(near) + "?";
  else
    suggestion = nearest_elsewhere(entry.key, homes);
  const std::string shown = in_quotes(entry.key);
  diagnostics.error(entry.key_location, (name.empty() ? "" : name + ".") + shown.substr(1, shown.size() - 2),
                    fmt::format("unknown key {} in {}; allowed: {}", shown, title,
                                allowed.empty() ? "none" : fmt::format("{}", fmt::join(allowed, ", "))),
                    std::move(suggestion));
}

} // namespace comparisons::scene
