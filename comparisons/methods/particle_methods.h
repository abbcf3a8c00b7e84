#pragma once

#include "comparisons/methods/method_table.h"
#include "comparisons/methods/particle_points.h"
#include "comparisons/methods/recoveries.h"

#include "meshless/elasticity/equations_of_motion.h"
#include "meshless/elasticity/linear_system.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace comparisons::methods {

/// Collocation with the basis' second derivatives, Batra & Zhang 2008, section 3.1.
Method strong();
/// MLPG with directly found derivatives, section 3.2.1.
Method weak1();
/// MLPG with differentiated shape functions, section 3.2.2.
Method weak2();

/// The strong form inside with weak1's rows on the boundary, where collocation is inaccurate.
Method hybrid();

/// Displacement and pressure, both unknown: meshless::elasticity::mixed_form.
Method mixed();

struct ParticleMotion {
  meshless::elasticity::EquationsOfMotion equations;
  Recoveries recoveries;
};

/// The equations of motion of one of these methods, by its name, with the densities of the statement's materials.
/// @throws Refused if a moment matrix is singular, or what the method throws
ParticleMotion equations_of_motion(const SolveRequest &request, const std::string &method);

/// The linear system of a weak form, to be solved elsewhere.
class WeakSystem {
public:
  WeakSystem(Prepared prepared, meshless::elasticity::weak_form::Parameters parameters,
             meshless::elasticity::LinearSystem equations)
      : prepared_(std::move(prepared)), parameters_(std::move(parameters)), equations_(std::move(equations)) {}

  const meshless::elasticity::LinearSystem &equations() const { return equations_; }
  std::span<const problems::Point2> positions() const { return prepared_.particles->positions(); }
  /// The field of coefficients, as if the method had found them.
  std::unique_ptr<Solution> solution(std::vector<double> coefficients) const;

private:
  Prepared prepared_;
  meshless::elasticity::weak_form::Parameters parameters_;
  meshless::elasticity::LinearSystem equations_;
};

/// Of the order asked for, whatever lower_order says.
/// @param method weak1, weak2 or hybrid
/// @throws as the method does; basis::SingularMomentMatrix
std::unique_ptr<WeakSystem> weak_system(const SolveRequest &request, const std::string &method);

} // namespace comparisons::methods
