#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::detonation {

/// Plane detonation of a slab of TNT, Liu, Liu & Lam 2003, section 4.2: a front x = D t releases the energy of the
/// explosive at rest in 0 < x < length; x = 0 is a wall or free. Errors against the wave of Taylor, means of
/// |value - exact| over the products (x <= D t) weighted with the particles' volumes: `pressure_l1` (Pa), `density_l1`
/// (kg/m^3), `velocity_l1` (m/s) at the end of the run; of earlier snapshots k as quantities "..._snapshot_k".
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::detonation
