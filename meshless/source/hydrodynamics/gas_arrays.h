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

  void copy(const Field &other) { std::copy(other.values_.begin(), other.values_.end(), values_.begin()); }

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
  /// What the force pass reads of the images beside that; their own sums start at zero.
  void copy_images();
  void reverse_images(Field &of) const;

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
