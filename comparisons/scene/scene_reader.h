#pragma once

#include "comparisons/scene/document.h"
#include "comparisons/scene/levels.h"
#include "comparisons/scene/scene.h"
#include "comparisons/scene/table_reader.h"
#include "comparisons/scene/vocabulary.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace comparisons::scene {

/// One [[method]] as read, before its lists are expanded.
struct MethodTable {
  /// Null if the name is missing or unknown.
  const MethodDescription *description = nullptr;
  /// "method[2]"
  std::string key;
  /// The key `label`, else the name.
  std::string label;
  Location label_location;
  std::string expect = "ok";
  ResolvedTable table;
  /// Its own levels, else the study's.
  std::vector<Level> levels;
  Location location;
  std::string refused;
};

/// Validates a document against the vocabulary and builds the scene. Internal to this folder: the
/// entry points are in reader.h.
class SceneReader {
public:
  SceneReader(const Node &root, std::string file, const Vocabulary &vocabulary, Diagnostics &diagnostics);

  /// The scene, or nothing if there is an error.
  std::optional<Scene> read();

private:
  // scene_reader.cc
  void read_top();
  void read_reserved_tables();
  void read_schema();
  void read_title();
  void read_benchmark();
  void read_problem_and_material();
  void read_study();
  void read_output();
  void read_formats(const Node *output);
  std::vector<KeyHome> key_homes() const;

  // geometry_reader.cc
  bool has_geometry() const;
  void read_geometry();

  // effects_reader.cc
  void read_effects();
  void read_effect(const Entry &entry);
  /// The keys of an effect with the benchmark's defaults.
  std::vector<Declaration> effect_declarations(const EffectDescription &effect) const;
  void add_effect(const EffectDescription &effect, const Node *table, const Location &location);
  void read_time();

  // method_reader.cc
  void read_methods();
  void read_method(const Node &node, std::size_t index);
  void read_method_name(const Node &node, MethodTable &method);
  void read_common_keys(const Node &node, MethodTable &method);
  void match_effects();
  void expand();
  void check_labels();
  void require_levels();

  // cross_checks.cc
  void cross_check();

  /// The table, or null if the scene has none (or it is no table).
  const Node *table(std::string_view name) const;
  Location here() const { return {.file = file_}; }
  LevelForm level_form() const;

  const Node &root_;
  std::string file_;
  const Vocabulary &vocabulary_;
  Diagnostics &diagnostics_;

  std::vector<KeyHome> homes_;
  const BenchmarkDescription *benchmark_ = nullptr;
  ResolvedTable problem_;
  ResolvedTable material_;
  ResolvedTable time_;
  ResolvedTable study_;
  ResolvedTable output_;
  std::vector<std::pair<std::string, Location>> effects_;
  bool study_has_levels_ = false;
  std::vector<MethodTable> methods_;
  /// For each request of the scene, the index of its table.
  std::vector<std::size_t> owners_;
  Scene scene_;
};

} // namespace comparisons::scene
