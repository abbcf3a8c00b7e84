#include "comparisons/benchmarks/benchmark_table.h"

#include "comparisons/benchmarks/bar_wave/problem.h"
#include "comparisons/benchmarks/cantilever/problem.h"
#include "comparisons/benchmarks/detonation/problem.h"
#include "comparisons/benchmarks/function_approximation/problem.h"
#include "comparisons/benchmarks/geometry/benchmark.h"
#include "comparisons/benchmarks/plate_vibration/problem.h"
#include "comparisons/benchmarks/plate_with_hole/problem.h"
#include "comparisons/benchmarks/rod_derivative/problem.h"
#include "comparisons/benchmarks/rod_static/problem.h"
#include "comparisons/benchmarks/rod_vibration/problem.h"
#include "comparisons/benchmarks/shock_tube/problem.h"
#include "comparisons/benchmarks/smoothing_functions/problem.h"
#include "comparisons/benchmarks/solvers/problem.h"
#include "comparisons/study/plane_experiment.h"

namespace comparisons::benchmarks {

namespace {

/// Benchmark of plane elasticity from its problem.
template <typename MakeProblem>
study::Benchmark plane(scene::BenchmarkDescription description, MakeProblem make_problem) {
  return {std::move(description), [make_problem](const scene::Scene &scene, const scene::ProblemVariant &variant,
                                                 const std::vector<methods::Method> &methods) {
            return study::make_plane_experiment(make_problem(scene, variant), methods, study::extras_of(scene));
          }};
}

} // namespace

std::vector<study::Benchmark> benchmark_table() {
  return {plane(cantilever::description(), cantilever::make_problem),
          plane(plate_with_hole::description(), plate_with_hole::make_problem),
          function_approximation::benchmark(),
          smoothing_functions::benchmark(),
          rod_derivative::benchmark(),
          rod_static::benchmark(),
          rod_vibration::benchmark(),
          plate_vibration::benchmark(),
          bar_wave::benchmark(),
          shock_tube::benchmark(),
          detonation::benchmark(),
          solvers::benchmark(),
          geometry::benchmark()};
}

} // namespace comparisons::benchmarks
