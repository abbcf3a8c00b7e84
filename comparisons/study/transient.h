#pragma once

#include "comparisons/scene/parameters.h"
#include "comparisons/study/checkpoint.h"

#include "meshless/dynamics/named_field.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace comparisons::study {

/// A method on its way through time, as `run_in_time` sees it.
class Evolution {
public:
  virtual ~Evolution() = default;

  virtual double time() const = 0; ///< s
  virtual std::int64_t steps() const = 0;
  /// The largest stable step at present, s.
  virtual double stable_step() const = 0;
  /// What [time] cfl multiplies, s.
  virtual double step_unit() const { return stable_step(); }
  /// The step stays the same from start to end, and snapshots are taken at the nearest step.
  virtual bool constant_step() const { return false; }
  /// @throws std::exception saying why the run cannot go on
  virtual void step(double time_step) = 0;
  /// Relative error of the energy balance.
  virtual double energy_error() const = 0;
  virtual meshless::dynamics::State state() = 0;
  virtual void adopt_state() = 0;
};

/// [time] of a scene.
struct TimeSettings {
  double end = 0;
  double cfl = 0;
  std::optional<double> step;
  std::int64_t snapshots = 1;
  std::optional<std::int64_t> checkpoint_every;
  bool resume = false;

  explicit TimeSettings(const scene::Parameters &time);
};

/// What goes on beside the steps; all outside of timed sections.
struct TimeServices {
  /// Called at the snapshots 1 ... n. What it measures may go into the map, which checkpoints keep.
  std::function<void(std::int64_t index, Measured &measured)> snapshot;
  /// One line on how far it is, at most twice a second; may be empty.
  std::function<void(const std::string &)> progress;
  /// Empty: no checkpoints.
  std::filesystem::path checkpoint;
  std::string identity;
};

struct TimeOutcome {
  double seconds = 0; ///< of the steps alone
  double smallest_step = 0;
  double largest_step = 0;
  /// Largest step over the stable one.
  double largest_ratio = 0;
  bool resumed = false;
  Measured measured;
};

/// Steps from where the evolution is to the end, with snapshots, checkpoints and progress.
/// @throws what steps, snapshots and checkpoints throw
TimeOutcome run_in_time(Evolution &evolution, const TimeSettings &settings, const TimeServices &services);

} // namespace comparisons::study
