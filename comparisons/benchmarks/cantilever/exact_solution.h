#pragma once

#include "comparisons/problems/plane_problem.h"

#include <string>

namespace comparisons::benchmarks::cantilever {

/// Size and load of the plate; `origin` is its lower left corner.
struct Plate {
  double length = 1;       ///< L1, m
  double width = 0.2;      ///< L2, m
  double force = 1e6;      ///< F0, N/m
  problems::Point2 origin; ///< m
};

/// An exact solution with the body force that it needs; an empty one means none.
struct Solution {
  problems::ExactSolution exact;
  problems::VectorField body_force;
};

/// Batra & Zhang 2008, (4.2) and (4.3), with E0, nu0 of (3.5): right as printed, in plane stress and
/// plane strain.
Solution bending(const Plate &plate, const problems::Material &material);

/// u = (F0 / E0) (2 x + y / 2, x - 3 y / 2) with x = (x1 - origin) / L2: uniform strain.
Solution linear(const Plate &plate, const problems::Material &material);

/// u = (F0 / E0) (sin(k x) cosh(y), cos(k x) e^y / 2) with k = pi L2 / L1 (3/2), x and y in units of
/// L2: no polynomial, not in the space of any method.
Solution trigonometric(const Plate &plate, const problems::Material &material);

} // namespace comparisons::benchmarks::cantilever
