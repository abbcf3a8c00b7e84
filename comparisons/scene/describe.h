#pragma once

#include "comparisons/scene/scene.h"
#include "comparisons/scene/vocabulary.h"

#include <span>
#include <string>

namespace comparisons::scene {

/// A table of keys as aligned text: name, type or unit, default, allowed values, meaning.
std::string describe_declarations(std::span<const Declaration> declarations);

/// The effects that the scene calls for, and those that are absent: not computed, not allocated.
std::string describe_effects(const Scene &scene, const Vocabulary &vocabulary);

/// "number", "pressure [Pa]", "whole number", "one of", ...
std::string type_text(const Declaration &declaration);
/// "226.9 GPa", "true"; "required" or "-" without a default.
std::string default_text(const Declaration &declaration);
/// "greater than 0", "gauss, super_gauss"; empty if everything of the type is allowed.
std::string allowed_text(const Declaration &declaration);

/// A value as it is written in a scene: `"226.9 GPa"`, `0.3`, `[0, 1]`, `true`.
std::string toml_text(const Value &value, const Dimension &dimension);

/// A commented scene to start from: the benchmark's keys with their defaults and every method with
/// its keys as comments. read_scene_text accepts it.
/// @param methods those that the benchmark is meant for; their order is kept.
/// @param levels as in [study] levels, e.g. {"\"16x4\"", "\"31x7\""}; empty: two that fit the form.
std::string initial_scene(const BenchmarkDescription &benchmark, std::span<const MethodDescription> methods,
                          std::span<const std::string> levels = {});

} // namespace comparisons::scene
