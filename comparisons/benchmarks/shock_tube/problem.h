#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::shock_tube {

/// Riemann problems of an ideal gas, Liu, Liu & Lam 2003, section 4.1, and others with exact solutions. Two states meet
/// at x = 0. Errors at the end of the run: `density_l1`, `pressure_l1`, `velocity_l1`, `energy_l1`, the means of
/// |value - exact| over the window |x| <= `window` (of particles weighted with their volumes m / rho), in SI.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::shock_tube
