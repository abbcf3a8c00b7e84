#include "fem_reference/rod/explicit_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fem_reference::rod {

namespace {

constexpr std::int64_t check_interval = 50;

} // namespace

ExplicitBar::ExplicitBar(WaveBar bar) : bar_(std::move(bar)) {
  const auto &x = bar_.vertices;
  if (x.size() < 2)
    throw std::invalid_argument(fmt::format("a bar needs two vertices; found {}", x.size()));
  if (!(bar_.youngs_modulus > 0) || !(bar_.density > 0))
    throw std::invalid_argument("Young's modulus and density of a bar are positive");
  wave_speed_ = std::sqrt(bar_.youngs_modulus / bar_.density);
  spacing_ = x.back() - x.front();
  mass_.assign(x.size(), 0.0);
  for (std::size_t e = 0; e + 1 < x.size(); ++e) {
    const double length = x[e + 1] - x[e];
    if (!(length > 0))
      throw std::invalid_argument(fmt::format("vertex {} does not lie behind the one before it", e + 2));
    spacing_ = std::min(spacing_, length);
    mass_[e] += 0.5 * bar_.density * length;
    mass_[e + 1] += 0.5 * bar_.density * length;
  }
  displacement_.assign(x.size(), 0.0);
  velocity_ = displacement_;
  force_.assign(x.size() + 1, 0.0);
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
  const double modulus = bar_.youngs_modulus;
  const double *u = displacement_.data();
  double *v = velocity_.data();
  double *f = force_.data(); // f[e + 1]: force in element e
  if (bar_.viscosity) {
    const double factor = *bar_.viscosity * wave_speed_ * bar_.density;
    for (std::size_t e = 0; e + 1 < n; ++e)
      f[e + 1] = modulus * (u[e + 1] - u[e]) / (bar_.vertices[e + 1] - bar_.vertices[e]) + factor * (v[e + 1] - v[e]);
  } else
    for (std::size_t e = 0; e + 1 < n; ++e)
      f[e + 1] = modulus * (u[e + 1] - u[e]) / (bar_.vertices[e + 1] - bar_.vertices[e]);
  const double load = bar_.right_stress ? bar_.right_stress(time_ - 0.5 * dt, time_ + 0.5 * dt) : 0;
  f[n] = load;
  const double last_before = v[n - 1];
  if (bar_.damping)
    for (std::size_t i = 0; i < n; ++i)
      v[i] *= 1 - dt * *bar_.damping;
  for (std::size_t i = 0; i < n; ++i)
    v[i] += dt / mass_[i] * (f[i + 1] - f[i]);
  work_ += load * dt * 0.5 * (last_before + v[n - 1]);
  for (std::size_t i = 0; i < n; ++i)
    displacement_[i] += dt * v[i];
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
  for (std::size_t e = 0; e + 1 < displacement_.size(); ++e)
    sigma.push_back(bar_.youngs_modulus * (displacement_[e + 1] - displacement_[e]) /
                    (bar_.vertices[e + 1] - bar_.vertices[e]));
  return sigma;
}

std::vector<double> ExplicitBar::middles() const {
  std::vector<double> x;
  for (std::size_t e = 0; e + 1 < bar_.vertices.size(); ++e)
    x.push_back(0.5 * (bar_.vertices[e] + bar_.vertices[e + 1]));
  return x;
}

double ExplicitBar::energy() const {
  double sum = 0;
  const auto sigma = stress();
  for (std::size_t i = 0; i < mass_.size(); ++i)
    sum += 0.5 * mass_[i] * velocity_[i] * velocity_[i];
  for (std::size_t e = 0; e < sigma.size(); ++e)
    sum += 0.5 * sigma[e] * sigma[e] / bar_.youngs_modulus * (bar_.vertices[e + 1] - bar_.vertices[e]);
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
