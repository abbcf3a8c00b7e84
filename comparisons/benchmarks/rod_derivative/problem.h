#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::rod_derivative {

/// First and second derivative of a given function from its values at the particles of a rod; Asprone, Auricchio &
/// Reali 2010, section 5.1.
///
/// Errors are largest absolute differences at the particles: `second_derivative_max`, `first_derivative_max`, and the
/// same with `_inside` over the middle half of the rod, where no kernel reaches an end.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::rod_derivative
