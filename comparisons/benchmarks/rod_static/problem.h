#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::rod_static {

/// Elastic rod under an axial load, fixed at x = 0 and free at x = length; Asprone, Auricchio & Reali 2010,
/// section 5.2:
///   -E u'' = b, u(0) = 0, u'(length) = 0.
///
/// Particles by collocation: the first row is u = 0, the last the method's own first derivative = 0. Errors are largest
/// absolute differences at the particles or vertices: `displacement_max` (m) and `strain_max`; for finite elements also
/// `displacement_max_between`, at ten places inside every element.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::rod_static
