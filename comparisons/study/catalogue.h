#pragma once

#include "comparisons/methods/method_table.h"
#include "comparisons/scene/vocabulary.h"
#include "comparisons/study/experiment.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace comparisons::study {

/// A benchmark: its keys, and how its experiment is made from a scene. Benchmarks of plane elasticity
/// use the methods of the catalogue; others have their own (scene::BenchmarkDescription::methods).
struct Benchmark {
  scene::BenchmarkDescription description;
  std::function<std::unique_ptr<Experiment>(const scene::Scene &, const scene::ProblemVariant &,
                                            const std::vector<methods::Method> &)>
      make_experiment;
  /// Called with all cells of a scene once they are measured, to add what needs several levels, such as
  /// slopes; may be empty.
  std::function<void(std::vector<reports::Cell> &)> finish = {};
};

/// All methods and benchmarks of the program; passed as an argument, so that tests can add their own.
struct Catalogue {
  std::vector<methods::Method> methods;
  std::vector<Benchmark> benchmarks;
};

/// The shipped catalogue: the tables of methods and benchmarks.
Catalogue shipped_catalogue();

/// The names a scene may use.
scene::Vocabulary vocabulary_of(const Catalogue &catalogue);

} // namespace comparisons::study
