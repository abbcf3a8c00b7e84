#pragma once

#include "comparisons/scene/parameters.h"

#include <map>
#include <string>
#include <vector>

namespace comparisons::scene {

/// Parameters without a scene: the default values of keys, with some of them given.
Parameters default_parameters(const std::vector<Declaration> &declarations, const std::map<std::string, Value> &given);

} // namespace comparisons::scene
