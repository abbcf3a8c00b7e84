#include "comparisons/benchmarks/bar_wave/exact.h"

#include <algorithm>

namespace comparisons::benchmarks::bar_wave {

namespace {

/// Sums f(incoming, returning) over all reflections whose first wave has come in by t.
template <typename F>
double sum_of_reflections(const PulseSolution &pulse, double x, double t, F f) {
  double sum = 0;
  for (int n = 0; 2 * n * pulse.length <= pulse.wave_speed * t; ++n)
    sum += f(pulse.load(t - (2 * n * pulse.length + pulse.length - x) / pulse.wave_speed),
             pulse.load(t - (2 * n * pulse.length + pulse.length + x) / pulse.wave_speed));
  return sum;
}

} // namespace

double PulseSolution::mean_load(double from, double to) const {
  const double overlap = std::max(0.0, std::min(to, duration) - std::max(from, 0.0));
  return -stress * overlap / (to - from);
}

double PulseSolution::stress_at(double x, double t) const {
  return sum_of_reflections(*this, x, t, [](double in, double back) { return in - back; });
}

double PulseSolution::velocity_at(double x, double t) const {
  return sum_of_reflections(*this, x, t, [](double in, double back) { return in + back; }) / impedance;
}

} // namespace comparisons::benchmarks::bar_wave
