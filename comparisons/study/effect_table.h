#pragma once

#include "comparisons/scene/vocabulary.h"

#include <vector>

namespace comparisons::study {

/// The closed list of effects with their keys; which method can do which is the methods' word.
const std::vector<scene::EffectDescription> &effect_table();

} // namespace comparisons::study
