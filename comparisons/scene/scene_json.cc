#include "comparisons/scene/geometry_tables.h"
#include "comparisons/scene/reader.h"

namespace comparisons::scene {

namespace {

nlohmann::ordered_json to_json(const Value &value) {
  return std::visit([](const auto &v) { return nlohmann::ordered_json(v); }, value);
}

nlohmann::ordered_json to_json(const Parameters &parameters) {
  auto json = nlohmann::ordered_json::object();
  for (const Parameter &parameter : parameters.all())
    json[parameter.declaration.name] = to_json(parameter.value);
  return json;
}

nlohmann::ordered_json to_json(const std::vector<Level> &levels) {
  auto json = nlohmann::ordered_json::array();
  for (const Level &level : levels)
    json.push_back(level.text);
  return json;
}

nlohmann::ordered_json to_json(const std::vector<PlacedTable> &tables) {
  auto json = nlohmann::ordered_json::array();
  for (const PlacedTable &table : tables)
    json.push_back(to_json(table.keys));
  return json;
}

} // namespace

nlohmann::ordered_json to_json(const Scene &scene) {
  nlohmann::ordered_json json;
  json["schema"] = 1;
  json["title"] = scene.title;
  json["benchmark"] = scene.benchmark;
  json["name"] = scene.name;
  json["file"] = scene.file;
  json["hash"] = scene.hash;
  json["problem"] = nlohmann::ordered_json::array();
  for (const ProblemVariant &variant : scene.problems)
    json["problem"].push_back({{"label", variant.label}, {"parameters", to_json(variant.parameters)}});
  json["material"] = to_json(scene.material);
  if (scene.geometry != nullptr) {
    const GeometryTables &tables = *scene.geometry;
    json["geometry"] = to_json(tables.geometry.keys);
    json["materials"] = to_json(tables.materials);
    json["boundaries"] = to_json(tables.boundaries);
    json["reference"] = to_json(tables.reference.keys);
    json["quantities"] = to_json(tables.quantities);
    if (tables.body_force)
      json["body_force"] = to_json(tables.body_force->keys);
    if (tables.thermal_expansion)
      json["thermal_expansion"] = to_json(tables.thermal_expansion->keys);
  }
  json["effects"] = scene.effects;
  for (const auto &[effect, parameters] : scene.effect_parameters)
    if (!parameters.all().empty())
      json["effect_parameters"][effect] = to_json(parameters);
  if (!scene.time.all().empty())
    json["time"] = to_json(scene.time);
  json["methods"] = nlohmann::ordered_json::array();
  for (const MethodRequest &request : scene.methods) {
    nlohmann::ordered_json method{{"name", request.name},
                                  {"label", request.label},
                                  {"expect", request.expect},
                                  {"levels", to_json(request.levels)},
                                  {"parameters", to_json(request.parameters)}};
    if (!request.refused.empty())
      method["refused"] = request.refused;
    json["methods"].push_back(std::move(method));
  }
  json["study"] = nlohmann::ordered_json::object();
  json["study"]["levels"] = to_json(scene.levels);
  json["study"].update(to_json(scene.study));
  json["output"] = to_json(scene.output);
  json["output"]["formats"] = scene.formats;
  return json;
}

} // namespace comparisons::scene
