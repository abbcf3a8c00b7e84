#pragma once

#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/vocabulary.h"

#include <memory>

namespace comparisons::benchmarks::plate_with_hole {

/// Keys, defaults and checks of the benchmark.
scene::BenchmarkDescription description();

/// Plate with a circular hole under tension, Batra & Zhang 2008, section 4.2, and Zhang & Batra 2008, section 6.3: a
/// quarter, with symmetry on the two axes, the hole free, and the tractions of Kirsch's solution on the outer edges.
/// A level is a number of particles, or the distance of particles at the hole.
std::unique_ptr<problems::PlaneProblem> make_problem(const scene::Scene &scene, const scene::ProblemVariant &variant);

} // namespace comparisons::benchmarks::plate_with_hole
