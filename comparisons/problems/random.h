#pragma once

#include "meshless/cloud_generation/random.h"

namespace comparisons::problems {

using Random = meshless::cloud_generation::Random;

} // namespace comparisons::problems
