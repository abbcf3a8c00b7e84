#pragma once

#include "comparisons/scene/reader.h"

#include <string>
#include <vector>

namespace scene_tests {

/// A made-up vocabulary: two benchmarks (one with two counts a level, one with one), three methods.
comparisons::scene::Vocabulary small_vocabulary();

/// A valid scene of the benchmark "beam", one key a line.
std::string valid_scene();

comparisons::scene::ReadResult read(const std::string &text, const std::vector<std::string> &overrides = {});

/// All findings as text.
std::string findings(const std::string &text, const std::vector<std::string> &overrides = {});

/// The valid scene with the first `from` replaced by `to`.
std::string with(const std::string &from, const std::string &to);

} // namespace scene_tests
