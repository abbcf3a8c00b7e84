#pragma once

#include "comparisons/scene/scene.h"

#include <string>

namespace comparisons::program {

/// The regions, boundaries and levels of a scene with a geometry of its own, as text for `petrov explain`.
std::string describe_geometry(const scene::Scene &scene);

} // namespace comparisons::program
