#include "meshless/hydrodynamics/gas_flow.h"

#include "gas_arrays.h"
#include "pair_passes.h"
#include "pair_ranges.h"
#include "particle_sweeps.h"

#include "meshless/dynamics/violation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meshless::hydrodynamics {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

namespace {

/// Over that at t = 0: below it a run would not end. A strong shock divides the step by a hundred or a thousand.
constexpr double least_step = 1e-6;

} // namespace

class GasFlow::Implementation {
public:
  Implementation(const GasParticles &particles, const GasOptions &options)
      : options_(options), arrays_(particles, options), ranges_(arrays_.allocated()) {
    start_lengths();
    evaluate_rates();
    refresh();
    guard_and_find_limit();
  }

  double stable_step() const { return limit_; }

  void step(double dt) {
    if (!(dt <= limit_ * (1 + 1e-12)))
      violate(limiting_, fmt::format("the time step {:.4g} s is {:.3g} times the largest stable one, {:.4g} s = h / (c "
                                     "+ 0.6 (alpha c + beta mu)) of this particle",
                                     dt, dt / limit_, limit_));
    if (options_.predictor == Predictor::midpoint)
      evaluate_rates();
    const bool continuity = options_.density == DensityRule::continuity;
    if (continuity)
      drift_and_predict<true>(arrays_, 0.5 * dt);
    else
      drift_and_predict<false>(arrays_, 0.5 * dt);
    evaluate(time_ + 0.5 * dt);
    kick(arrays_, dt);
    work_along(arrays_.predicted_velocity);
    form_all_rates(dt);
    time_ += dt;
    ++steps_;
    guard_and_find_limit();
  }

  Snapshot snapshot() {
    const Field density = arrays_.density;
    const Field sound_speed = arrays_.sound_speed;
    refresh();
    Snapshot result;
    const auto copy = [](std::span<const double> values) { return std::vector<double>(values.begin(), values.end()); };
    result.density = copy(arrays_.own(&GasArrays::density));
    result.pressure = copy(arrays_.own(&GasArrays::pressure));
    arrays_.density.copy(density);
    arrays_.sound_speed.copy(sound_speed);
    return result;
  }

  double total_energy() const {
    double sum = 0;
    for (std::size_t i = arrays_.begin(); i < arrays_.end(); ++i)
      sum += arrays_.mass[i] * (0.5 * arrays_.velocity[i] * arrays_.velocity[i] + arrays_.energy[i]);
    return sum;
  }

  std::vector<effects::Usage> usage() const {
    const std::size_t field = arrays_.allocated() * sizeof(double);
    std::vector<effects::Usage> all{{"gas_pressure", 0, n_evaluations_}, {"inertia", 0, steps_}};
    if (options_.viscosity)
      all.push_back({"artificial_viscosity", field + arrays_.pair_viscous.capacity() * sizeof(double), n_evaluations_});
    if (options_.conduction)
      all.push_back({"heat_conduction", field, n_evaluations_});
    if (options_.burn)
      all.push_back({"programmed_burn", arrays_.start_position.size() * sizeof(double), n_evaluations_});
    return all;
  }

  std::size_t bytes() const { return arrays_.bytes() + ranges_.bytes(); }

  GasArrays &arrays() { return arrays_; }
  const GasArrays &arrays() const { return arrays_; }
  double &time() { return time_; }
  const double &time() const { return time_; }
  std::int64_t steps() const { return steps_; }

  dynamics::State state() {
    dynamics::State all = arrays_.state(options_);
    counters_[0] = time_;
    counters_[1] = static_cast<double>(steps_);
    counters_[2] = first_limit_;
    all.push_back({"time_and_steps", counters_});
    return all;
  }

  /// After the state was set from outside.
  void adopt_state() {
    time_ = counters_[0];
    steps_ = static_cast<std::int64_t>(counters_[1]);
    first_limit_ = counters_[2];
    guard_and_find_limit();
  }

private:
  /// Calls f<continuity, viscous, conducting>().
  template <typename F>
  void with_effects(const F &f) const {
    const auto with = [&]<bool continuity>() {
      if (options_.viscosity && options_.conduction)
        f.template operator()<continuity, true, true>();
      else if (options_.viscosity)
        f.template operator()<continuity, true, false>();
      else if (options_.conduction)
        f.template operator()<continuity, false, true>();
      else
        f.template operator()<continuity, false, false>();
    };
    if (options_.density == DensityRule::continuity)
      with.template operator()<true>();
    else
      with.template operator()<false>();
  }

  /// Rates at the present state.
  void evaluate_rates() {
    arrays_.predicted_velocity.copy(arrays_.velocity);
    arrays_.predicted_energy.copy(arrays_.energy);
    evaluate(time_);
    kick(arrays_, 0);
    work_along(arrays_.velocity);
    form_all_rates(0);
  }

  void form_all_rates(double dt) {
    with_effects([&]<bool continuity, bool viscous, bool conducting>() {
      form_rates<continuity, viscous, conducting>(arrays_, dt, options_.adaptive ? options_.smoothing : 0);
    });
  }

  /// Density and pressure of the present positions.
  void refresh() {
    if (options_.density == DensityRule::summation) {
      place_images();
      find_ranges();
      sum();
    }
    arrays_.predicted_energy.copy(arrays_.energy);
    apply_law(time_);
  }

  [[noreturn]] void violate(std::size_t place, const std::string &reason) const {
    throw dynamics::Violation(time_, static_cast<std::int64_t>(place - arrays_.begin()), arrays_.position[place],
                              reason);
  }

  /// h by m / rho, iterated with the density that it gives.
  void start_lengths() {
    for (std::size_t i = arrays_.begin(); i < arrays_.end(); ++i)
      arrays_.smoothing_length[i] =
          options_.adaptive ? options_.smoothing * arrays_.mass[i] / arrays_.density[i] : options_.fixed_length;
    constexpr int rounds = 20; // the change falls by a third to a half a round
    for (int round = 0; round < rounds && options_.adaptive && options_.density == DensityRule::summation; ++round) {
      place_images();
      find_ranges();
      sum();
      adapt_lengths();
    }
  }

  void adapt_lengths() {
    const double eta = options_.smoothing;
    for (std::size_t i = arrays_.begin(); i < arrays_.end(); ++i)
      arrays_.smoothing_length[i] = eta * arrays_.mass[i] / arrays_.density[i];
  }

  /// (c + 0.6 (alpha c + beta mu)) / h of a particle; those at the ends have one neighbour.
  double inverse_step(std::size_t i) const {
    const double alpha = options_.viscosity ? options_.viscosity->linear : 0;
    const double beta = options_.viscosity ? options_.viscosity->quadratic : 0;
    const auto closing = [&](std::size_t a, std::size_t b) {
      return (arrays_.velocity[a] - arrays_.velocity[b]) / (arrays_.position[b] - arrays_.position[a]);
    };
    double rate = 0;
    if (i > arrays_.begin())
      rate = std::max(rate, closing(i - 1, i));
    if (i + 1 < arrays_.end())
      rate = std::max(rate, closing(i, i + 1));
    const double c = arrays_.sound_speed[i];
    return (c + 0.6 * (alpha * c + beta * arrays_.smoothing_length[i] * rate)) / arrays_.smoothing_length[i];
  }

  /// Finite values, positive density and energy, order; the largest stable step and the particle that it is of.
  void guard_and_find_limit() {
    const std::size_t end = arrays_.end();
    largest_inverse_ = 0;
    std::size_t i = arrays_.begin();
    check(i);
    take(i++);
    if (options_.viscosity)
      i = sweep<true>(i);
    else
      i = sweep<false>(i);
    for (; i < end; ++i) {
      check(i);
      take(i);
    }
    limit_ = 1 / largest_inverse_;
    if (steps_ == 0)
      first_limit_ = limit_;
    else if (!(limit_ > least_step * first_limit_))
      violate(limiting_,
              fmt::format("the stable time step has fallen to {:.3g} s from {:.3g} s at the start: particles "
                          "collide",
                          limit_, first_limit_));
  }

  void take(std::size_t i) {
    if (const double value = inverse_step(i); !(value <= largest_inverse_)) {
      largest_inverse_ = value;
      limiting_ = i;
    }
  }

  /// The same for whole packs from `i` on, without a division unless a particle has a smaller step than those before:
  /// (A c + B h dv / dx) <= L h is A c dx + B h dv <= L h dx. Returns where it ends.
  template <bool viscous>
  std::size_t sweep(std::size_t i) {
    const double alpha = viscous ? options_.viscosity->linear : 0;
    const double beta = viscous ? options_.viscosity->quadratic : 0;
    const double for_sound = (1 + 0.6 * alpha) * (1 + 1e-12);
    const double for_speed = 0.6 * beta * (1 + 1e-12);
    const Pack most(std::numeric_limits<double>::max());
    for (; i + n_lanes < arrays_.end(); i += n_lanes) {
      const Pack h = load(&arrays_.smoothing_length[i]);
      const Pack c = for_sound * load(&arrays_.sound_speed[i]);
      const Pack x = load(&arrays_.position[i]);
      const Pack v = load(&arrays_.velocity[i]);
      const Pack e = load(&arrays_.energy[i]);
      const Pack dx_after = load(&arrays_.position[i + 1]) - x;
      if (!all_of(dx_after > Pack(0) && load(&arrays_.density[i]) > Pack(0) && e > Pack(0) && e < most &&
                  abs(v) < most))
        for (std::size_t lane = 0; lane < n_lanes; ++lane)
          check(i + lane);
      const Pack limit = largest_inverse_ * h;
      auto below = c <= limit;
      if constexpr (viscous) {
        const Pack dx_before = x - load(&arrays_.position[i - 1]);
        const Pack dv_before = load(&arrays_.velocity[i - 1]) - v;
        const Pack dv_after = v - load(&arrays_.velocity[i + 1]);
        below = below && (limit - c) * dx_before >= for_speed * h * dv_before &&
                (limit - c) * dx_after >= for_speed * h * dv_after;
      }
      if (!all_of(below))
        for (std::size_t lane = 0; lane < n_lanes; ++lane)
          take(i + lane);
    }
    return i;
  }

  void place_images() {
    if (arrays_.place_images(options_, ranges_reach()))
      return;
    violate(arrays_.begin(), "too many particles within the support's radius of a wall");
  }

  double ranges_reach() const { return kernels::support_of(options_.kernel); }

  void find_ranges() {
    if (!ranges_.find(arrays_.position.data(), arrays_.smoothing_length.data(), arrays_.first(), arrays_.last(),
                      ranges_reach()))
      violate(arrays_.begin(), fmt::format("a particle has more than {} neighbours to one side: the gas is compressed "
                                           "far below its smoothing length",
                                           padding - block_size));
    if (arrays_.pair_gradient.size() < ranges_.n_pairs()) { // with a margin, so that it is rare
      arrays_.pair_gradient.resize(ranges_.n_pairs() + ranges_.n_pairs() / 4);
      if (options_.viscosity)
        arrays_.pair_viscous.resize(arrays_.pair_gradient.size());
    }
  }

  void sum() {
    std::visit(
        [&](const auto &kernel) {
          const double centre = kernel.normalisation(1) * kernel.value(0.0);
          for (std::size_t i = arrays_.first(); i < arrays_.last(); ++i)
            arrays_.density[i] = arrays_.mass[i] * centre / arrays_.smoothing_length[i];
          sum_density(kernel, ranges_, arrays_.fields());
        },
        options_.kernel);
  }

  /// Pressure and sound speed from density and predicted energy.
  void apply_law(double time) {
    with_effects([&]<bool continuity, bool viscous, bool conducting>() {
      std::visit(
          [&](const auto &law) {
            if (options_.burn)
              apply_state<continuity, viscous, conducting>(arrays_, law, [&]<typename T>(std::size_t i, T) {
                const auto share = [&](std::size_t lane) {
                  return options_.burn->fraction(arrays_.start_position[i + lane - arrays_.begin()], time);
                };
                if constexpr (std::is_same_v<T, double>)
                  return share(0);
                else
                  return T([&](auto lane) { return share(lane); });
              });
            else
              apply_state<continuity, viscous, conducting>(arrays_, law, effects::Absent{});
          },
          options_.equation_of_state);
    });
  }

  /// Forces at the present positions with the predicted velocity and energy.
  void evaluate(double time) {
    ++n_evaluations_;
    place_images();
    find_ranges();
    if (options_.density == DensityRule::summation)
      sum();
    apply_law(time);
    arrays_.copy_images();
    Fields fields = arrays_.fields();
    fields.velocity = arrays_.predicted_velocity.data();
    fields.energy = arrays_.predicted_energy.data();
    if (options_.density == DensityRule::continuity)
      add_all_forces<true>(fields);
    else
      add_all_forces<false>(fields);
  }

  template <bool continuity>
  void add_all_forces(const Fields &fields) {
    const effects::Absent absent;
    std::visit(
        [&](const auto &kernel) {
          if (options_.viscosity && options_.conduction)
            add_forces<continuity>(kernel, *options_.viscosity, *options_.conduction, ranges_, fields);
          else if (options_.viscosity)
            add_forces<continuity>(kernel, *options_.viscosity, absent, ranges_, fields);
          else if (options_.conduction)
            add_forces<continuity>(kernel, absent, *options_.conduction, ranges_, fields);
          else
            add_forces<continuity>(kernel, absent, absent, ranges_, fields);
        },
        options_.kernel);
  }

  void work_along(Field &velocity) {
    Fields fields = arrays_.fields();
    fields.velocity = velocity.data();
    arrays_.reverse_images(velocity);
    if (options_.viscosity)
      add_work<true>(ranges_, fields);
    else
      add_work<false>(ranges_, fields);
  }

  void check(std::size_t i) const {
    const double x = arrays_.position[i];
    if (!std::isfinite(x) || !std::isfinite(arrays_.velocity[i]) || !std::isfinite(arrays_.energy[i]))
      violate(i, "a value is not finite");
    if (!(arrays_.density[i] > 0))
      violate(i, fmt::format("the density {:.4g} kg/m^3 is not positive", arrays_.density[i]));
    if (!(arrays_.energy[i] > 0))
      violate(i, fmt::format("the internal energy {:.4g} J/kg is not positive", arrays_.energy[i]));
    if (i + 1 < arrays_.end() && !(x < arrays_.position[i + 1]))
      violate(i, fmt::format("particles cross: the next one is at x = {:.6g} m", arrays_.position[i + 1]));
  }

  GasOptions options_;
  GasArrays arrays_;
  PairRanges ranges_;
  double time_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t n_evaluations_ = 0;
  double limit_ = 0; ///< largest stable step
  double first_limit_ = 0;
  double largest_inverse_ = 0;
  std::size_t limiting_ = 0;
  std::array<double, 3> counters_{};
};

GasFlow::GasFlow(const GasParticles &particles, const GasOptions &options)
    : implementation_(std::make_unique<Implementation>(particles, options)) {}
GasFlow::~GasFlow() = default;
GasFlow::GasFlow(GasFlow &&) noexcept = default;

std::int64_t GasFlow::n_particles() const { return static_cast<std::int64_t>(mass().size()); }
double GasFlow::time() const { return std::as_const(*implementation_).time(); }
std::int64_t GasFlow::steps() const { return implementation_->steps(); }
double GasFlow::stable_step() const { return implementation_->stable_step(); }
void GasFlow::step(double time_step) { implementation_->step(time_step); }
GasFlow::Snapshot GasFlow::snapshot() { return implementation_->snapshot(); }
std::span<const double> GasFlow::mass() const { return implementation_->arrays().own(&GasArrays::mass); }
std::span<const double> GasFlow::position() const { return implementation_->arrays().own(&GasArrays::position); }
std::span<const double> GasFlow::velocity() const { return implementation_->arrays().own(&GasArrays::velocity); }
std::span<const double> GasFlow::energy() const { return implementation_->arrays().own(&GasArrays::energy); }
std::span<const double> GasFlow::density() const { return implementation_->arrays().own(&GasArrays::density); }
std::span<const double> GasFlow::smoothing_length() const {
  return implementation_->arrays().own(&GasArrays::smoothing_length);
}

double GasFlow::total_momentum() const {
  double sum = 0;
  for (std::size_t i = 0; i < mass().size(); ++i)
    sum += mass()[i] * velocity()[i];
  return sum;
}

double GasFlow::momentum_scale() const {
  double sum = 0;
  for (std::size_t i = 0; i < mass().size(); ++i)
    sum += std::abs(mass()[i] * velocity()[i]);
  return sum;
}

double GasFlow::total_energy() const { return implementation_->total_energy(); }
dynamics::State GasFlow::state() { return implementation_->state(); }
void GasFlow::adopt_state() { implementation_->adopt_state(); }
std::vector<effects::Usage> GasFlow::usage() const { return implementation_->usage(); }
std::size_t GasFlow::bytes() const { return implementation_->bytes(); }

} // namespace meshless::hydrodynamics
