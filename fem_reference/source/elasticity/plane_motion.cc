#include "dynamic_system.h"
#include "point_location.h"

#include "../stopwatch.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
double dot(std::span<const double> x, std::span<const double> y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += x[i] * y[i];
  return sum;
}
} // namespace

class PlaneMotion::Implementation {
public:
  Implementation(const PlaneProblem &problem, const PlaneDynamicsOptions &options, TimeIntegration integration_,
                 double damping_)
      : system(problem, options), integration(integration_), damping(damping_), u(system.force.size(), 0.), v(u), a(u),
        previous(u), scratch(u), right(u) {
    if (integration == TimeIntegration::central_difference && options.mass != Mass::lumped)
      throw InvalidInput("central differences need the lumped mass: with the consistent one each step solves a system");
    if (!(damping >= 0) || !std::isfinite(damping))
      throw InvalidInput(fmt::format("a damping rate of {} 1/s; expected 0 or more", damping));
    Stopwatch watch;
    if (integration == TimeIntegration::newmark)
      a = system.factorise(1, 0.)->solve(system.force);
    else
      stable = 2 / highest_frequency();
    seconds = system.seconds;
    seconds.solve = watch.lap();
  }

  /// Power iteration with Rayleigh quotients: they err by the square of the vector's error, and from below.
  double highest_frequency() {
    std::vector<double> x(u.size());
    unsigned random = 12345;
    for (double &value : x) {
      random = random * 1664525u + 1013904223u;
      value = static_cast<double>(random) / 2147483648.0 - 1;
    }
    double square = 0;
    constexpr int most_iterations = 5000;
    for (int k = 0; k < most_iterations; ++k) {
      multiply(system.stiffness, x, scratch, {});
      double above = 0, below = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double mass = system.diagonal_mass[i];
        const double image = mass > 0 ? scratch[i] / mass : 0;
        above += image * image * mass;
        below += x[i] * x[i] * mass;
        x[i] = image;
      }
      const double next = std::sqrt(above / below);
      const double norm = 1 / std::sqrt(above);
      for (double &value : x)
        value *= norm;
      if (std::abs(next - square) < 1e-9 * next && k > 50)
        return std::sqrt(next);
      square = next;
    }
    return std::sqrt(square);
  }

  void step(double dt) {
    previous = u;
    if (integration == TimeIntegration::newmark)
      newmark(dt);
    else
      central(dt);
    done += dot(system.force, u) - dot(system.force, previous);
    ++n_steps;
    time += dt;
    counters = {time, static_cast<double>(n_steps), done, start_work};
    constexpr int steps_between_checks = 50;
    if (n_steps % steps_between_checks == 0)
      for (const double value : u)
        if (!std::isfinite(value))
          throw SolveFailure(fmt::format("at t = {:.6g} s: a displacement is not finite", time));
  }

  void newmark(double dt) {
    const double quarter = 0.25 * dt * dt;
    if (!solver || dt != factorised_for) {
      solver = system.factorise(1 + 0.5 * damping * dt, quarter);
      factorised_for = dt;
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] += dt * v[i] + quarter * a[i];
      v[i] += 0.5 * dt * a[i];
    }
    multiply(system.stiffness, u, right, {});
    for (std::size_t i = 0; i < u.size(); ++i)
      right[i] = system.essential.prescribed[i] != 0 ? 0 : system.force[i] - right[i];
    if (damping > 0) {
      multiply(system.mass, v, scratch, {});
      for (std::size_t i = 0; i < u.size(); ++i)
        right[i] -= damping * scratch[i];
    }
    a = solver->solve(right);
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] += quarter * a[i];
      v[i] += 0.5 * dt * a[i];
    }
  }

  void central(double dt) {
    if (dt > stable * (1 + 1e-9))
      throw InvalidInput(fmt::format("at t = {:.6g} s: the time step of {:.6g} s is above the stable one of {:.6g} s",
                                     time, dt, stable));
    multiply(system.stiffness, u, right, {});
    const double kick = n_steps == 0 ? 0.5 * dt : dt; // from v(0) = 0 to v(dt / 2)
    if (n_steps == 0)
      for (std::size_t i = 0; i < u.size(); ++i)
        if (system.diagonal_mass[i] > 0)
          start_work += 0.125 * dt * dt * system.force[i] * system.force[i] / system.diagonal_mass[i];
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (!(system.diagonal_mass[i] > 0))
        continue;
      v[i] += kick * ((system.force[i] - right[i]) / system.diagonal_mass[i] - damping * v[i]);
      u[i] += dt * v[i];
    }
  }

  DynamicSystem system;
  TimeIntegration integration;
  double damping;
  Seconds seconds;
  double stable = INFINITY;
  std::unique_ptr<linear_algebra::DirectSolver> solver;
  double factorised_for = 0;
  std::vector<double> u, v, a, previous;
  mutable std::vector<double> scratch;
  std::vector<double> right;
  double time = 0;
  std::int64_t n_steps = 0;
  double done = 0;       ///< work
  double start_work = 0; ///< central differences: dt^2 / 8 f M^-1 f
  std::array<double, 4> counters{};
  mutable std::optional<PointLocation> location;
};

PlaneMotion::PlaneMotion(const PlaneProblem &problem, const PlaneDynamicsOptions &options, TimeIntegration integration,
                         double damping)
    : implementation_(std::make_unique<Implementation>(problem, options, integration, damping)) {}
PlaneMotion::~PlaneMotion() = default;
PlaneMotion::PlaneMotion(PlaneMotion &&) noexcept = default;
PlaneMotion &PlaneMotion::operator=(PlaneMotion &&) noexcept = default;

double PlaneMotion::time() const { return implementation_->time; }
std::int64_t PlaneMotion::steps() const { return implementation_->n_steps; }
double PlaneMotion::stable_step() const { return implementation_->stable; }
void PlaneMotion::step(double time_step) { implementation_->step(time_step); }

double PlaneMotion::kinetic_energy() const {
  const auto &m = *implementation_;
  multiply(m.system.mass, m.v, m.scratch, {});
  return 0.5 * dot(m.v, m.scratch);
}

double PlaneMotion::strain_energy() const {
  const auto &m = *implementation_;
  multiply(m.system.stiffness, m.u, m.scratch, {});
  return 0.5 * dot(m.integration == TimeIntegration::newmark ? m.u : m.previous, m.scratch);
}

double PlaneMotion::work() const {
  const auto &m = *implementation_;
  if (m.integration == TimeIntegration::newmark)
    return m.done;
  return 0.5 * (dot(m.system.force, m.u) + dot(m.system.force, m.previous)) - m.start_work;
}

void PlaneMotion::displacement(std::span<const Point> points, std::span<Vector> values) const {
  const auto &m = *implementation_;
  const auto &discretisation = m.system.discretisation;
  if (points.size() != values.size())
    throw InvalidInput(fmt::format("evaluation: {} points but room for {} values", points.size(), values.size()));
  if (!m.location)
    m.location.emplace(discretisation);
  ReferenceElement::Values shape, slope_1, slope_2;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto found =
        m.location->locate({points[k][0] - discretisation.origin[0], points[k][1] - discretisation.origin[1]});
    discretisation.element_of(found.cell).evaluate(found.xi, shape, slope_1, slope_2);
    const auto nodes = discretisation.nodes_of(found.cell);
    values[k] = {};
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t d = 0; d < 2; ++d)
        values[k][d] += shape[a] * m.u[2 * std::size_t{nodes[a]} + d];
  }
}

std::size_t PlaneMotion::n_dofs() const { return implementation_->u.size(); }
std::size_t PlaneMotion::nonzeros() const {
  return 2 * implementation_->system.stiffness.n_nonzeros_lower() - implementation_->u.size();
}
Seconds PlaneMotion::seconds() const { return implementation_->seconds; }

std::vector<std::pair<std::string, std::span<double>>> PlaneMotion::state() {
  auto &m = *implementation_;
  return {{"displacement", m.u},
          {"velocity", m.v},
          {"acceleration", m.a},
          {"previous_displacement", m.previous},
          {"counters", m.counters}};
}

void PlaneMotion::adopt_state() {
  auto &m = *implementation_;
  m.time = m.counters[0];
  m.n_steps = static_cast<std::int64_t>(m.counters[1]);
  m.done = m.counters[2];
  m.start_work = m.counters[3];
}
} // namespace fem_reference::elasticity
