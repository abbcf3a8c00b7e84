#include "comparisons/scene/overrides.h"
#include "comparisons/scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace comparisons::scene {

namespace {

bool has(const std::vector<std::string> &names, const std::string &name) {
  return std::ranges::find(names, name) != names.end();
}

std::vector<std::string> names_of(const auto &descriptions) {
  std::vector<std::string> names;
  for (const auto &description : descriptions)
    names.push_back(description.name);
  return names;
}

/// "order=3": the keys whose values differ; empty if the methods are the same.
std::string difference(const Parameters &from, const Parameters &to) {
  std::vector<std::string> parts;
  for (const Parameter &parameter : to.all()) {
    const auto other = std::ranges::find_if(
        from.all(), [&](const Parameter &p) { return p.declaration.name == parameter.declaration.name; });
    if (other == from.all().end() || other->value != parameter.value)
      parts.push_back(fmt::format("{}={}", parameter.declaration.name, to_text(parameter.value)));
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

} // namespace

void SceneReader::read_methods() {
  const Node *node = table("method");
  const std::string allowed = fmt::format("{}", fmt::join(names_of(vocabulary_.methods), ", "));
  if (node == nullptr)
    return diagnostics_.error(here(), "method", "the scene has no [[method]]",
                              "add [[method]] and below it name = one of " + allowed);
  if (node->is(Node::Kind::table)) {
    diagnostics_.error(node->location, "method", "[method] is a single table; methods are a list", "write [[method]]");
    return read_method(*node, 0);
  }
  if (!node->is(Node::Kind::array))
    return diagnostics_.error(node->location, "method",
                              fmt::format("expected a list of tables [[method]], found {}", describe(*node)));
  if (node->items.empty())
    return diagnostics_.error(node->location, "method", "the list of methods is empty",
                              "add [[method]] and below it name = one of " + allowed);
  for (std::size_t i = 0; i < node->items.size(); ++i)
    read_method(node->items[i], i);
}

void SceneReader::read_method(const Node &node, std::size_t index) {
  MethodTable method;
  method.key = fmt::format("method[{}]", index);
  method.location = node.location;
  if (!node.is(Node::Kind::table)) {
    diagnostics_.error(node.location, method.key, fmt::format("expected a table, found {}", describe(node)),
                       "write [[method]]");
    return;
  }
  read_method_name(node, method);
  if (method.description != nullptr)
    method.table = read_table(&node,
                              {.declarations = method.description->parameters,
                               .name = method.key,
                               .title = method.description->name,
                               .lists_allowed = true,
                               .other_keys = common_method_keys()},
                              homes_, node.location, diagnostics_);
  else
    method.table.valid = method.table.complete = false;
  read_common_keys(node, method);
  methods_.push_back(std::move(method));
}

void SceneReader::read_method_name(const Node &node, MethodTable &method) {
  const auto names = names_of(vocabulary_.methods);
  const std::string allowed = fmt::format("{}", fmt::join(names, ", "));
  const std::string key = method.key + ".name";
  const Entry *entry = node.find("name");
  if (entry == nullptr)
    return diagnostics_.error(node.location, key, "the required key 'name' is missing; allowed: " + allowed);
  const Node &name = entry->value;
  if (!name.is(Node::Kind::text))
    return diagnostics_.error(name.location, key,
                              fmt::format("expected a text, one of {}; found {}", allowed, describe(name)));
  const auto found = std::ranges::find(vocabulary_.methods, name.text, &MethodDescription::name);
  if (found == vocabulary_.methods.end())
    return diagnostics_.error(name.location, key,
                              fmt::format("unknown method {}; allowed: {}", in_quotes(name.text), allowed),
                              did_you_mean(name.text, names));
  method.description = &*found;
  method.label = found->name;
  method.label_location = node.location;
}

void SceneReader::read_common_keys(const Node &node, MethodTable &method) {
  const auto before = diagnostics_.all().size();
  const auto read = [&](const Declaration &declaration) -> std::optional<std::string> {
    const Entry *entry = node.find(declaration.name);
    if (entry == nullptr)
      return std::nullopt;
    const auto value = read_value(entry->value, declaration, method.key + "." + declaration.name, diagnostics_);
    return value ? std::optional(std::get<std::string>(*value)) : std::nullopt;
  };
  if (const auto label = read({.name = "label", .type = Type::text, .meaning = ""})) {
    const Location location = node.find("label")->value.location;
    const bool printable = std::ranges::none_of(*label, [](unsigned char c) { return c < 0x20; });
    if (label->empty() || !printable)
      diagnostics_.error(location, method.key + ".label", "a label is one line and not empty");
    method.label = *label;
    method.label_location = location;
  }
  if (const auto expect =
          read({.name = "expect", .type = Type::choice, .choices = {"ok", "refused", "failed"}, .meaning = ""}))
    method.expect = *expect;
  method.table.valid = method.table.valid && diagnostics_.all().size() == before;
  const Entry *levels = node.find("levels");
  method.levels = levels == nullptr ? scene_.levels
                                    : read_levels(levels->value, level_form(), method.key + ".levels", diagnostics_);
}

/// A method without levels of its own needs those of the study.
void SceneReader::require_levels() {
  const Node *methods = table("method");
  const Node *study = table("study");
  if (study_has_levels_ || (study != nullptr && !study->is(Node::Kind::table)))
    return;
  const auto has_levels = [](const Node &n) { return n.find("levels") != nullptr; };
  const bool all = methods != nullptr && methods->is(Node::Kind::array) && !methods->items.empty() &&
                   std::ranges::all_of(methods->items, has_levels);
  if (all)
    return;
  diagnostics_.error(study != nullptr ? study->location : here(), "study.levels",
                     "the required key 'levels' is missing; a level is " + allowed_levels(level_form()),
                     level_form().counts_per_level == 1 ? "write in [study], for example, levels = [188]"
                                                        : "write in [study], for example, levels = [\"16x4\"]");
}

void SceneReader::match_effects() {
  const auto can = [](const MethodDescription &d, const std::string &e) { return has(d.effects, e); };
  const bool all_known =
      !methods_.empty() && std::ranges::all_of(methods_, [](const auto &m) { return m.description != nullptr; });
  for (const auto &[effect, location] : effects_) {
    bool anyone = false;
    for (const auto &method : methods_)
      anyone = anyone || (method.description != nullptr && can(*method.description, effect));
    if (!anyone && all_known) {
      std::vector<std::string> able;
      for (const auto &description : vocabulary_.methods)
        if (can(description, effect))
          able.push_back(description.name);
      diagnostics_.error(location.file.empty() ? here() : location, "effects." + effect,
                         fmt::format("no listed method can do the effect '{}'", effect),
                         able.empty() ? "no method of this version can"
                                      : fmt::format("methods that can: {}", fmt::join(able, ", ")));
    }
    for (auto &method : methods_)
      if (method.description != nullptr && !can(*method.description, effect))
        method.refused += fmt::format("{}the method {} cannot do the effect '{}' that the scene calls for",
                                      method.refused.empty() ? "" : "; ", method.description->name, effect);
  }
}

/// Makes the combinations of all lists, unless there are too many.
void SceneReader::expand() {
  double n_rows = 0;
  double n_requests = 0;
  for (const auto &method : methods_) {
    n_requests += method.table.n_combinations();
    n_rows += method.table.n_combinations() * static_cast<double>(std::max<std::size_t>(method.levels.size(), 1));
  }
  const double n_variants = problem_.n_combinations();
  const double n_cells = n_rows * n_variants;
  if (n_cells > static_cast<double>(most_cells) || std::max(n_requests, n_variants) > static_cast<double>(most_cells)) {
    diagnostics_.error(here(), {},
                       fmt::format("the scene has {:.0f} cells (problems x methods x levels); at most {}",
                                   std::max({n_cells, n_requests, n_variants}), most_cells),
                       "shorten the lists");
    return;
  }
  for (auto &[parameters, label] : problem_.combinations())
    scene_.problems.push_back({std::move(parameters), std::move(label)});
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    const MethodTable &method = methods_[i];
    if (method.description == nullptr)
      continue;
    for (auto &[parameters, label] : method.table.combinations()) {
      scene_.methods.push_back({.name = method.description->name,
                                .label = method.label + (label.empty() ? "" : " ") + label,
                                .parameters = std::move(parameters),
                                .levels = method.levels,
                                .expect = method.expect,
                                .refused = method.refused,
                                .location = method.location});
      owners_.push_back(i);
    }
  }
  check_labels();
}

void SceneReader::check_labels() {
  std::map<std::string, std::size_t> first;
  std::set<std::size_t> reported; // one finding a table is enough
  for (std::size_t i = 0; i < scene_.methods.size(); ++i) {
    const MethodTable &owner = methods_[owners_[i]];
    const MethodRequest &request = scene_.methods[i];
    const auto [place, inserted] = first.emplace(request.label, i);
    if (inserted || !owner.table.valid || !methods_[owners_[place->second]].table.valid ||
        !reported.insert(owners_[i]).second)
      continue;
    const MethodRequest &other = scene_.methods[place->second];
    const std::string differs = difference(other.parameters, request.parameters);
    const bool same = other.name == request.name && differs.empty() && other.levels == request.levels;
    diagnostics_.error(owner.label_location, owner.key + ".label",
                       fmt::format("the label {} stands twice (first in {})", in_quotes(request.label),
                                   methods_[owners_[place->second]].key),
                       same ? "the two methods are the same; remove one"
                            : fmt::format("tell them apart, for example label = \"{}{}{}\"", request.name,
                                          differs.empty() ? " 2" : " ", differs));
  }
}

} // namespace comparisons::scene
