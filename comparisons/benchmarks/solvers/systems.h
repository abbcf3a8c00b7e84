#pragma once

#include "comparisons/methods/particle_methods.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/scene.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace comparisons::benchmarks::solvers {

/// The system of weak1 at one level, its tightest solution and what the discretisation leaves.
struct System {
  std::unique_ptr<methods::WeakSystem> weak;
  std::vector<double> solution;
  double discretisation_error = 0; ///< displacement_l2_relative of `solution`

  const meshless::elasticity::LinearSystem &equations() const { return weak->equations(); }
  std::size_t n_points() const { return weak->positions().size(); }
};

/// Systems of one problem, each assembled once.
class Systems {
public:
  /// @param name cantilever (with the trigonometric solution, which no basis represents) or plate_with_hole
  Systems(const std::string &name, std::int64_t order, std::int64_t seed);

  /// A level is a number of particles: on the cantilever the largest grid of squares with at most as many.
  const System &at(const scene::Level &level);
  std::int64_t n_points(const scene::Level &level) const;

private:
  std::unique_ptr<problems::PlaneProblem> problem_;
  scene::Parameters method_;
  bool grid_ = false;
  std::map<std::string, System> systems_;
};

} // namespace comparisons::benchmarks::solvers
