#pragma once

#include "comparisons/scene/diagnostics.h"
#include "comparisons/scene/parameters.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace comparisons::scene {

/// One resolution: counts along the axes ("16x4"), one count (188), a spacing in metres ("5 mm"), or the mesh
/// of one's own geometry ("mesh") and its refinements ("mesh/2", "mesh/4").
struct Level {
  std::vector<int> counts;
  std::optional<double> spacing;
  /// How often the geometry's mesh is refined: 0 for "mesh", 1 for "mesh/2".
  std::optional<int> refinements = {};
  /// As printed in tables: "16x4", "188", "0.005 m".
  std::string text;

  friend bool operator==(const Level &a, const Level &b) { return a.text == b.text; }
};

/// One method with one combination of parameters: a row of cells, one a level.
struct MethodRequest {
  std::string name;
  /// Unique within the scene: the key `label`, or the name with the keys that vary
  /// ("weak1", "weak1 order=2").
  std::string label;
  Parameters parameters;
  /// The method's own levels, else the study's.
  std::vector<Level> levels;
  /// "ok", "refused" or "failed": the outcome that the scene declares as expected.
  std::string expect = "ok";
  /// If not empty: the scene calls for an effect that this method cannot do; its cells are
  /// refused with this reason before any computing.
  std::string refused;
  /// Place of the [[method]] header.
  Location location;
};

/// The problem's parameters; a list in [problem] makes one variant per combination.
struct ProblemVariant {
  Parameters parameters;
  /// Empty if nothing varies, else "jitter=0.25".
  std::string label;
};

struct GeometryTables;

struct Scene {
  std::string file;
  std::string title;
  std::string benchmark;
  /// Name of the scene within its benchmark: the file's stem.
  std::string name;
  Parameters material;
  /// The tables of a geometry of one's own (geometry_tables.h); null for a benchmark.
  std::shared_ptr<const GeometryTables> geometry;
  /// What the benchmark's `resolve` found in files, kept for the experiment; null if it has none.
  std::shared_ptr<const void> resolved;
  std::vector<ProblemVariant> problems;
  /// Names of the effects called for, sorted.
  std::vector<std::string> effects;
  /// The keys of each effect called for, by its name.
  std::map<std::string, Parameters> effect_parameters;
  /// [time]; empty if the benchmark knows no time.
  Parameters time;
  std::vector<MethodRequest> methods;
  /// Without the levels.
  Parameters study;
  /// [study] levels; empty if every method has its own.
  std::vector<Level> levels;
  /// Without the formats.
  Parameters output;
  /// [output] formats, validated.
  std::vector<std::string> formats;
  /// Hash (FNV-1a, 64 bit, hexadecimal) of the file's bytes and the overrides.
  std::string hash;
};

} // namespace comparisons::scene
