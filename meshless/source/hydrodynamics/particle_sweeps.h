#pragma once

#include "gas_arrays.h"

#include <type_traits>

/// The loops over the particles of a step. Each does all that can be done there, because a step's time is that of the
/// arrays that it runs through; what an effect adds exists only where the effect does.
namespace meshless::hydrodynamics {

namespace internal {

template <typename T>
T get(const Field &field, std::size_t i) {
  if constexpr (std::is_same_v<T, double>)
    return field[i];
  else
    return load(&field[i]);
}

inline void put(double value, Field &field, std::size_t i) { field[i] = value; }
inline void put(const Pack &value, Field &field, std::size_t i) { store(value, &field[i]); }

/// f(i, T{}) with T a pack, and double for what remains behind the last whole one.
template <typename F>
void for_particles(std::size_t begin, std::size_t end, const F &f) {
  std::size_t i = begin;
  for (; i + n_lanes <= end; i += n_lanes)
    f(i, Pack{});
  for (; i < end; ++i)
    f(i, double{});
}

} // namespace internal

/// Positions drift, velocity and energy are predicted by the last rates.
template <bool continuity>
void drift_and_predict(GasArrays &gas, double half) {
  using namespace internal;
  for_particles(gas.begin(), gas.end(), [&]<typename T>(std::size_t i, T) {
    const T v = get<T>(gas.velocity, i);
    put(get<T>(gas.position, i) + half * v, gas.position, i);
    put(v + half * get<T>(gas.acceleration, i), gas.predicted_velocity, i);
    put(get<T>(gas.energy, i) + half * get<T>(gas.energy_rate, i), gas.predicted_energy, i);
    if constexpr (continuity) {
      const T rho = get<T>(gas.density, i);
      put(rho, gas.start_density, i);
      put(rho + half * get<T>(gas.density_rate, i), gas.density, i);
    }
  });
}

/// Pressure and sound speed from density and predicted energy; the sums of the pairs start at zero.
/// @param burnt share of the pressure that acts at a place of the arrays, or effects::Absent
template <bool continuity, bool viscous, bool conducting, typename Law, typename Burnt>
[[gnu::flatten]] void apply_state(GasArrays &gas, const Law &law, const Burnt &burnt) {
  using namespace internal;
  for_particles(gas.begin(), gas.end(), [&]<typename T>(std::size_t i, T) {
    const T rho = get<T>(gas.density, i);
    const T e = get<T>(gas.predicted_energy, i);
    T p = law.pressure(rho, e);
    if constexpr (effects::is_present<Burnt>)
      p *= burnt(i, T{});
    put(p, gas.pressure, i);
    put(continuity ? p : T(p / (rho * rho)), gas.pressure_term, i);
    put(kernels::square_root(T(law.sound_speed_squared(rho, e))), gas.sound_speed, i);
    put(T(0), gas.force, i);
    put(T(0), gas.compression, i);
    if constexpr (viscous)
      put(T(0), gas.viscous_work, i);
    if constexpr (conducting)
      put(T(0), gas.heat, i);
  });
}

/// Acceleration; the velocities before and after the kick, and their mean.
inline void kick(GasArrays &gas, double dt) {
  using namespace internal;
  for_particles(gas.begin(), gas.end(), [&]<typename T>(std::size_t i, T) {
    const T a = get<T>(gas.force, i) / get<T>(gas.mass, i);
    const T v = get<T>(gas.velocity, i);
    put(a, gas.acceleration, i);
    put(v + 0.5 * dt * a, gas.predicted_velocity, i);
    put(v + dt * a, gas.velocity, i);
  });
}

/// Rates of energy and density; with dt > 0 they act, and positions drift for the step's second half.
/// @param smoothing h m / rho of adaptive lengths, or 0
template <bool continuity, bool viscous, bool conducting>
[[gnu::flatten]] void form_rates(GasArrays &gas, double dt, double smoothing) {
  using namespace internal;
  for_particles(gas.begin(), gas.end(), [&]<typename T>(std::size_t i, T) {
    const T m = get<T>(gas.mass, i);
    const T compression = get<T>(gas.compression, i);
    T power = get<T>(gas.pressure_term, i) * compression;
    if constexpr (viscous)
      power += get<T>(gas.viscous_work, i);
    if constexpr (conducting)
      power += get<T>(gas.heat, i);
    const T rate = power / m;
    put(rate, gas.energy_rate, i);
    T rho = get<T>(gas.density, i);
    if constexpr (continuity)
      put(rho * rho * compression / m, gas.density_rate, i);
    if (dt <= 0)
      return;
    put(get<T>(gas.energy, i) + dt * rate, gas.energy, i);
    if constexpr (continuity) {
      rho = get<T>(gas.start_density, i) + dt * get<T>(gas.density_rate, i);
      put(rho, gas.density, i);
    }
    put(get<T>(gas.position, i) + 0.5 * dt * get<T>(gas.velocity, i), gas.position, i);
    if (smoothing > 0)
      put(smoothing * m / rho, gas.smoothing_length, i);
  });
}

} // namespace meshless::hydrodynamics
