#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::plate_vibration {

/// A rectangular plate that moves in its own plane: free, clamped all around, or clamped on the left.
///
/// `analysis = "modes"`: the six lowest elastic frequencies beside those of fine elements of degree 4, as errors
/// `frequency_<k>_relative`; how far from zero rigid motions are, and what of the spectrum is complex or negative.
/// `analysis = "transient"`: the plate starts at rest and takes a shear load on its right end at once; the end's
/// deflection, energies and what they lose or gain.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::plate_vibration
