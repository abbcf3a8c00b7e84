#pragma once

#include "comparisons/methods/lower_order.h"
#include "comparisons/methods/method_table.h"
#include "comparisons/methods/particle_keys.h"

#include "meshless/basis/shape_functions.h"
#include "meshless/cloud/particles.h"
#include "meshless/elasticity/plane_problem.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"

#include <memory>
#include <optional>

namespace comparisons::methods {

/// The particles of a cell with all that a form needs to know of them.
struct Prepared {
  meshless::elasticity::PlaneProblem problem;
  bool regular = true;
  std::shared_ptr<const meshless::cloud::Particles<2>> particles;
  std::shared_ptr<const meshless::basis::ShapeFunctions<2>> basis;
  OrderTaken order;
  double test_radius = 0;
  std::size_t n_enlarged = 0;
  double largest_factor = 1;
  /// Of a weak form, which holds the body by a penalty; nothing: by collocation.
  std::optional<meshless::elasticity::weak_form::Parameters> weak;
  double points_seconds = 0;
  double enlarge_seconds = 0;
};

/// @throws std::invalid_argument for what particles cannot do; basis::SingularMomentMatrix
Prepared prepare(const SolveRequest &request, Form form);

} // namespace comparisons::methods
