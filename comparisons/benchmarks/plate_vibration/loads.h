#pragma once

#include "comparisons/benchmarks/plate_vibration/plates.h"

namespace comparisons::benchmarks::plate_vibration {

/// Keys of [problem] for the loads: what acts on the right side, and what the effects body_force and thermal_expansion
/// act with.
std::vector<scene::Declaration> load_keys();

/// Puts the loads into the statement of a plate with its lower corner at the origin: the shear on side 1 always, body
/// force and free strain if the scene calls for the effects.
void add_loads(const scene::Scene &scene, const scene::Parameters &problem, problems::PlaneStatement &statement);

/// The forces of `add_loads` as points and forces (N/m) whose work is that of the loads. Free strain e is the load
///   int beta e div u = int over the boundary of beta e n u - int beta grad e u,
/// beta the thermal modulus of the material.
/// @param inside a quadrature of the plate
void add_forces(const scene::Scene &scene, const scene::Parameters &problem, const problems::PlaneStatement &statement,
                const problems::Quadrature &inside, Watch &watch);

/// The first of the two effects that a scene calls for, or nothing.
std::optional<std::string> effect_with_load(const scene::Scene &scene);

} // namespace comparisons::benchmarks::plate_vibration
