#pragma once

#include "comparisons/scene/declaration.h"

#include <vector>

namespace comparisons::scene {

/// A benchmark's own defaults of [time].
struct TimeDefaults {
  double end = 1; ///< s
  double cfl = 0.5;
  std::int64_t snapshots = 1;
  /// What `cfl` multiplies, for the line of meaning.
  std::string cfl_meaning;
};

/// The keys of [time]: `end`, `cfl`, `step`, `snapshots`, `checkpoint_every`, `resume`.
std::vector<Declaration> time_declarations(const TimeDefaults &defaults);

} // namespace comparisons::scene
