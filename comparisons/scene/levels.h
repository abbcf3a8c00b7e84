#pragma once

#include "comparisons/scene/document.h"
#include "comparisons/scene/scene.h"

#include <string>
#include <vector>

namespace comparisons::scene {

/// Most cells (variant x method x level) of one scene.
inline constexpr std::size_t most_cells = 100000;

/// Which forms of levels a benchmark takes.
struct LevelForm {
  /// 0 if the benchmark is unknown: every form passes.
  int counts_per_level = 0;
  std::string benchmark;
  /// "mesh" and "mesh/2" are levels too.
  bool meshes = false;
};

/// Reads the value of a key `levels`: a list of counts (188), pairs ("16x4" or [16, 4]) or spacings
/// ("5 mm"); a single count or text stands for a list of one. Each count is at least 2; no level
/// stands twice. Findings go to `diagnostics`; the valid levels are returned.
/// @param key for the findings, e.g. "study.levels".
std::vector<Level> read_levels(const Node &node, const LevelForm &form, const std::string &key,
                               Diagnostics &diagnostics);

/// What a level may be, for messages: `"16x4", [16, 4] or a spacing such as "5 mm"`.
std::string allowed_levels(const LevelForm &form);

} // namespace comparisons::scene
