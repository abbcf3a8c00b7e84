#include "meshless/dynamics/plane_motion.h"

#include "meshless/dynamics/violation.h"
#include "meshless/linear_algebra/floating_point_traps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace meshless::dynamics {

namespace {

using linear_algebra::SparseRows;

void require_mass(const SparseRows &mass) {
  for (std::size_t row = 0; row < static_cast<std::size_t>(mass.n_rows()); ++row)
    if (mass.offsets()[row] == mass.offsets()[row + 1])
      throw std::invalid_argument(fmt::format(
          "row {} of the mass is empty: it is a condition without inertia, as collocation has them on the boundary; "
          "take a weak form for motion in time",
          row));
}

std::vector<double> row_sums(const SparseRows &matrix) {
  std::vector<double> sums(static_cast<std::size_t>(matrix.n_rows()), 0);
  for (std::size_t row = 0; row < sums.size(); ++row)
    for (auto k = matrix.offsets()[row]; k < matrix.offsets()[row + 1]; ++k)
      sums[row] += matrix.values()[static_cast<std::size_t>(k)];
  return sums;
}

} // namespace

PlaneMotion::PlaneMotion(std::shared_ptr<const elasticity::EquationsOfMotion> equations,
                         const PlaneMotionOptions &options)
    : equations_(std::move(equations)), options_(options), u_(equations_->force.size(), 0.0), v_(u_), a_(u_),
      previous_u_(u_), mean_v_(u_), right_(u_), scratch_(u_), stable_step_(INFINITY) {
  require_mass(equations_->mass);
  if (options_.damping && !(options_.damping->rate >= 0))
    throw std::invalid_argument(
        fmt::format("a damping rate of {} 1/s; it must not be negative", options_.damping->rate));
  if (options_.integration == TimeIntegration::newmark) {
    SparseRows mass = equations_->mass;
    const auto divisors = mass.equilibrate_rows();
    for (std::size_t i = 0; i < divisors.size(); ++i)
      right_[i] = equations_->force[i] / divisors[i];
    linear_algebra::SparseLu(mass).solve(right_, a_);
    return;
  }
  lumped_ = row_sums(equations_->mass);
  for (std::size_t i = 0; i < lumped_.size(); ++i)
    if (!(std::abs(lumped_[i]) > 0))
      throw std::invalid_argument(fmt::format("the lumped mass of row {} is {}", i, lumped_[i]));
  stable_step_ = 2 / std::sqrt(spectral_radius());
}

/// Power iteration on m^-1 K: the geometric mean of the growth over ten products, until it changes by less than 1e-4.
double PlaneMotion::spectral_radius() {
  const linear_algebra::FloatingPointTraps traps;
  std::mt19937 random(12345);
  std::vector<double> x(u_.size());
  for (double &value : x)
    value = static_cast<double>(random()) / 4294967296.0 - 0.5;
  double radius = 0;
  constexpr int most_rounds = 200;
  constexpr int products = 10;
  for (int round = 0; round < most_rounds; ++round) {
    double log_growth = 0;
    for (int k = 0; k < products; ++k) {
      equations_->stiffness.multiply(x, scratch_);
      double norm = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = scratch_[i] / lumped_[i];
        norm += x[i] * x[i];
      }
      norm = std::sqrt(norm);
      for (double &value : x)
        value /= norm;
      if (k > 0 || round > 0)
        log_growth += std::log(norm);
    }
    const double next = std::exp(log_growth / (round > 0 ? products : products - 1));
    if (round > 2 && std::abs(next - radius) < 1e-4 * next)
      return next;
    radius = next;
  }
  return radius;
}

void PlaneMotion::step(double dt) {
  if (dt > stable_step_ * (1 + 1e-9))
    throw Violation(time_, -1, 0,
                    fmt::format("the time step of {:.6g} s is above the stable one of {:.6g} s", dt, stable_step_));
  previous_u_ = u_;
  if (options_.integration == TimeIntegration::newmark)
    newmark(dt);
  else
    central(dt);
  ++steps_;
  time_ += dt;
  counters_ = {time_, static_cast<double>(steps_)};
  constexpr int steps_between_checks = 50;
  if (steps_ % steps_between_checks == 0)
    for (std::size_t i = 0; i < u_.size(); ++i)
      if (!std::isfinite(u_[i]))
        throw Violation(time_, static_cast<std::int64_t>(i / 2), equations_->particles->position(i / 2)[0],
                        "its displacement is not finite");
}

void PlaneMotion::newmark(double dt) {
  const double quarter = 0.25 * dt * dt;
  const double rate = options_.damping ? options_.damping->rate : 0;
  if (!lu_ || dt != factorised_for_) {
    lu_.reset();
    matrix_ = std::make_unique<SparseRows>(
        linear_algebra::combine(1 + 0.5 * rate * dt, equations_->mass, quarter, equations_->stiffness));
    divisors_ = matrix_->equilibrate_rows();
    lu_ = std::make_unique<linear_algebra::SparseLu>(*matrix_);
    factorised_for_ = dt;
  }
  for (std::size_t i = 0; i < u_.size(); ++i) {
    u_[i] += dt * v_[i] + quarter * a_[i];
    v_[i] += 0.5 * dt * a_[i];
  }
  equations_->stiffness.multiply(u_, right_);
  for (std::size_t i = 0; i < u_.size(); ++i)
    right_[i] = equations_->force[i] - right_[i];
  if (options_.damping) {
    equations_->mass.multiply(v_, scratch_);
    for (std::size_t i = 0; i < u_.size(); ++i)
      right_[i] -= rate * scratch_[i];
  }
  for (std::size_t i = 0; i < u_.size(); ++i)
    right_[i] /= divisors_[i];
  lu_->solve(right_, a_);
  for (std::size_t i = 0; i < u_.size(); ++i) {
    u_[i] += quarter * a_[i];
    v_[i] += 0.5 * dt * a_[i];
  }
}

void PlaneMotion::central(double dt) {
  equations_->stiffness.multiply(u_, right_);
  const double rate = options_.damping ? options_.damping->rate : 0;
  const double kick = steps_ == 0 ? 0.5 * dt : dt; // from v(0) = 0 to v(dt / 2)
  for (std::size_t i = 0; i < u_.size(); ++i) {
    const double before = v_[i];
    v_[i] += kick * ((equations_->force[i] - right_[i]) / lumped_[i] - rate * v_[i]);
    mean_v_[i] = steps_ == 0 ? 0 : 0.5 * (before + v_[i]);
    u_[i] += dt * v_[i];
  }
}

std::span<const double> PlaneMotion::displacement() const {
  return options_.integration == TimeIntegration::newmark ? u_ : previous_u_;
}

std::span<const double> PlaneMotion::velocity() const {
  return options_.integration == TimeIntegration::newmark ? v_ : mean_v_;
}

State PlaneMotion::state() {
  return {{"displacement", u_},       {"velocity", v_},
          {"acceleration", a_},       {"previous_displacement", previous_u_},
          {"mean_velocity", mean_v_}, {"counters", counters_}};
}

void PlaneMotion::adopt_state() {
  time_ = counters_[0];
  steps_ = static_cast<std::int64_t>(counters_[1]);
}

} // namespace meshless::dynamics
