#include "comparisons/study/transient.h"

#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace comparisons::study {

namespace {

/// No step is taken for less than this part of the time, or split for less than this part of itself: it is the rounding
/// of sums of steps.
constexpr double sliver = 1e-11;

class TimeLoop {
public:
  TimeLoop(Evolution &evolution, const TimeSettings &settings, const TimeServices &services)
      : evolution_(evolution), settings_(settings), services_(services) {}

  TimeOutcome run() {
    resume();
    if (settings_.step || evolution_.constant_step())
      fixed_ = settings_.step ? *settings_.step : settings_.cfl * evolution_.step_unit();
    started_ = last_report_ = Clock::now();
    first_time_ = evolution_.time();
    for (std::int64_t index = 1; index <= settings_.snapshots; ++index) {
      const double target = settings_.end * static_cast<double>(index) / static_cast<double>(settings_.snapshots);
      if (outcome_.resumed &&
          evolution_.time() > target + (evolution_.constant_step() ? 0.5 * fixed_ : sliver * target))
        continue; // was taken before the checkpoint
      advance(target);
      if (services_.snapshot)
        services_.snapshot(index, outcome_.measured);
    }
    return outcome_;
  }

private:
  using Clock = std::chrono::steady_clock;

  void resume() {
    if (!settings_.resume || services_.checkpoint.empty() || !std::filesystem::exists(services_.checkpoint))
      return;
    outcome_.measured = read_checkpoint(services_.checkpoint, services_.identity, evolution_.state());
    evolution_.adopt_state();
    outcome_.resumed = true;
  }

  /// No step towards the target is left.
  bool reached(double target) const {
    if (evolution_.constant_step())
      return evolution_.time() + 0.5 * fixed_ >= target;
    return target - evolution_.time() <= sliver * target;
  }

  double next_step(double target) const {
    if (evolution_.constant_step())
      return fixed_;
    const double rest = target - evolution_.time();
    const double wanted = fixed_ > 0 ? fixed_ : settings_.cfl * evolution_.step_unit();
    if (rest <= wanted * (1 + sliver))
      return rest;
    return fixed_ == 0 && rest < 2 * wanted ? 0.5 * rest : wanted; // two equal steps instead of one and a sliver
  }

  void advance(double target) {
    meshless::linear_algebra::Stopwatch watch;
    while (!reached(target)) {
      const double dt = next_step(target);
      const double ratio = dt / evolution_.stable_step();
      evolution_.step(dt);
      outcome_.largest_ratio = std::max(outcome_.largest_ratio, ratio);
      outcome_.largest_step = std::max(outcome_.largest_step, dt);
      outcome_.smallest_step = outcome_.smallest_step > 0 ? std::min(outcome_.smallest_step, dt) : dt;
      const bool checkpoint = settings_.checkpoint_every && !services_.checkpoint.empty() &&
                              evolution_.steps() % *settings_.checkpoint_every == 0;
      constexpr std::int64_t look_at_the_clock = 32;
      if (!checkpoint && evolution_.steps() % look_at_the_clock != 0)
        continue;
      outcome_.seconds += watch.lap();
      if (checkpoint)
        write_checkpoint(services_.checkpoint, services_.identity, evolution_.state(), outcome_.measured);
      report(ratio);
      watch.lap();
    }
    outcome_.seconds += watch.lap();
  }

  void report(double ratio) {
    const auto now = Clock::now();
    if (!services_.progress || now - last_report_ < std::chrono::milliseconds(500))
      return;
    last_report_ = now;
    const double done = (evolution_.time() - first_time_) / (settings_.end - first_time_);
    const double spent = std::chrono::duration<double>(now - started_).count();
    services_.progress(fmt::format("step {}, t = {:.4g} of {:.4g} s, step {:.2f} of the stable one, energy error "
                                   "{:.1e}, {:.0f} s left",
                                   evolution_.steps(), evolution_.time(), settings_.end, ratio,
                                   evolution_.energy_error(), spent * (1 / done - 1)));
  }

  Evolution &evolution_;
  const TimeSettings &settings_;
  const TimeServices &services_;
  TimeOutcome outcome_;
  double fixed_ = 0; ///< 0: the step changes
  double first_time_ = 0;
  Clock::time_point started_, last_report_;
};

} // namespace

TimeSettings::TimeSettings(const scene::Parameters &time)
    : end(time.real("end")), cfl(time.real("cfl")), snapshots(time.integer("snapshots")),
      resume(time.boolean("resume")) {
  if (time.has("step"))
    step = time.real("step");
  if (time.has("checkpoint_every"))
    checkpoint_every = time.integer("checkpoint_every");
}

TimeOutcome run_in_time(Evolution &evolution, const TimeSettings &settings, const TimeServices &services) {
  return TimeLoop(evolution, settings, services).run();
}

} // namespace comparisons::study
