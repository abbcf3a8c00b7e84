#pragma once

#include "comparisons/scene/document.h"
#include "comparisons/scene/vocabulary.h"

#include <span>
#include <string>
#include <vector>

namespace comparisons::scene {

/// The keys that every [[method]] has besides its own: name, label, levels, expect.
std::vector<std::string> common_method_keys();

/// Applies `KEY=VALUE` of --set to the document, in their order, before it is validated:
/// `title`, `material.nu`, `study.levels`, `effects.inertia`, `method.support` (every method with
/// that key), `method.weak1.support` (every method of that name or label), `method.2.support` or
/// `method[2].support` (counted from 0). VALUE is read as a TOML value, else as a text. New values
/// are placed at "--set KEY=VALUE", so that later findings name the override.
void apply_overrides(Node &root, std::span<const std::string> overrides, const Vocabulary &vocabulary,
                     Diagnostics &diagnostics);

} // namespace comparisons::scene
