#pragma once

#include "comparisons/scene/scene.h"

#include <string>

namespace comparisons::program {

/// The regions, boundaries and levels of a scene with a geometry of its own, as text for `petrov explain`.
std::string describe_geometry(const scene::Scene &scene);

/// The keys of the tables that such a scene has.
std::string describe_geometry_keys();

} // namespace comparisons::program
