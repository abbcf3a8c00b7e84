#include "comparisons/scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::scene {

void SceneReader::read_effects() {
  const Node *node = table("effects");
  // --set effects.NAME on a scene without [effects] changes the benchmark's own choice.
  const bool from_override = node != nullptr && node->location.line == 0;
  if ((node == nullptr || from_override) && benchmark_ != nullptr)
    for (const auto &name : benchmark_->effects) {
      const auto found = std::ranges::find(vocabulary_.effects, name, &EffectDescription::name);
      if (found != vocabulary_.effects.end())
        add_effect(*found, nullptr, {});
    }
  if (node == nullptr)
    return;
  if (!node->is(Node::Kind::table)) {
    diagnostics_.error(node->location, "effects", fmt::format("expected a table, found {}", describe(*node)),
                       "write [effects] and below it, for example, elasticity = true");
    return;
  }
  bool valid = true;
  for (const Entry &entry : node->entries) {
    const auto before = diagnostics_.all().size();
    read_effect(entry);
    valid = valid && diagnostics_.all().size() == before;
  }
  const bool wanted = benchmark_ != nullptr && !benchmark_->effects.empty();
  if (valid && wanted && effects_.empty())
    diagnostics_.error(node->location, "effects", "the scene calls for no effect; nothing would be computed",
                       fmt::format("write {} = true, or remove the table", benchmark_->effects.front()));
}

void SceneReader::read_effect(const Entry &entry) {
  std::vector<std::string> names;
  for (const auto &effect : vocabulary_.effects)
    names.push_back(effect.name);
  const std::string key = "effects." + entry.key;
  const auto found = std::ranges::find(vocabulary_.effects, entry.key, &EffectDescription::name);
  if (found == vocabulary_.effects.end())
    return unknown_key(entry, "effects", "[effects]", names, homes_, diagnostics_);
  const Node &value = entry.value;
  const bool has_own_table = has_geometry() && (entry.key == "body_force" ||
                                                entry.key == "thermal_expansion"); // read_geometry_tables reads it
  if (value.is(Node::Kind::table) && has_own_table)
    return add_effect(*found, nullptr, entry.key_location);
  if (value.is(Node::Kind::table)) {
    if (found->parameters.empty())
      return diagnostics_.error(value.location, key, fmt::format("the effect '{}' has no parameters", entry.key),
                                fmt::format("write {} = true in [effects]", entry.key));
    return add_effect(*found, &value, entry.key_location);
  }
  if (!value.is(Node::Kind::boolean))
    return diagnostics_.error(value.location, key,
                              fmt::format("expected true or false{}, found {}",
                                          found->parameters.empty() ? "" : " or a table of its parameters",
                                          describe(value)));
  std::erase_if(effects_, [&](const auto &effect) { return effect.first == entry.key; });
  scene_.effect_parameters.erase(entry.key);
  if (value.boolean)
    add_effect(*found, nullptr, entry.key_location);
}

std::vector<Declaration> SceneReader::effect_declarations(const EffectDescription &effect) const {
  std::vector<Declaration> declarations = effect.parameters;
  if (benchmark_ != nullptr)
    for (auto &declaration : declarations)
      if (const auto own = benchmark_->effect_defaults.find(effect.name + "." + declaration.name);
          own != benchmark_->effect_defaults.end())
        declaration.default_value = own->second;
  return declarations;
}

void SceneReader::add_effect(const EffectDescription &effect, const Node *table, const Location &location) {
  std::erase_if(effects_, [&](const auto &other) { return other.first == effect.name; });
  effects_.emplace_back(effect.name, location);
  const auto declarations = effect_declarations(effect);
  const auto read = read_table(table,
                               {.declarations = declarations,
                                .name = "effects." + effect.name,
                                .title = fmt::format("[effects.{}]", effect.name),
                                .lists_allowed = false,
                                .other_keys = {}},
                               homes_, table != nullptr ? table->location : here(), diagnostics_);
  scene_.effect_parameters[effect.name] = std::move(read.combinations().front().parameters);
}

void SceneReader::read_time() {
  const Node *node = table("time");
  if (node != nullptr && benchmark_ != nullptr && benchmark_->time.empty())
    return diagnostics_.error(node->location, "time", fmt::format("the benchmark '{}' knows no time", benchmark_->name),
                              "remove this table");
  if (benchmark_ == nullptr)
    return;
  time_ = read_table(
      node,
      {.declarations = benchmark_->time, .name = "time", .title = "[time]", .lists_allowed = false, .other_keys = {}},
      homes_, here(), diagnostics_);
  const auto given = [&](const char *key) { return node != nullptr && node->find(key) != nullptr; };
  if (given("step") && given("cfl"))
    diagnostics_.error(node->find("step")->key_location, "time.step", "'step' and 'cfl' both say how long a step is",
                       "remove one of them");
}

} // namespace comparisons::scene
