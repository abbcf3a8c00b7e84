#pragma once

#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/vocabulary.h"

#include <memory>

namespace comparisons::benchmarks::cantilever {

/// Keys, defaults and checks of the benchmark.
scene::BenchmarkDescription description();

/// Cantilever plate of Batra & Zhang 2008, section 4.1: length L1, width L2, displacement prescribed
/// on the left edge, traction on the other three, both from an exact solution.
///
/// `solution` chooses which:
/// - bending: (4.2), (4.3), a cubic polynomial: the end load F0 (force per thickness);
/// - linear: a constant strain with shear and rotation: the patch test;
/// - trigonometric: a smooth solution that is no polynomial, with its body force.
///
/// @throws std::invalid_argument for a level that does not fit
std::unique_ptr<problems::PlaneProblem> make_problem(const scene::Scene &scene, const scene::ProblemVariant &variant);

} // namespace comparisons::benchmarks::cantilever
