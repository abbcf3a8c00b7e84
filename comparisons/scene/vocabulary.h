#pragma once

#include "comparisons/scene/declaration.h"
#include "comparisons/scene/diagnostics.h"
#include "comparisons/scene/scene.h"

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace comparisons::scene {

/// What a method or benchmark sees when it checks a cell of a scene before any computing.
struct CheckContext {
  const Parameters &material;
  const Parameters &problem;
  const Parameters &method;
  const Level &level;
  /// Key prefix for diagnostics about the method, e.g. "method[2]".
  std::string method_key;
  /// Effects that the scene calls for.
  std::span<const std::string> effects = {};
  /// Their parameters, by the effect's name; null in a context made by hand.
  const std::map<std::string, Parameters> *effect_parameters = nullptr;
  /// [time]; null if the benchmark knows no time.
  const Parameters *time = nullptr;
};

using Check = std::function<void(const CheckContext &, Diagnostics &)>;

/// A method as the scene reader knows it.
struct MethodDescription {
  std::string name;
  std::string meaning;
  std::vector<Declaration> parameters;
  /// Effects that it can do.
  std::vector<std::string> effects;
  /// Cross-checks between keys; may be empty. Called for every variant, method and level;
  /// the same finding is reported once.
  Check check;
};

/// A physical term that a scene may call for, with its own keys.
struct EffectDescription {
  std::string name;
  std::string meaning;
  /// Keys of the table [effects.<name>].
  std::vector<Declaration> parameters = {};
};

/// A benchmark as the scene reader knows it.
struct BenchmarkDescription {
  std::string name;
  std::string meaning;
  std::vector<Declaration> problem;
  /// With the paper's values as defaults.
  std::vector<Declaration> material;
  /// Effects that are active when a scene has no [effects] table.
  std::vector<std::string> effects;
  /// Checks problem, material and level (the context's `method` is empty).
  Check check;
  /// Methods of this benchmark alone; empty: those of the vocabulary.
  std::vector<MethodDescription> methods = {};
  /// Reads the files that a scene names and checks what is in them, before any computing; the findings and what was
  /// read (Scene::resolved) go to the scene. May be empty.
  std::function<void(Scene &, Diagnostics &)> resolve = {};
  /// The problem is the user's own, in [geometry] and the tables with it.
  bool own_geometry = false;
  /// 1: levels are one count; 2: "16x4"; a spacing is allowed for both.
  int counts_per_level = 2;
  /// Keys of [time] (scene/time_keys.h); empty: the benchmark knows no time.
  std::vector<Declaration> time = {};
  /// Its own defaults of effects' keys, by "artificial_viscosity.linear".
  std::map<std::string, Value> effect_defaults = {};
  /// What `study.analysis` may be; the first is the default.
  std::vector<std::string> analyses = {"static"};
};

/// One of a closed list of names with a line of meaning.
struct NamedMeaning {
  std::string name;
  std::string meaning;
};

/// All names that a scene may use; assembled from the visible tables of methods, benchmarks,
/// kernels, bases and effects. Passed as an argument, never global.
struct Vocabulary {
  std::vector<MethodDescription> methods;
  std::vector<BenchmarkDescription> benchmarks;
  std::vector<EffectDescription> effects;
  std::vector<NamedMeaning> kernels;
  std::vector<NamedMeaning> bases;
  std::vector<NamedMeaning> formats;
};

} // namespace comparisons::scene
