#include "comparisons/benchmarks/plate_vibration/plates.h"

#include "comparisons/methods/fem.h"
#include "comparisons/methods/particle_methods.h"

#include "fem_reference/elasticity/plane_dynamics.h"

#include "meshless/dynamics/plane_motion.h"
#include "meshless/dynamics/violation.h"
#include "meshless/elasticity/field_energy.h"
#include "meshless/linear_algebra/generalized_eigenvalues.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comparisons::benchmarks::plate_vibration {

namespace {

namespace reference = fem_reference::elasticity;
using meshless::linear_algebra::Stopwatch;

/// The whole spectrum of a matrix that is not symmetric works like n^3: 800 rows take three seconds.
constexpr std::int64_t most_rows_for_all = 800;

std::vector<double> densities_of(const problems::PlaneStatement &statement) {
  std::vector<double> densities;
  for (const auto &region : statement.regions)
    densities.push_back(region.material.density);
  return densities;
}

reference::PlaneDynamicsOptions element_options(const methods::SolveRequest &request) {
  return {.degree = request.parameters.text("element").back() - '0',
          .mass = request.parameters.text("mass") == "lumped" ? reference::Mass::lumped : reference::Mass::consistent,
          .densities = densities_of(request.statement)};
}

std::map<std::string, double> phases_of(const reference::Seconds &s) {
  return {{"points", s.mesh}, {"neighbours", s.degrees_of_freedom}, {"assembly", s.assembly}, {"solve", s.solve}};
}

std::map<std::string, double> phases_of(const meshless::elasticity::SolveSeconds &s) {
  return {{"neighbours", s.neighbours}, {"basis", s.basis}, {"assembly", s.assembly}};
}

class ElementPlate final : public PlateEvolution {
public:
  ElementPlate(const methods::SolveRequest &request, const Watch &watch)
      : PlateEvolution(watch),
        motion_(methods::reference_problem(request.statement, request.mesh()), element_options(request),
                request.parameters.text("integration") == "newmark" ? reference::TimeIntegration::newmark
                                                                    : reference::TimeIntegration::central_difference,
                watch.damping.value_or(0)) {}

  double time() const override { return motion_.time(); }
  std::int64_t steps() const override { return motion_.steps(); }
  double stable_step() const override { return motion_.stable_step(); }
  double kinetic() const override { return motion_.kinetic_energy(); }
  double strain() const override { return motion_.strain_energy(); }
  double work() const override { return motion_.work(); }
  double tip() const override {
    reference::Vector u{};
    motion_.displacement({&watch().tip, 1}, {&u, 1});
    return u[1];
  }
  std::int64_t n_dofs() const override { return static_cast<std::int64_t>(motion_.n_dofs()); }
  std::int64_t nonzeros() const override { return static_cast<std::int64_t>(motion_.nonzeros()); }
  std::map<std::string, double> seconds() const override { return phases_of(motion_.seconds()); }
  meshless::dynamics::State state() override {
    meshless::dynamics::State all;
    for (const auto &[name, values] : motion_.state())
      all.push_back({name, values});
    return all;
  }
  void adopt_state() override { motion_.adopt_state(); }

private:
  void advance(double dt) override { motion_.step(dt); }

  reference::PlaneMotion motion_;
};

class ParticlePlate final : public PlateEvolution {
public:
  ParticlePlate(const methods::SolveRequest &request, const std::string &method, const Watch &watch)
      : ParticlePlate(methods::equations_of_motion(request, method), request, watch) {}

  ParticlePlate(methods::ParticleMotion motion, const methods::SolveRequest &request, const Watch &watch)
      : PlateEvolution(watch), recoveries_(std::move(motion.recoveries)),
        equations_(std::make_shared<const meshless::elasticity::EquationsOfMotion>(std::move(motion.equations))),
        motion_(equations_, options_of(request, watch)),
        energy_(*equations_, densities_of(request.statement),
                {watch.quadrature.points, watch.quadrature.weights, watch.force_points, watch.forces}),
        tip_(*equations_, densities_of(request.statement), {{}, {}, {watch.tip}, {{0, 1}}}) {}

  double time() const override { return motion_.time(); }
  std::int64_t steps() const override { return motion_.steps(); }
  double stable_step() const override { return motion_.stable_step(); }
  double kinetic() const override { return energy_.kinetic(motion_.velocity()); }
  double strain() const override { return energy_.strain(motion_.displacement()); }
  double work() const override { return energy_.work(motion_.displacement()); }
  double tip() const override { return tip_.work(motion_.displacement()); } // a unit force's work
  std::int64_t n_dofs() const override { return equations_->stiffness.n_rows(); }
  std::int64_t nonzeros() const override { return equations_->stiffness.nonzeros(); }
  std::map<std::string, double> seconds() const override { return phases_of(equations_->seconds); }
  methods::Recoveries recoveries() const override { return recoveries_; }
  meshless::dynamics::State state() override { return motion_.state(); }
  void adopt_state() override { motion_.adopt_state(); }

private:
  static meshless::dynamics::PlaneMotionOptions options_of(const methods::SolveRequest &request, const Watch &watch) {
    meshless::dynamics::PlaneMotionOptions options;
    if (request.parameters.text("integration") == "central_difference")
      options.integration = meshless::dynamics::TimeIntegration::central_difference;
    if (watch.damping)
      options.damping = meshless::effects::Damping{*watch.damping};
    return options;
  }

  void advance(double dt) override { motion_.step(dt); }

  methods::Recoveries recoveries_;
  std::shared_ptr<const meshless::elasticity::EquationsOfMotion> equations_;
  meshless::dynamics::PlaneMotion motion_;
  meshless::elasticity::FieldEnergy energy_;
  meshless::elasticity::FieldEnergy tip_;
};

Spectrum of_elements(const methods::SolveRequest &request, unsigned wanted) {
  const auto modes = reference::natural_frequencies(methods::reference_problem(request.statement, request.mesh()),
                                                    element_options(request), wanted);
  Spectrum result;
  result.squares.assign(modes.squares.begin(), modes.squares.end());
  result.symmetric = true;
  result.n_dofs = static_cast<std::int64_t>(modes.n_dofs);
  result.nonzeros = static_cast<std::int64_t>(modes.nonzeros);
  result.seconds = phases_of(modes.seconds);
  return result;
}

} // namespace

double growth_rate(const Spectrum &spectrum, double rounding) {
  double largest = 0;
  for (const auto &square : spectrum.squares)
    if (std::abs(square) > rounding)
      largest = std::max(largest, std::abs(std::sqrt(square).imag()));
  return largest;
}

Spectrum spectrum(const methods::SolveRequest &request, const std::string &method, unsigned wanted, double scale) {
  if (method == "fem")
    return of_elements(request, wanted);
  const auto [equations, recoveries] = methods::equations_of_motion(request, method);
  Stopwatch watch;
  Spectrum result;
  result.recoveries = recoveries;
  result.n_dofs = equations.stiffness.n_rows();
  result.nonzeros = equations.stiffness.nonzeros();
  result.seconds = phases_of(equations.seconds);
  result.whole = result.n_dofs <= most_rows_for_all;
  const double shift = -0.1 * scale * scale;
  result.squares =
      result.whole ? meshless::linear_algebra::generalized_eigenvalues(equations.stiffness, equations.mass, shift)
                   : meshless::linear_algebra::nearest_eigenvalues(equations.stiffness, equations.mass, shift, wanted);
  result.seconds["solve"] = watch.lap();
  return result;
}

void PlateEvolution::step(double time_step) {
  advance(time_step);
  constexpr std::int64_t between_checks = 10;
  if (steps() % between_checks != 0)
    return;
  const double error = energy_error();
  if (!std::isfinite(error))
    throw meshless::dynamics::Violation(time(), -1, 0, "the energy is not finite");
  if (error > watch_.largest_gain)
    throw meshless::dynamics::Violation(
        time(), -1, 0,
        fmt::format("energy grows: kinetic and strain energy exceed the work by {:.3g} of it (at most {} is let "
                    "pass); the operator has eigenvalues that grow, or the step is too long",
                    error, watch_.largest_gain));
}

double PlateEvolution::energy_error() const {
  const double w = work();
  largest_work_ = std::max({largest_work_, std::abs(w), watch_.least_work});
  return (kinetic() + strain() - w) / largest_work_;
}

std::unique_ptr<PlateEvolution> evolution(const methods::SolveRequest &request, const std::string &method,
                                          const Watch &watch) {
  if (method == "strong")
    throw methods::Refused("collocated conditions on the boundary have no inertia; strong is here for modes alone");
  if (method == "fem")
    return std::make_unique<ElementPlate>(request, watch);
  return std::make_unique<ParticlePlate>(request, method, watch);
}

} // namespace comparisons::benchmarks::plate_vibration
