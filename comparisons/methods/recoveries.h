#pragma once

#include "comparisons/methods/particle_points.h"

#include <map>
#include <string>
#include <vector>

namespace comparisons::methods {

/// What was done so that a cell has a solution: counted, by the names of quantities, and said.
struct Recoveries {
  std::map<std::string, double> quantities;
  std::vector<std::string> warnings;
};

/// Those of the particles: a lower order, larger smoothing lengths. Nothing where nothing was done.
Recoveries recoveries_of(const Prepared &prepared);

} // namespace comparisons::methods
