#include "fem_reference/rod/explicit_bar.h"

#include "discretisation.h"

#include <deal.II/base/quadrature_lib.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fem_reference::rod {

namespace {

constexpr std::int64_t check_interval = 50;

} // namespace

ExplicitBar::ExplicitBar(WaveBar bar) : bar_(std::move(bar)) {
  if (!(bar_.youngs_modulus > 0) || !(bar_.density > 0))
    throw InvalidInput("Young's modulus and density of a bar are positive");
  wave_speed_ = std::sqrt(bar_.youngs_modulus / bar_.density);
  const Discretisation discretisation(bar_.vertices, 1);
  const auto n = discretisation.numbering.n_dofs();
  dealii::SparseMatrix<double> stiffness(discretisation.pattern);
  dealii::SparseMatrix<double> mass(discretisation.pattern);
  assemble_stiffness(discretisation, stiffness);
  assemble_mass(discretisation, dealii::QGaussLobatto<1>(2), mass);

  // From the left to the right, so that a step runs along arrays.
  mass_.resize(n);
  auto cell = discretisation.numbering.begin_active();
  while (!cell->at_boundary(0))
    cell = cell->neighbor(0);
  spacing_ = std::numeric_limits<double>::max();
  for (std::size_t e = 0;; ++e, cell = cell->neighbor(1)) {
    const auto left = cell->vertex_dof_index(0, 0);
    const auto right = cell->vertex_dof_index(1, 0);
    mass_[e] = bar_.density * discretisation.half_length * mass(left, left);
    mass_[e + 1] = bar_.density * discretisation.half_length * mass(right, right);
    stiffness_.push_back(-bar_.youngs_modulus / discretisation.half_length * stiffness(left, right));
    middles_.push_back(discretisation.to_global(cell->center()[0]));
    spacing_ = std::min(spacing_, discretisation.half_length * cell->measure());
    if (cell->at_boundary(1))
      break;
  }
  for (const double m : mass_)
    inverse_mass_.push_back(1 / m);
  displacement_.assign(n, 0.0);
  velocity_ = displacement_;
  force_.assign(n + 1, 0.0);
}

/// dt^2 w^2 + 2 dt (r + b D w^2 / c) = 4 with w = 2 c / D.
double ExplicitBar::stable_step() const {
  const double squared = 4 * wave_speed_ * wave_speed_ / (spacing_ * spacing_);
  const double half = bar_.viscosity.value_or(0) * spacing_ / wave_speed_ + bar_.damping.value_or(0) / squared;
  return -half + std::sqrt(half * half + 4 / squared);
}

void ExplicitBar::step(double dt) {
  if (!(dt <= stable_step() * (1 + 1e-12)))
    throw std::runtime_error(
        fmt::format("at t = {:.6g} s: the time step {:.4g} s is {:.3g} times the largest stable one", time_, dt,
                    dt / stable_step()));
  const std::size_t n = mass_.size();
  const double *k = stiffness_.data();
  const double *m = inverse_mass_.data();
  double *u = displacement_.data();
  double *v = velocity_.data();
  double *f = force_.data(); // f[e + 1]: force in element e
  if (bar_.viscosity) {
    const double factor = *bar_.viscosity * wave_speed_ * bar_.density;
    for (std::size_t e = 0; e + 1 < n; ++e)
      f[e + 1] = k[e] * (u[e + 1] - u[e]) + factor * (v[e + 1] - v[e]);
  } else
    for (std::size_t e = 0; e + 1 < n; ++e)
      f[e + 1] = k[e] * (u[e + 1] - u[e]);
  const double load = bar_.right_stress ? bar_.right_stress(time_ - 0.5 * dt, time_ + 0.5 * dt) : 0;
  f[n] = load;
  const double last_before = v[n - 1];
  const auto advance = [=](std::size_t i, double kept) {
    const double after = kept * v[i] + dt * m[i] * (f[i + 1] - f[i]);
    v[i] = after;
    u[i] += dt * after;
  };
  if (bar_.damping) {
    const double kept = 1 - dt * *bar_.damping;
    for (std::size_t i = 0; i < n; ++i)
      advance(i, kept);
  } else
    for (std::size_t i = 0; i < n; ++i)
      advance(i, 1);
  work_ += load * dt * 0.5 * (last_before + v[n - 1]);
  time_ += dt;
  ++steps_;
  if (steps_ % check_interval == 0)
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(displacement_[i]))
        throw std::runtime_error(
            fmt::format("at t = {:.6g} s, vertex {} at x = {:.6g} m: the displacement is not finite", time_, i + 1,
                        bar_.vertices[i]));
}

std::vector<double> ExplicitBar::stress() const {
  std::vector<double> sigma;
  for (std::size_t e = 0; e < stiffness_.size(); ++e) // E u,x, for a cross section of one
    sigma.push_back(stiffness_[e] * (displacement_[e + 1] - displacement_[e]));
  return sigma;
}

double ExplicitBar::energy() const {
  double sum = 0;
  const auto sigma = stress();
  for (std::size_t i = 0; i < mass_.size(); ++i)
    sum += 0.5 * mass_[i] * velocity_[i] * velocity_[i];
  for (std::size_t e = 0; e < sigma.size(); ++e)
    sum += 0.5 * sigma[e] * sigma[e] / stiffness_[e];
  return sum;
}

std::vector<std::pair<std::string, std::span<double>>> ExplicitBar::state() {
  counters_ = {time_, static_cast<double>(steps_), work_};
  return {{"displacement", displacement_}, {"velocity", velocity_}, {"time_steps_work", counters_}};
}

void ExplicitBar::adopt_state() {
  time_ = counters_[0];
  steps_ = static_cast<std::int64_t>(counters_[1]);
  work_ = counters_[2];
}

} // namespace fem_reference::rod
