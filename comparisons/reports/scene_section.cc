#include "comparisons/reports/scene_section.h"

#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

namespace comparisons::reports {

namespace {

using Json = nlohmann::ordered_json;

/// Results may come from another program: what is not there is not shown.
std::string text_of(const Json &scene, const char *key) {
  const auto found = scene.is_object() ? scene.find(key) : scene.end();
  return found != scene.end() && found->is_string() ? found->get<std::string>() : no_number;
}

std::string study_of(const Json &scene, const char *key) {
  const auto study = scene.is_object() ? scene.find("study") : scene.end();
  if (study == scene.end() || !study->is_object() || !study->contains(key))
    return no_number;
  const Json &value = (*study)[key];
  return value.is_number() || value.is_string() ? (value.is_string() ? value.get<std::string>() : value.dump())
                                                : no_number;
}

} // namespace

void append_scenes(Document &document, const Results &results) {
  const Json scenes = results.scene.is_array() ? results.scene : Json::array({results.scene});
  Table table({{"benchmark", Align::left},
               {"scene", Align::left},
               {"title", Align::left, true},
               {"threads"},
               {"repeats"},
               {"seed"},
               {"hash", Align::left}});
  for (const Json &scene : scenes)
    if (scene.is_object() && scene.contains("hash"))
      table.add_row({text_of(scene, "benchmark"), text_of(scene, "name"), text_of(scene, "title"),
                     study_of(scene, "threads"), study_of(scene, "repeats"), study_of(scene, "seed"),
                     text_of(scene, "hash")});
  if (table.rows().empty())
    return;
  document.push_back(Heading{2, "Scenes"});
  document.push_back(std::move(table));
}

} // namespace comparisons::reports
