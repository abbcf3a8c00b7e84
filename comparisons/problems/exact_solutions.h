#pragma once

#include "comparisons/problems/plane_problem.h"

namespace comparisons::problems {

/// An elliptic hole with the semi-axes a (in x) and b (in y) around the origin of an infinite plate under the tension S
/// in y: the largest stress is S (1 + 2 a / b), at (a, 0) and (-a, 0).
///
/// Complex potentials on the plane outside of the unit circle, z = R (zeta + m / zeta), R = (a + b) / 2,
/// m = (a - b) / (a + b):
///   phi = S R / 4 [zeta - (2 + m) / zeta],
///   psi = S R / 2 [zeta - (1 + (1 + m + m^2) zeta^2) / (zeta (zeta^2 - m))],
/// from Muskhelishvili, Some Basic Problems of the Mathematical Theory of Elasticity, section 82a, with the tension in
/// y and the two terms that are infinite for a circle (m = 0) put together. The stress at the hole is Inglis' (1913).
ExactSolution elliptic_hole(double a, double b, double stress, const Material &material);

/// The strongest symmetric singularity of a corner of 270 degrees with faces free of traction, at the origin of the
/// plane without its third quadrant (x < 0, y < 0): the stress goes like r^(lambda - 1), lambda = .544483737.
///
/// Szabo & Babuska, Finite Element Analysis, section 10.1, turned by 45 degrees; `stress` is A lambda of their
/// equations, in Pa at r = 1 m: half of the sum of the normal stresses on the symmetry line there, divided by two.
ExactSolution reentrant_corner(double stress, const Material &material);

/// The exponent of the above: the root near .5445 of sin(3 pi lambda / 2) + lambda sin(3 pi / 2) = 0.
double reentrant_corner_exponent();

} // namespace comparisons::problems
