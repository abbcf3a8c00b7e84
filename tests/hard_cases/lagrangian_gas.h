#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

/// A reference for gases on a line that shares nothing with the methods compared.
namespace lagrangian_gas {

struct State {
  double density = 0, velocity = 0, pressure = 0;
};

/// Cells that move with an ideal gas between reflecting walls at 0 and 1: Godunov's method in mass coordinates,
///   d(1/rho)/dt = du/dm,  du/dt = -dp/dm,  dE/dt = -d(p u)/dm,
/// with linear density, velocity and pressure in each cell (van Leer's monotonised central slopes), the two-shock
/// Riemann solver (Colella & Woodward 1984, section 3) and Heun's method. Nothing passes between cells, so that contact
/// discontinuities stay sharp; momentum apart, which walls take, everything is conserved.
class Tube {
public:
  Tube(std::size_t n, double gamma, const std::function<State(double)> &initial)
      : gamma_(gamma), cells_(n), before_(n), rates_(n), states_(n + 2), slopes_(n + 2), velocity_(n + 1),
        pressure_(n + 1), mass_(n) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto s = initial((static_cast<double>(i) + .5) / static_cast<double>(n));
      mass_[i] = s.density / static_cast<double>(n);
      cells_[i] = {1 / s.density, s.velocity, s.pressure / ((gamma - 1) * s.density) + .5 * s.velocity * s.velocity};
    }
  }

  void run(double end) {
    for (double time = 0; time < end;) {
      find_rates();
      const double dt = std::min(step(), end - time);
      before_ = cells_;
      for (std::size_t i = 0; i < cells_.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          cells_[i][k] += dt * rates_[i][k];
      find_rates();
      for (std::size_t i = 0; i < cells_.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          cells_[i][k] = .5 * (before_[i][k] + cells_[i][k] + dt * rates_[i][k]);
      time += dt;
    }
  }

  /// Mean densities of n equal intervals.
  std::vector<double> means(std::size_t n) const {
    std::vector<double> result(n, 0.0);
    double x = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double next = x + mass_[i] * cells_[i][0] * static_cast<double>(n); // in intervals
      for (auto k = static_cast<std::size_t>(x); k < n && static_cast<double>(k) < next; ++k) {
        const auto begin = static_cast<double>(k);
        result[k] += (std::min(next, begin + 1) - std::max(x, begin)) / cells_[i][0];
      }
      x = next;
    }
    return result;
  }

private:
  using Conserved = std::array<double, 3>; ///< 1 / density, velocity, total energy per mass

  static double slope(double left, double right) {
    if (left * right <= 0)
      return 0;
    const double most = 2 * std::min(std::abs(left), std::abs(right));
    return std::copysign(std::min(.5 * std::abs(left + right), most), left);
  }

  void find_rates() {
    const std::size_t n = cells_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto &[volume, velocity, energy] = cells_[i];
      states_[i + 1] = {1 / volume, velocity, (gamma_ - 1) * (energy - .5 * velocity * velocity) / volume};
    }
    states_[0] = {states_[1].density, -states_[1].velocity, states_[1].pressure};
    states_[n + 1] = {states_[n].density, -states_[n].velocity, states_[n].pressure};
    for (std::size_t i = 1; i <= n; ++i) {
      const auto &a = states_[i - 1], &b = states_[i], &c = states_[i + 1];
      slopes_[i] = {slope(b.density - a.density, c.density - b.density),
                    slope(b.velocity - a.velocity, c.velocity - b.velocity),
                    slope(b.pressure - a.pressure, c.pressure - b.pressure)};
    }
    slopes_[0] = {-slopes_[1].density, slopes_[1].velocity, -slopes_[1].pressure};
    slopes_[n + 1] = {-slopes_[n].density, slopes_[n].velocity, -slopes_[n].pressure};
    for (std::size_t f = 0; f <= n; ++f)
      solve(traced(f, .5), traced(f + 1, -.5), velocity_[f], pressure_[f]);
    velocity_[0] = velocity_[n] = 0;
    for (std::size_t i = 0; i < n; ++i)
      rates_[i] = {(velocity_[i + 1] - velocity_[i]) / mass_[i], -(pressure_[i + 1] - pressure_[i]) / mass_[i],
                   -(pressure_[i + 1] * velocity_[i + 1] - pressure_[i] * velocity_[i]) / mass_[i]};
  }

  State traced(std::size_t i, double part) const {
    return {states_[i].density + part * slopes_[i].density, states_[i].velocity + part * slopes_[i].velocity,
            states_[i].pressure + part * slopes_[i].pressure};
  }

  /// Mass that a shock to this pressure takes up in a second.
  double shock_speed(const State &s, double pressure) const {
    const double strength = std::max(pressure / s.pressure - 1, -1 + 1e-12);
    return std::sqrt(gamma_ * s.density * s.pressure * (1 + (gamma_ + 1) / (2 * gamma_) * strength));
  }

  void solve(const State &left, const State &right, double &velocity, double &pressure) const {
    pressure = .5 * (left.pressure + right.pressure);
    constexpr int most_iterations = 30;
    for (int k = 0; k < most_iterations; ++k) {
      const double a = shock_speed(left, pressure), b = shock_speed(right, pressure);
      velocity = (a * left.velocity + b * right.velocity + left.pressure - right.pressure) / (a + b);
      const double next = std::max(
          (b * left.pressure + a * right.pressure - a * b * (right.velocity - left.velocity)) / (a + b), 1e-10);
      const bool found = std::abs(next - pressure) < 1e-10 * pressure;
      pressure = next;
      if (found)
        return;
    }
  }

  /// A Courant number of .4, and no cell changes its volume by more than a fifth.
  double step() const {
    double dt = INFINITY;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto &s = states_[i + 1];
      dt = std::min({dt, .4 * mass_[i] / std::sqrt(gamma_ * s.pressure * s.density),
                     .2 * cells_[i][0] / std::max(std::abs(rates_[i][0]), 1e-300)});
    }
    return dt;
  }

  double gamma_;
  std::vector<Conserved> cells_, before_, rates_;
  std::vector<State> states_, slopes_; ///< with a mirror image at each end
  std::vector<double> velocity_, pressure_, mass_;
};

} // namespace lagrangian_gas
