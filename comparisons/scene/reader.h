#pragma once

#include "comparisons/scene/scene.h"
#include "comparisons/scene/vocabulary.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace comparisons::scene {

struct ReadResult {
  /// Present if there is no error.
  std::optional<Scene> scene;
  Diagnostics diagnostics;
};

/// Reads and validates a scene file completely: all errors of the file in one pass, each with
/// file, line, column, what was found, what is allowed, and a suggestion for near misses.
/// @param overrides `KEY=VALUE` of --set, applied before validation.
ReadResult read_scene(const std::filesystem::path &file, std::span<const std::string> overrides,
                      const Vocabulary &vocabulary);

/// The same for a text in memory; `file` is only printed.
ReadResult read_scene_text(const std::string &text, const std::string &file, std::span<const std::string> overrides,
                           const Vocabulary &vocabulary);

/// The scene as resolved (all defaults filled in, SI units), for results.json.
nlohmann::ordered_json to_json(const Scene &scene);

/// Declarations of [study] and [output], for `explain`, `init` and the reference page.
std::vector<Declaration> study_declarations();
std::vector<Declaration> output_declarations();

} // namespace comparisons::scene
