#pragma once

#include "comparisons/problems/plane_problem.h"

namespace comparisons::benchmarks::plate_with_hole {

/// Kirsch's solution: an infinite plate with a hole of the given radius around the origin, free of traction, under the
/// stress sigma_11 = `stress` (Pa) far away.
///
/// Displacement as in Zhang & Batra 2008, (6.18), with a misprint mended: the third terms, with cos 3 theta and
/// sin 3 theta, have b^2 / r, not b^2 / r^2. E and nu bar are those of plane strain or plane stress. The stress is
/// that of (6.18) and of Batra & Zhang 2008, (4.7), in x1 and x2.
problems::ExactSolution kirsch(double radius, double stress, const problems::Material &material);

} // namespace comparisons::benchmarks::plate_with_hole
