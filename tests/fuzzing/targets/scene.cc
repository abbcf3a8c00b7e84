#include "targets.h"

#include "comparisons/scene/time_keys.h"
#include "unit/scene/small_vocabulary.h"

#include <nlohmann/json.hpp>

namespace fuzzing {

namespace {

using namespace comparisons::scene;

/// With a problem in a file of its own, whose mesh is not looked for, so that all tables of a scene are read.
Vocabulary vocabulary() {
  Vocabulary all = scene_tests::small_vocabulary();
  BenchmarkDescription geometry;
  geometry.name = "geometry";
  geometry.meaning = "a geometry of one's own";
  geometry.material = all.benchmarks.front().material;
  geometry.effects = {"elasticity", "body_force"};
  geometry.own_geometry = true;
  geometry.counts_per_level = 1;
  all.benchmarks.push_back(std::move(geometry));
  return all;
}

} // namespace

void scene(std::string_view bytes) {
  static const Vocabulary all = vocabulary();
  const auto result = read_scene_text(std::string(bytes), "beam.toml", {}, all);
  require(result.scene.has_value() != result.diagnostics.has_errors(), "a text is a scene or has an error");
  for (const auto &finding : result.diagnostics.all())
    require(!finding.message.empty(), "every finding has a message");
  if (!result.scene)
    return;
  require(!to_json(*result.scene).dump().empty(), "a scene can be written as JSON");
  for (const auto &method : result.scene->methods)
    require(!method.levels.empty(), "every method has a level");
}

} // namespace fuzzing
