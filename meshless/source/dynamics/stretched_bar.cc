#include "meshless/dynamics/stretched_bar.h"

#include "meshless/basis/basis_options.h"
#include "meshless/dynamics/violation.h"
#include "meshless/linear_algebra/floating_point_traps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace meshless::dynamics {

namespace {

constexpr double most_growth = 1000;

double largest(std::span<const double> values) {
  double result = 0;
  for (const double v : values)
    result = std::max(result, std::abs(v));
  return result;
}

} // namespace

StretchedBar::StretchedBar(const StretchedBarOptions &options)
    : options_(options), wave_speed_(std::sqrt(options.youngs_modulus / options.density)),
      weights_(static_cast<std::int64_t>(options.n_particles)), conservative_(!options.operators) {
  if (!(options.youngs_modulus > 0) || !(options.density > 0) || !(options.spacing > 0) ||
      !(options.smoothing_length > 0))
    throw std::invalid_argument("modulus, density, spacing and smoothing length of a bar are positive");
  const double reach = kernels::support_of(options.kernel) * options.smoothing_length / options.spacing;
  n_held_ = static_cast<std::size_t>(std::ceil(reach)) + 1;
  if (options.n_particles < 2 * n_held_ + 3)
    throw std::invalid_argument(fmt::format("a bar with {} particles held at each end needs {} or more; found {}",
                                            n_held_, 2 * n_held_ + 3, options.n_particles));
  std::mt19937_64 random(options.seed);
  for (std::size_t i = 0; i < options.n_particles; ++i) {
    positions_.push_back(static_cast<double>(i) * options.spacing);
    const double unit = static_cast<double>(random() >> 11) * 0x1.0p-52 - 1; // the standard fixes these bits
    velocity_.push_back(unit);
  }
  for (std::size_t i = 0; i < velocity_.size(); ++i)
    velocity_[i] = is_held(i) ? 0 : options.disturbance * wave_speed_ * velocity_[i];
  first_velocity_ = largest(velocity_);
  stress_.assign(positions_.size(), options.youngs_modulus * options.stretch);
  rate_.resize(positions_.size());
  gradients(positions_);
}

void StretchedBar::gradients(std::span<const double> places) {
  if (!conservative_) {
    weights_ = options_.operators(places).first;
    return;
  }
  const linear_algebra::FloatingPointTraps traps;
  weights_ = linear_algebra::SparseRows(static_cast<std::int64_t>(places.size()));
  std::visit(
      [&](const auto &kernel) {
        const double h = options_.smoothing_length;
        const double limit = basis::edge_limit(kernel.support(), basis::EdgeRule::excluded);
        const double factor = kernel.normalisation(1) / (h * h * h) * options_.spacing;
        std::vector<std::int64_t> columns;
        std::vector<double> values;
        for (std::size_t i = 0; i < places.size(); ++i) {
          columns.clear();
          values.clear();
          for (std::size_t j = 0; j < places.size(); ++j) {
            const double dx = places[i] - places[j];
            const double s_squared = dx * dx / (h * h);
            if (s_squared >= limit || i == j)
              continue;
            columns.push_back(static_cast<std::int64_t>(j));
            values.push_back(factor * kernel.slope(s_squared) * dx); // D W'_ij by x_i
          }
          weights_.append_row(columns, values);
        }
      },
      options_.kernel);
}

void StretchedBar::step(double dt) {
  if (options_.kernel_positions == KernelPositions::current)
    gradients(positions_);
  const auto row = [&](std::size_t i, auto f) {
    double sum = 0;
    for (auto e = weights_.offsets()[i]; e < weights_.offsets()[i + 1]; ++e)
      sum += weights_.values()[static_cast<std::size_t>(e)] *
             f(static_cast<std::size_t>(weights_.columns()[static_cast<std::size_t>(e)]));
    return sum;
  };
  {
    const linear_algebra::FloatingPointTraps traps; // every step is checked below, long before an overflow
    for (std::size_t i = 0; i < positions_.size(); ++i)
      rate_[i] = row(i, [&](std::size_t j) { return stress_[j] + (conservative_ ? stress_[i] : 0); });
    for (std::size_t i = 0; i < positions_.size(); ++i)
      if (!is_held(i))
        velocity_[i] += dt / options_.density * rate_[i];
    for (std::size_t i = 0; i < positions_.size(); ++i)
      rate_[i] = row(i, [&](std::size_t j) { return velocity_[j] - velocity_[i]; });
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      stress_[i] += dt * options_.youngs_modulus * rate_[i];
      positions_[i] += dt * velocity_[i];
    }
  }
  time_ += dt;
  ++steps_;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    if (!(std::abs(velocity_[i]) <= most_growth * first_velocity_))
      throw Violation(
          time_, number, positions_[i],
          fmt::format("the disturbance has grown more than {} times: the particles clump under tension", most_growth));
    if (i > 0 && !(positions_[i] > positions_[i - 1]))
      throw Violation(time_, number, positions_[i], "particles cross");
  }
}

double StretchedBar::growth() const { return largest(velocity_) / first_velocity_; }

State StretchedBar::state() {
  counters_ = {time_, static_cast<double>(steps_)};
  return {{"position", positions_}, {"velocity", velocity_}, {"stress", stress_}, {"time_and_steps", counters_}};
}

void StretchedBar::adopt_state() {
  time_ = counters_[0];
  steps_ = static_cast<std::int64_t>(counters_[1]);
}

} // namespace meshless::dynamics
