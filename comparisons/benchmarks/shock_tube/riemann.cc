#include "comparisons/benchmarks/shock_tube/riemann.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace comparisons::benchmarks::shock_tube {

RiemannSolution::RiemannSolution(const GasState &left, const GasState &right, double gamma)
    : left_(left), right_(right), gamma_(gamma) {
  if (!(gamma > 1) || !std::isfinite(gamma))
    throw std::invalid_argument(fmt::format("gamma = {} is not greater than 1", gamma));
  for (const auto *state : {&left, &right}) {
    if (!(state->density >= 0) || !(state->pressure >= 0) || !std::isfinite(state->density) ||
        !std::isfinite(state->pressure) || !std::isfinite(state->velocity))
      throw std::invalid_argument(fmt::format("no state of a gas: density {} kg/m^3, velocity {} m/s, pressure {} Pa",
                                              state->density, state->velocity, state->pressure));
    if (state->density == 0 && state->pressure > 0)
      throw std::invalid_argument(fmt::format("a vacuum has no pressure; found {} Pa", state->pressure));
  }
  const bool vacuum_side = left.density == 0 || right.density == 0;
  // Two rarefactions can bridge this difference of velocities; beyond it they leave a vacuum.
  const double bridge = 2 / (gamma - 1) * (sound_speed(left) + sound_speed(right));
  if (!vacuum_side && bridge > right.velocity - left.velocity) {
    const double p = find_star_pressure();
    double slope = 0;
    const double from_left = left.velocity - jump(p, left, slope);
    const double from_right = right.velocity + jump(p, right, slope);
    star_pressure_ = p;
    star_velocity_ = 0.5 * (from_left + from_right);
  }
  left_wave_ = wave(left_, -1);
  right_wave_ = wave(right_, 1);
}

double RiemannSolution::sound_speed(const GasState &state) const {
  return state.density > 0 ? std::sqrt(gamma_ * state.pressure / state.density) : 0;
}

double RiemannSolution::jump(double p, const GasState &state, double &slope) const {
  if (p > state.pressure) { // shock, Toro (4.6)
    const double a = 2 / ((gamma_ + 1) * state.density);
    const double b = (gamma_ - 1) / (gamma_ + 1) * state.pressure;
    const double root = std::sqrt(a / (p + b));
    slope = root * (1 - 0.5 * (p - state.pressure) / (p + b));
    return (p - state.pressure) * root;
  }
  const double c = sound_speed(state);
  if (c == 0) {
    slope = std::numeric_limits<double>::infinity();
    return 0;
  }
  const double z = (gamma_ - 1) / (2 * gamma_);
  slope = std::pow(p / state.pressure, -(gamma_ + 1) / (2 * gamma_)) / (state.density * c);
  return 2 * c / (gamma_ - 1) * (std::pow(p / state.pressure, z) - 1);
}

/// The sum of both jumps rises with p and bends down, so that Newton's method from the left of the root never
/// overshoots; a step that would leave the interval known to hold the root is halved.
double RiemannSolution::find_star_pressure() const {
  const double difference = right_.velocity - left_.velocity;
  const auto f = [&](double p, double &slope) {
    double left_slope = 0;
    double right_slope = 0;
    const double value = jump(p, left_, left_slope) + jump(p, right_, right_slope) + difference;
    slope = left_slope + right_slope;
    return value;
  };
  double slope = 0;
  double low = 0;
  double high = std::max({left_.pressure, right_.pressure, 1e-300});
  while (f(high, slope) < 0)
    high *= 2;
  double p = 0.5 * (low + high);
  constexpr int most = 2000; // halving alone needs about 1100 for all of double's range
  for (int i = 0; i < most; ++i) {
    const double value = f(p, slope);
    (value < 0 ? low : high) = p;
    double next = p - value / slope;
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (std::abs(next - p) <= 2 * std::numeric_limits<double>::epsilon() * p)
      return next;
    p = next;
  }
  return p;
}

RiemannSolution::Wave RiemannSolution::wave(const GasState &state, double sign) const {
  Wave result;
  if (state.density == 0) { // the edge of the vacuum belongs to the other side
    result.head = result.tail = sign * std::numeric_limits<double>::infinity();
    return result;
  }
  const double c = sound_speed(state);
  if (!star_pressure_) { // a fan that ends in a vacuum
    result.head = state.velocity + sign * c;
    result.tail = state.velocity - sign * 2 * c / (gamma_ - 1);
    return result;
  }
  const double ratio = state.pressure > 0 ? *star_pressure_ / state.pressure : std::numeric_limits<double>::infinity();
  result.shock = *star_pressure_ > state.pressure;
  if (result.shock) {
    const double mach_part = (gamma_ + 1) / 2 * *star_pressure_ + (gamma_ - 1) / 2 * state.pressure;
    result.head = result.tail = state.velocity + sign * std::sqrt(mach_part / state.density);
    const double limit = (gamma_ + 1) / (gamma_ - 1);
    result.density =
        state.density * (std::isfinite(ratio) ? (ratio * limit + 1) / (ratio + limit) : limit); // Rankine-Hugoniot
  } else {
    result.density = state.density * std::pow(ratio, 1 / gamma_);
    result.head = state.velocity + sign * c;
    result.tail = *star_velocity_ + sign * c * std::pow(ratio, (gamma_ - 1) / (2 * gamma_));
  }
  return result;
}

GasState RiemannSolution::inside_fan(const GasState &state, double sign, double speed) const {
  const double c = sound_speed(state);
  const double factor = 2 / (gamma_ + 1) + sign * -(gamma_ - 1) / ((gamma_ + 1) * c) * (state.velocity - speed);
  const double ratio = std::max(factor, 0.0);
  return {state.density * std::pow(ratio, 2 / (gamma_ - 1)),
          2 / (gamma_ + 1) * (-sign * c + (gamma_ - 1) / 2 * state.velocity + speed),
          state.pressure * std::pow(ratio, 2 * gamma_ / (gamma_ - 1))};
}

GasState RiemannSolution::side(const GasState &state, const Wave &wave, double sign, double speed) const {
  if (sign * speed >= sign * wave.head)
    return state;
  if (!wave.shock && sign * speed > sign * wave.tail)
    return inside_fan(state, sign, speed);
  if (!star_pressure_)
    return {0, speed, 0};
  return {wave.density, *star_velocity_, *star_pressure_};
}

GasState RiemannSolution::at(double speed) const {
  if (star_velocity_)
    return speed <= *star_velocity_ ? side(left_, left_wave_, -1, speed) : side(right_, right_wave_, 1, speed);
  if (left_.density > 0 && speed <= left_wave_.tail)
    return side(left_, left_wave_, -1, speed);
  if (right_.density > 0 && speed >= right_wave_.tail)
    return side(right_, right_wave_, 1, speed);
  return {0, speed, 0};
}

} // namespace comparisons::benchmarks::shock_tube
