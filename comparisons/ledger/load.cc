#include "comparisons/ledger/ledger.h"

#include "comparisons/scene/toml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace comparisons::ledger {

namespace {

using reports::Kind;
using reports::Verdict;

/// Collects the faults of a file.
class Faults {
public:
  explicit Faults(std::string file) : file_(std::move(file)) {}

  void add(const toml::source_region &where, const std::string &message) {
    lines_.push_back(fmt::format("{}:{}:{}: {}", file_, where.begin.line, where.begin.column, message));
  }

  void raise() const {
    if (!lines_.empty())
      throw PublishedError(fmt::format("{}", fmt::join(lines_, "\n")));
  }

private:
  std::string file_;
  std::vector<std::string> lines_;
};

/// A table whose keys are taken one by one; what is left over at the end is unknown.
class Keys {
public:
  Keys(const toml::table &table, Faults &faults) : table_(table), faults_(faults) {}

  const toml::node *find(const std::string &key) {
    asked_.insert(key);
    return table_.get(key);
  }
  bool has(const std::string &key) const { return table_.contains(key); }

  std::optional<std::string> text(const std::string &key) {
    return convert<std::string>(find(key), key, "a text", [](const toml::node &node) { return node.is_string(); });
  }
  std::optional<double> number(const std::string &key) {
    const auto value =
        convert<double>(find(key), key, "a number", [](const toml::node &node) { return node.is_number(); });
    if (value && !std::isfinite(*value)) {
      fault(*find(key), fmt::format("'{}' is not finite", key));
      return std::nullopt;
    }
    return value;
  }
  std::string required_text(const std::string &key) {
    const auto value = text(key);
    if (value && !value->empty())
      return *value;
    if (!has(key) || value)
      faults_.add(table_.source(), fmt::format("the key '{}' is missing or empty", key));
    return {};
  }
  double required_number(const std::string &key) {
    if (!has(key))
      faults_.add(table_.source(), fmt::format("the key '{}' is missing", key));
    return number(key).value_or(0);
  }
  const toml::table *table(const std::string &key) {
    const toml::node *node = find(key);
    if (node && !node->is_table())
      fault(*node, fmt::format("'{}' must be a table", key));
    return node ? node->as_table() : nullptr;
  }
  /// The tables of [[key]].
  std::vector<const toml::table *> tables(const std::string &key) {
    std::vector<const toml::table *> all;
    const toml::node *node = find(key);
    if (!node)
      return all;
    if (!node->is_array() || !node->as_array()->is_homogeneous<toml::table>()) {
      fault(*node, fmt::format("'{}' must be an array of tables with at least one element", key));
      return all;
    }
    for (const toml::node &element : *node->as_array())
      all.push_back(element.as_table());
    return all;
  }
  /// One of a list of words.
  template <typename Value>
  std::optional<Value> word(const std::string &key, const std::vector<std::pair<std::string, Value>> &words) {
    const auto given = text(key);
    if (!given)
      return std::nullopt;
    std::vector<std::string> allowed;
    for (const auto &[name, value] : words) {
      if (name == *given)
        return value;
      allowed.push_back("\"" + name + "\"");
    }
    fault(*find(key), fmt::format("'{}' is \"{}\"; allowed are {}", key, *given, fmt::join(allowed, ", ")));
    return std::nullopt;
  }

  void fault(const toml::node &node, const std::string &message) { faults_.add(node.source(), message); }
  void fault(const std::string &message) { faults_.add(table_.source(), message); }

  void complain_about_the_rest() {
    for (const auto &[key, node] : table_)
      if (!asked_.contains(std::string(key.str())))
        faults_.add(key.source(),
                    fmt::format("unknown key '{}'; known here are {}", key.str(), fmt::join(asked_, ", ")));
  }

  Faults &faults() { return faults_; }

private:
  template <typename Value, typename Is>
  std::optional<Value> convert(const toml::node *node, const std::string &key, const char *what, Is is) {
    if (!node)
      return std::nullopt;
    if (!is(*node)) {
      fault(*node, fmt::format("'{}' must be {}", key, what));
      return std::nullopt;
    }
    return node->value<Value>();
  }

  const toml::table &table_;
  Faults &faults_;
  std::set<std::string> asked_;
};

nlohmann::ordered_json read_parameters(const toml::table &table, Faults &faults) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (const auto &[key, node] : table) {
    const std::string name(key.str());
    if (const auto *text = node.as_string())
      parameters[name] = text->get();
    else if (const auto *integer = node.as_integer())
      parameters[name] = integer->get();
    else if (const auto *real = node.as_floating_point())
      parameters[name] = real->get();
    else if (const auto *boolean = node.as_boolean())
      parameters[name] = boolean->get();
    else
      faults.add(node.source(), fmt::format("parameter '{}' must be a text, a number or a boolean", name));
  }
  return parameters;
}

/// `base` holds what the surrounding table says; keys given here replace it.
Selector read_selector(Keys &keys, Selector base) {
  const auto replace = [&](const char *key, std::string &member) {
    if (const auto value = keys.text(key))
      member = *value;
  };
  replace("scene", base.scene);
  replace("level", base.level);
  if (keys.has("label") || keys.has("method")) {
    base.label.clear();
    base.method.clear();
  }
  replace("label", base.label);
  replace("method", base.method);
  if (const auto variant = keys.text("variant"))
    base.variant = *variant;
  if (const toml::table *parameters = keys.table("parameters"))
    base.parameters = read_parameters(*parameters, keys.faults());
  return base;
}

std::optional<Change> read_change(Keys &keys) {
  return keys.word<Change>("change", {{"difference", Change::difference},
                                      {"relative", Change::relative},
                                      {"ratio", Change::ratio},
                                      {"rate", Change::rate}});
}

std::optional<Relation> read_relation(Keys &keys) {
  return keys.word<Relation>("relation", {{"<", Relation::less},
                                          {"<=", Relation::less_or_equal},
                                          {">", Relation::greater},
                                          {">=", Relation::greater_or_equal},
                                          {"within", Relation::within}});
}

Operand read_operand(Keys &keys, const Operand &base) {
  Operand operand = base;
  operand.cell = read_selector(keys, base.cell);
  if (const auto quantity = keys.text("quantity"))
    operand.quantity = *quantity;
  const toml::table *from = keys.table("from");
  const auto change = read_change(keys);
  if ((from != nullptr) != keys.has("change"))
    keys.fault("'from' and 'change' belong together");
  if (from && change) {
    Keys inner(*from, keys.faults());
    operand.from = read_selector(inner, operand.cell);
    operand.change = *change;
    inner.complain_about_the_rest();
  }
  return operand;
}

void check_operand(Keys &keys, const Operand &operand) {
  if (operand.cell.scene.empty())
    keys.fault("the key 'scene' is missing");
  if (operand.cell.label.empty() && operand.cell.method.empty())
    keys.fault("the key 'label' or 'method' is missing");
  if (operand.quantity.empty())
    keys.fault("the key 'quantity' is missing");
}

std::optional<double> read_tolerance(Keys &keys, const std::string &key) {
  const auto value = keys.number(key);
  if (value && *value < 0)
    keys.fault(*keys.find(key), fmt::format("'{}' is negative", key));
  return value;
}

void read_common(Keys &keys, Entry &entry, const std::string &default_source) {
  entry.source = keys.text("source").value_or(default_source);
  if (entry.source.empty())
    keys.fault("the key 'source' is missing, here and at the top of the file");
  entry.entry = keys.required_text("entry");
  entry.remark = keys.text("remark").value_or("");
  const bool is_default = entry.expect == Verdict::reproduced || entry.expect == Verdict::holds;
  if (!is_default && entry.remark.empty())
    keys.fault(fmt::format("expect = \"{}\" needs a 'remark' with the reason", reports::to_text(entry.expect)));
}

Entry read_value(const toml::table &table, const std::string &source, Faults &faults) {
  Keys keys(table, faults);
  Entry entry;
  entry.kind = Kind::value;
  entry.expect = keys.word<Verdict>("expect", {{"reproduced", Verdict::reproduced},
                                               {"differs", Verdict::differs},
                                               {"not reproducible", Verdict::not_reproducible}})
                     .value_or(Verdict::reproduced);
  read_common(keys, entry, source);
  entry.value = read_operand(keys, {});
  check_operand(keys, entry.value);
  entry.published = keys.required_number("published");
  const auto absolute = read_tolerance(keys, "tolerance");
  const auto relative = read_tolerance(keys, "relative_tolerance");
  if (keys.has("tolerance") == keys.has("relative_tolerance"))
    keys.fault("one of 'tolerance' and 'relative_tolerance' is needed");
  entry.tolerance = absolute.value_or(relative.value_or(0) * std::abs(entry.published));
  keys.complain_about_the_rest();
  return entry;
}

Condition read_condition(Keys &keys, const Operand &base) {
  Condition condition;
  const auto operand = [&](const char *key) {
    Operand result = base;
    if (const toml::table *side = keys.table(key)) {
      Keys inner(*side, keys.faults());
      result = read_operand(inner, base);
      check_operand(inner, result);
      inner.complain_about_the_rest();
    }
    return result;
  };
  if (!keys.has("left"))
    keys.fault("the key 'left' is missing");
  condition.left = operand("left");
  if (const toml::node *right = keys.find("right"); !right)
    keys.fault("the key 'right' is missing");
  else if (right->is_number())
    condition.right = keys.number("right").value_or(0);
  else
    condition.right = operand("right");
  if (!keys.has("relation"))
    keys.fault("the key 'relation' is missing");
  condition.relation = read_relation(keys).value_or(Relation::less);
  condition.factor = keys.number("factor").value_or(1);
  condition.tolerance = read_tolerance(keys, "tolerance");
  condition.relative_tolerance = read_tolerance(keys, "relative_tolerance");
  const bool has_tolerance = keys.has("tolerance") || keys.has("relative_tolerance");
  if ((condition.relation == Relation::within) != has_tolerance)
    keys.fault("'within' needs 'tolerance' or 'relative_tolerance', and nothing else takes them");
  return condition;
}

Entry read_claim(const toml::table &table, const std::string &source, Faults &faults) {
  Keys keys(table, faults);
  Entry entry;
  entry.kind = Kind::claim;
  entry.expect = keys.word<Verdict>("expect", {{"holds", Verdict::holds}, {"does not hold", Verdict::does_not_hold}})
                     .value_or(Verdict::holds);
  read_common(keys, entry, source);
  entry.statement = keys.required_text("statement");
  Operand base;
  base.cell = read_selector(keys, {});
  base.quantity = keys.text("quantity").value_or("");
  const auto conditions = keys.tables("condition");
  if (keys.has("condition") && keys.has("left"))
    keys.fault("'condition' and 'left' exclude each other");
  else if (keys.has("condition") && conditions.empty())
    keys.fault("'condition' is empty");
  if (!keys.has("condition"))
    entry.conditions.push_back(read_condition(keys, base));
  for (const toml::table *condition : conditions) {
    Keys inner(*condition, faults);
    entry.conditions.push_back(read_condition(inner, base));
    inner.complain_about_the_rest();
  }
  keys.complain_about_the_rest();
  return entry;
}

toml::table parse(const std::filesystem::path &path) {
  auto result = toml::parse_file(path.string());
  if (!result) {
    const auto &where = result.error().source().begin;
    throw PublishedError(
        fmt::format("{}:{}:{}: {}", path.string(), where.line, where.column, result.error().description()));
  }
  return std::move(result).table();
}

} // namespace

std::vector<Entry> load_published(const std::filesystem::path &path) {
  const toml::table root = parse(path);
  Faults faults(path.string());
  Keys keys(root, faults);
  if (keys.required_number("schema") != 1)
    keys.fault("'schema' must be 1");
  const std::string benchmark = keys.required_text("benchmark");
  const std::string source = keys.text("source").value_or("");
  std::vector<Entry> entries;
  for (const toml::table *value : keys.tables("value"))
    entries.push_back(read_value(*value, source, faults));
  for (const toml::table *claim : keys.tables("claim"))
    entries.push_back(read_claim(*claim, source, faults));
  keys.complain_about_the_rest();
  for (Entry &entry : entries)
    entry.benchmark = benchmark;
  faults.raise();
  return entries;
}

} // namespace comparisons::ledger
