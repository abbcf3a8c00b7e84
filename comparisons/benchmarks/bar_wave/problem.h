#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::bar_wave {

/// Stress wave in a free elastic bar, Zhang & Batra 2008, section 6.4: a pressure of `stress` at x = length for
/// `duration`, then free; x = 0 is free. Errors at the end of the run: `stress_l1`, the mean of |sigma - exact| over
/// the particles (finite elements: the elements' middles), relative to `stress`.
///
/// With `case` = "stretched" instead Swegle's test: a stretched bar, held at both ends, with a small disturbance.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::bar_wave
