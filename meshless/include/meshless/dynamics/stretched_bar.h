#pragma once

#include "meshless/dynamics/elastic_bar.h"
#include "meshless/kernels/kernel_table.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace meshless::dynamics {

/// Test of Swegle, Hicks & Attaway 1995 for instability under tension: a bar that is stretched, held at its ends and at
/// rest, with a small disturbance of the velocities. Elastic energy bounds what the disturbance can become; a scheme
/// whose kernels follow the particles may let it grow without bound.
struct StretchedBarOptions {
  std::size_t n_particles = 60; ///< with those that are held
  double spacing = 1;           ///< D of the stretched bar, m
  double youngs_modulus = 1;    ///< Pa
  double density = 1;           ///< kg/m^3
  double stretch = 0.01;        ///< strain at t = 0; negative: compressed
  double disturbance = 1e-6;    ///< largest velocity at t = 0 over the wave speed
  std::uint64_t seed = 42;
  KernelPositions kernel_positions = KernelPositions::current;
  /// SPH: d sigma_i/dt = E sum_j D (v_j - v_i) W'_ij, rho dv_i/dt = sum_j D (sigma_i + sigma_j) W'_ij with this kernel
  /// and h ...
  kernels::Kernel kernel;
  double smoothing_length = 1.2; ///< m
  /// ... or, if given, d sigma/dt = E D1 v, rho dv/dt = D1 sigma with the rows of a basis.
  std::function<LineOperators(std::span<const double>)> operators = {};
};

class StretchedBar {
public:
  /// @throws std::invalid_argument for constants out of range or too few particles that are not held
  explicit StretchedBar(const StretchedBarOptions &options);

  double time() const { return time_; }
  std::int64_t steps() const { return steps_; }
  double wave_speed() const { return wave_speed_; }

  /// @throws Violation once a velocity is a thousand times the largest at t = 0, or particles cross
  void step(double time_step);

  /// Largest velocity over that at t = 0.
  double growth() const;

  State state();
  void adopt_state();
  std::span<const double> positions() const { return positions_; }
  std::span<const double> velocity() const { return velocity_; }

private:
  void gradients(std::span<const double> places);
  bool is_held(std::size_t i) const { return i < n_held_ || i + n_held_ >= positions_.size(); }

  StretchedBarOptions options_;
  double wave_speed_;
  std::size_t n_held_ = 0;
  double first_velocity_ = 0;
  std::vector<double> positions_, velocity_, stress_, rate_;
  linear_algebra::SparseRows weights_; ///< of the stress rate: sum_j w_ij v_j
  bool conservative_;                  ///< SPH: forces are sum_j w_ij (sigma_i + sigma_j)
  double time_ = 0;
  std::int64_t steps_ = 0;
  std::vector<double> counters_;
};

} // namespace meshless::dynamics
