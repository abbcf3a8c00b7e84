#pragma once

#include "comparisons/methods/solution.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/vocabulary.h"

#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

namespace comparisons::methods {

/// A cell that the method cannot do, by its own word: reported as refused, not as failed.
class Refused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// What a method is given for one cell. It sees the statement and the points or mesh of the level,
/// never the exact solution as such.
struct SolveRequest {
  const problems::PlaneStatement &statement;
  std::function<problems::Cloud()> cloud;
  std::function<problems::Mesh()> mesh;
  const scene::Parameters &parameters;
};

/// One way to solve a scene.
struct Method {
  scene::MethodDescription description;
  /// @throws Refused, or any std::exception for a failure
  std::function<std::unique_ptr<Solution>(const SolveRequest &)> solve;
  /// Looks at the particles and assembles the rows of a few, without solving; empty for a method that has none.
  /// @throws as solve
  std::function<CloudReport(const SolveRequest &)> inspect;
};

/// The one table of methods: strong, weak1, weak2, hybrid, mixed, fem.
std::vector<Method> method_table();

} // namespace comparisons::methods
