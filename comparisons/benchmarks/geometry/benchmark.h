#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::geometry {

/// The user's own geometry as an entry of the table: a scene with [geometry] is of this 'benchmark'.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::geometry
