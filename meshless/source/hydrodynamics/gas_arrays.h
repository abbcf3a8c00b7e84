#pragma once

#include "pair_passes.h"

#include "meshless/hydrodynamics/gas_flow.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meshless::hydrodynamics {

/// One value a particle, with places for images before and behind and for the far particles of `PairRanges`.
class Field {
public:
  Field() = default;
  Field(std::size_t n, double value) : values_(n, value) {}

  double &operator[](std::size_t i) { return values_[i]; }
  const double &operator[](std::size_t i) const { return values_[i]; }
  double *data() { return values_.empty() ? nullptr : values_.data(); }
  const double *data() const { return values_.empty() ? nullptr : values_.data(); }
  std::size_t size() const { return values_.size(); }

  void zero() { std::fill(values_.begin(), values_.end(), 0.0); }
  void copy(const Field &other) { std::copy(other.values_.begin(), other.values_.end(), values_.begin()); }
  void add(double factor, const Field &other) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] += factor * other.values_[i];
  }
  void set_sum(const Field &a, double factor, const Field &b) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = a.values_[i] + factor * b.values_[i];
  }

private:
  std::vector<double> values_;
};

/// The arrays of a GasFlow. Own particles are the places begin() ... end(); images stand directly before and behind,
/// so that first() ... last() is the line that the pairs see.
class GasArrays {
public:
  GasArrays(const GasParticles &particles, const GasOptions &options);

  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }
  std::size_t first() const { return begin_ - n_images_[0]; }
  std::size_t last() const { return end_ + n_images_[1]; }
  std::size_t allocated() const { return mass.size(); }

  std::span<const double> own(const Field GasArrays::*field) const { return {&(this->*field)[begin_], end_ - begin_}; }
  Fields fields();

  /// Positions, masses, lengths and densities of the images; false if there is no room for them.
  bool place_images(const GasOptions &options, double reach);
  /// What the force pass reads of the images beside that.
  void copy_images();
  void reverse_images(Field &of) const;

  template <typename Law>
  void apply(const Law &law) {
    using namespace internal;
    for (std::size_t i = begin_; i < end_; i += n_lanes) {
      const Pack rho = load(&density[i]);
      const Pack e = load(&predicted_energy[i]);
      store(law.pressure(rho, e), &pressure[i]);
      store(kernels::square_root(Pack(law.sound_speed_squared(rho, e))), &sound_speed[i]);
    }
  }
  void form_pressure_term(const GasOptions &options) {
    if (options.density == DensityRule::continuity)
      pressure_term.copy(pressure);
    else
      for (std::size_t i = begin_; i < end_; ++i)
        pressure_term[i] = pressure[i] / (density[i] * density[i]);
  }
  void form_acceleration() {
    for (std::size_t i = begin_; i < end_; ++i)
      acceleration[i] = force[i] / mass[i];
  }
  void form_rates(const GasOptions &options);

  dynamics::State state(const GasOptions &options);
  std::size_t bytes() const;

  Field mass, position, velocity, energy, density, smoothing_length;
  Field predicted_velocity, predicted_energy, start_density;
  Field pressure, sound_speed, pressure_term;
  Field force, compression, acceleration, energy_rate, density_rate;
  Field viscous_work, heat;           ///< of effects
  std::vector<double> start_position; ///< of programmed burn
  std::vector<double> pair_gradient;
  std::vector<double> pair_viscous; ///< of artificial viscosity

private:
  /// Calls f(image, source) for all images.
  template <typename F>
  void for_images(F f) const {
    for (std::size_t k = 0; k < n_images_[0]; ++k)
      f(begin_ - 1 - k, begin_ + k, 0);
    for (std::size_t k = 0; k < n_images_[1]; ++k)
      f(end_ + k, end_ - 1 - k, 1);
  }

  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::array<std::size_t, 2> room_{0, 0};
  std::array<std::size_t, 2> n_images_{0, 0};
  double far_ = 0; ///< step of the far particles' positions
};

} // namespace meshless::hydrodynamics
