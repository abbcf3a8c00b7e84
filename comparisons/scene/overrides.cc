#include "comparisons/scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace comparisons::scene {

namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

/// Parts of a path: "method[2].support" and "method.2.support" are the same.
std::vector<std::string> split_path(const std::string &path) {
  std::vector<std::string> parts{""};
  for (const char c : path) {
    if (c == '.' || c == '[')
      parts.emplace_back();
    else if (c != ']')
      parts.back() += c;
  }
  for (auto &part : parts)
    part = trimmed(part);
  return parts;
}

void set_entry(Node &table, const std::string &key, const Node &value) {
  if (Entry *entry = table.find(key)) {
    entry->value = value;
    entry->key_location = value.location;
  } else {
    table.entries.push_back({key, value.location, value});
  }
}

std::vector<std::string> top_keys() { return {"title", "benchmark", "schema"}; }

std::vector<std::string> top_tables() { return {"problem", "material", "effects", "time", "study", "output"}; }

std::vector<std::string> all_tops() {
  auto names = top_keys();
  for (auto &table : top_tables())
    names.push_back(std::move(table));
  names.emplace_back("method");
  return names;
}

bool has(const std::vector<std::string> &names, const std::string &name) {
  return std::ranges::find(names, name) != names.end();
}

/// One override and the document that it changes.
class Override {
public:
  Override(Node &root, const std::string &text, const Vocabulary &vocabulary, Diagnostics &diagnostics)
      : root_(root), text_(text), vocabulary_(vocabulary), diagnostics_(diagnostics) {
    const std::string shown = in_quotes(text);
    location_.file = "--set " + shown.substr(1, shown.size() - 2);
  }

  void apply() {
    const auto equals = text_.find('=');
    std::size_t bad = 0;
    if (!is_plain_utf8(text_, bad))
      return fail({}, "the text is not UTF-8");
    if (equals == std::string::npos)
      return fail({}, "an override has the form KEY=VALUE", "for example --set material.nu=0.3");
    const std::string path = trimmed(std::string_view(text_).substr(0, equals));
    if (path.empty())
      return fail({}, "the key before '=' is empty", "for example --set material.nu=0.3");
    const auto value = read(trimmed(std::string_view(text_).substr(equals + 1)));
    if (!value)
      return fail(path, "the value begins like a list, a table or a text in quotes, but is no TOML value",
                  "texts inside a list are in quotes: 'study.levels=[\"16x4\"]'");
    const auto parts = split_path(path);
    if (std::ranges::any_of(parts, [](const auto &p) { return p.empty(); }))
      return fail(path, "a part of the key is empty");
    apply_at(path, parts, *value);
  }

private:
  void fail(std::string key, std::string message, std::string suggestion = {}) {
    diagnostics_.error(location_, std::move(key), std::move(message), std::move(suggestion));
  }

  /// The value as TOML, else as a plain text.
  std::optional<Node> read(const std::string &value) const {
    // A date is not a value of any key; it is more likely a title.
    if (auto node = parse_value(value, location_); node && !node->is(Node::Kind::date))
      return node;
    if (!value.empty() && std::string_view("[{\"'").find(value.front()) != std::string_view::npos)
      return std::nullopt;
    Node node;
    node.kind = Node::Kind::text;
    node.location = location_;
    node.text = value;
    return node;
  }

  void apply_at(const std::string &path, const std::vector<std::string> &parts, const Node &value) {
    const std::string &top = parts[0];
    if (top == "method")
      return apply_to_methods(path, parts, value);
    if (Entry *list = root_.find(top); list != nullptr && list->value.is(Node::Kind::array) && has(lists(), top))
      return apply_to_list(path, parts, list->value, value);
    if (top == "effects" && parts.size() == 3)
      return set_effect_key(parts[1], parts[2], value);
    if (has(top_tables(), top)) {
      if (parts.size() != 2)
        return fail(path, fmt::format("a key of [{0}] has the form {0}.KEY", top));
      return set_in_table(top, parts[1], value);
    }
    if (has(top_keys(), top)) {
      if (parts.size() != 1)
        return fail(path, fmt::format("'{}' has no keys below it", top));
      return set_entry(root_, top, value);
    }
    fail(path, fmt::format("no such key {}; a key begins with one of: {}", in_quotes(top), fmt::join(all_tops(), ", ")),
         did_you_mean(top, all_tops()));
  }

  /// Lists of tables besides the methods.
  static std::vector<std::string> lists() { return {"material", "boundary", "quantity"}; }

  /// material[1].nu, or material.nu if there is one.
  void apply_to_list(const std::string &path, const std::vector<std::string> &parts, Node &list, const Node &value) {
    std::size_t index = 0;
    const std::string &number = parts.size() == 3 ? parts[1] : "0";
    const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), index);
    const bool good = status == std::errc{} && end == number.data() + number.size() && index < list.items.size();
    if (!good || parts.size() < 2 || parts.size() > 3 || (parts.size() == 2 && list.items.size() != 1))
      return fail(path, fmt::format("a key of [[{0}]] has the form {0}[0].KEY, with a number below {1}", parts[0],
                                    list.items.size()));
    if (list.items[index].is(Node::Kind::table))
      set_entry(list.items[index], parts.back(), value);
  }

  void set_in_table(const std::string &table, const std::string &key, const Node &value) {
    if (root_.find(table) == nullptr) {
      Node empty;
      empty.location = location_;
      root_.entries.push_back({table, location_, std::move(empty)});
    }
    Node &node = root_.find(table)->value;
    if (node.is(Node::Kind::table)) // if not, the validation reports it
      set_entry(node, key, value);
  }

  /// effects.NAME.KEY also calls for the effect.
  void set_effect_key(const std::string &effect, const std::string &key, const Node &value) {
    Node empty;
    empty.location = location_;
    const Entry *effects = root_.find("effects");
    const Entry *entry = effects != nullptr ? effects->value.find(effect) : nullptr;
    if (entry == nullptr || !entry->value.is(Node::Kind::table))
      set_in_table("effects", effect, empty);
    Node &node = root_.find("effects")->value;
    if (Entry *table = node.is(Node::Kind::table) ? node.find(effect) : nullptr)
      set_entry(table->value, key, value);
  }

  /// All tables of methods, or the single one of a wrong `[method]`.
  std::vector<Node *> method_tables() {
    std::vector<Node *> tables;
    Entry *entry = root_.find("method");
    if (entry == nullptr)
      return tables;
    if (entry->value.is(Node::Kind::table))
      tables.push_back(&entry->value);
    for (Node &item : entry->value.items)
      tables.push_back(&item); // also what is no table: the index counts it
    return tables;
  }

  static std::string text_of(const Node &table, std::string_view key) {
    const Entry *entry = table.find(key);
    return entry != nullptr && entry->value.is(Node::Kind::text) ? entry->value.text : std::string{};
  }

  std::vector<std::string> keys_of(const Node &table) const {
    auto keys = common_method_keys();
    const auto found = std::ranges::find(vocabulary_.methods, text_of(table, "name"), &MethodDescription::name);
    if (found != vocabulary_.methods.end())
      for (const auto &declaration : found->parameters)
        keys.push_back(declaration.name);
    return keys;
  }

  void apply_to_methods(const std::string &path, const std::vector<std::string> &parts, const Node &value) {
    if (parts.size() < 2 || parts.size() > 3)
      return fail(path, "a key of methods has the form method.KEY, method.NAME.KEY or method.NUMBER.KEY");
    std::vector<Node *> tables = method_tables();
    if (parts.size() == 3) {
      tables = chosen(path, parts[1], tables);
      if (tables.empty())
        return;
    }
    const std::string &key = parts.back();
    std::vector<std::string> known;
    std::size_t n_set = 0;
    for (Node *table : tables) {
      const auto keys = keys_of(*table);
      known.insert(known.end(), keys.begin(), keys.end());
      if (has(keys, key) && table->is(Node::Kind::table)) {
        set_entry(*table, key, value);
        ++n_set;
      }
    }
    if (n_set == 0)
      fail(path,
           fmt::format("no method of this scene{} has the key {}",
                       parts.size() == 3 ? " named " + in_quotes(parts[1]) : "", in_quotes(key)),
           did_you_mean(key, known));
  }

  /// The tables that a name, a label or a number chooses; empty after a finding.
  std::vector<Node *> chosen(const std::string &path, const std::string &choice, const std::vector<Node *> &tables) {
    std::size_t index = 0;
    const char *const end = choice.data() + choice.size();
    const auto [stop, status] = std::from_chars(choice.data(), end, index);
    if (stop == end) {
      if (status == std::errc{} && index < tables.size())
        return {tables[index]};
      fail(path,
           fmt::format("no method number {}; the scene has {}, counted from 0", in_quotes(choice), tables.size()));
      return {};
    }
    std::vector<Node *> result;
    std::vector<std::string> names;
    for (Node *table : tables) {
      names.push_back(text_of(*table, "name"));
      names.push_back(text_of(*table, "label"));
      if (names.back() == choice || names[names.size() - 2] == choice)
        result.push_back(table);
    }
    std::erase(names, "");
    if (result.empty())
      fail(path,
           fmt::format("no method of this scene is named {}; it has: {}", in_quotes(choice),
                       names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))),
           did_you_mean(choice, names));
    return result;
  }

  Node &root_;
  const std::string &text_;
  const Vocabulary &vocabulary_;
  Diagnostics &diagnostics_;
  Location location_;
};

} // namespace

std::vector<std::string> common_method_keys() { return {"name", "label", "levels", "expect"}; }

void apply_overrides(Node &root, std::span<const std::string> overrides, const Vocabulary &vocabulary,
                     Diagnostics &diagnostics) {
  for (const std::string &text : overrides)
    Override(root, text, vocabulary, diagnostics).apply();
}

} // namespace comparisons::scene
