#include "comparisons/benchmarks/detonation/theory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comparisons::benchmarks::detonation {

namespace {

/// Hugoniot curve of the products: the pressure at a density. With p = f(rho) + omega rho e it is linear in p.
double hugoniot_pressure(const Explosive &explosive, double density) {
  const double gruneisen = explosive.products.omega * density;
  const double cold = explosive.products.pressure(density, 0.0);
  const double half = 0.5 * (1 / explosive.density - 1 / density);
  return (explosive.energy + cold / gruneisen) / (1 / gruneisen - half);
}

ChapmanJouguet on_hugoniot(const Explosive &explosive, double density) {
  ChapmanJouguet result;
  const double p = hugoniot_pressure(explosive, density);
  const double compression = 1 - explosive.density / density;
  result.speed = std::sqrt(p / (explosive.density * compression));
  result.state = {density, result.speed * compression, p};
  result.energy = explosive.energy + 0.5 * p * (1 / explosive.density - 1 / density);
  return result;
}

} // namespace

ChapmanJouguet chapman_jouguet(const Explosive &explosive) {
  // c - (D - u) is negative below the tangential point, where the wave outruns sound, and positive above.
  const auto excess = [&](double density) {
    const auto point = on_hugoniot(explosive, density);
    return std::sqrt(explosive.products.sound_speed_squared(density, point.energy)) -
           (point.speed - point.state.velocity);
  };
  double low = 1.02 * explosive.density;
  double high = low;
  while (high < 3 * explosive.density && !(excess(high) > 0))
    high += 0.01 * explosive.density;
  if (!(excess(low) < 0) || !(excess(high) > 0))
    throw std::invalid_argument("the equation of state has no Chapman-Jouguet state between rho0 and three times it");
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return on_hugoniot(explosive, 0.5 * (low + high));
}

/// Classical Runge-Kutta for (u, e) over ln rho: du/dlnrho = c, de/dlnrho = p / rho.
TaylorWave::TaylorWave(const Explosive &explosive, LeftEnd end)
    : explosive_(explosive), end_(end), front_(chapman_jouguet(explosive)) {
  const auto &law = explosive.products;
  const auto c = [&](double rho, double e) { return std::sqrt(law.sound_speed_squared(rho, e)); };
  double log_density = std::log(front_.state.density);
  double u = front_.state.velocity;
  double e = front_.energy;
  constexpr double lowest = 1e-4; // of the initial density: p is 1e-6 of the front's there
  const double h = -1e-4;
  const auto add = [&] {
    const double rho = std::exp(log_density);
    table_.push_back({u + c(rho, e), {rho, u, law.pressure(rho, e)}});
  };
  add();
  while (std::exp(log_density) > lowest * explosive.density) {
    const auto rates = [&](double log_rho, double energy) {
      const double rho = std::exp(log_rho);
      return std::pair{c(rho, energy), law.pressure(rho, energy) / rho};
    };
    const auto [u1, e1] = rates(log_density, e);
    const auto [u2, e2] = rates(log_density + 0.5 * h, e + 0.5 * h * e1);
    const auto [u3, e3] = rates(log_density + 0.5 * h, e + 0.5 * h * e2);
    const auto [u4, e4] = rates(log_density + h, e + h * e3);
    const double du = h / 6 * (u1 + 2 * u2 + 2 * u3 + u4);
    const double de = h / 6 * (e1 + 2 * e2 + 2 * e3 + e4);
    if (end == LeftEnd::wall && u + du < 0) { // the last part of a step, to u = 0
      const double part = u / -du;
      u = 0;
      e += part * de;
      log_density += part * h;
      add();
      break;
    }
    u += du;
    e += de;
    log_density += h;
    add();
  }
}

State TaylorWave::at(double speed) const {
  if (speed > front_.speed)
    return {explosive_.density, 0, 0};
  if (speed >= table_.front().speed)
    return table_.front().state;
  if (speed <= table_.back().speed)
    return end_ == LeftEnd::wall ? table_.back().state : State{0, speed, 0};
  const auto after = std::lower_bound(table_.begin(), table_.end(), speed,
                                      [](const Entry &entry, double value) { return entry.speed > value; });
  const auto before = after - 1;
  const double part = (before->speed - speed) / (before->speed - after->speed);
  const auto mix = [&](double a, double b) { return a + part * (b - a); };
  return {mix(before->state.density, after->state.density), mix(before->state.velocity, after->state.velocity),
          mix(before->state.pressure, after->state.pressure)};
}

} // namespace comparisons::benchmarks::detonation
