// What the general bar costs beside loops written by hand for just the effects of a scene: `ratio` - 1 is to be below 5
// %. Both take turns in short batches on the same core, so that what else the machine does hits both; medians are
// compared.

#include "performance/turns.h"
#include "performance/unit_bar.h"

#include "meshless/linear_algebra/aligned_vector.h"
#include "meshless/linear_algebra/pack.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace meshless;
using performance::median;
using performance::Turns;

constexpr double dt = 0.8;
constexpr double viscosity = 0.05;
constexpr double damping = 1e-6;

/// Elasticity and inertia, with the argument viscosity and damping: five diagonals, a load at the right end and a free
/// left one; nothing else is known, nothing is watched, no energy is counted. Displacement follows velocity in one
/// pass.
template <int further_effects>
class BarByHand {
public:
  explicit BarByHand(int n)
      : n_(n), stride_(linear_algebra::padded(static_cast<std::size_t>(n))), diagonals_(5 * stride_, 0.0),
        u_(stride_ + 2 * margin, 0.0), v_(u_), q_(u_) {
    const auto options = performance::bar_options(n);
    const auto rows = options.operators(options.positions);
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
      for (auto e = rows.second.offsets()[i]; e < rows.second.offsets()[i + 1]; ++e) {
        const auto j = rows.second.columns()[static_cast<std::size_t>(e)];
        diagonals_[static_cast<std::size_t>(j - static_cast<std::int64_t>(i) + 2) * stride_ + i] =
            rows.second.values()[static_cast<std::size_t>(e)];
      }
    // The row of an end over the entry of the end itself.
    const auto entry = [&](int i, int j) {
      for (auto e = rows.first.offsets()[static_cast<std::size_t>(i)];
           e < rows.first.offsets()[static_cast<std::size_t>(i) + 1]; ++e)
        if (rows.first.columns()[static_cast<std::size_t>(e)] == j)
          return rows.first.values()[static_cast<std::size_t>(e)];
      return 0.0;
    };
    for (std::size_t side = 0; side < 2; ++side) {
      const int at = side == 0 ? 0 : n - 1;
      const int inward = side == 0 ? 1 : -1;
      end_[side] = std::array{1 / entry(at, at), -entry(at, at + inward) / entry(at, at),
                              -entry(at, at + 2 * inward) / entry(at, at)};
    }
  }

  [[gnu::noinline]] void step() { // as the general one: what is around it moves neither
    using linear_algebra::load;
    using linear_algebra::n_lanes;
    using linear_algebra::Pack;
    using linear_algebra::store;
    double *u = u_.data() + margin;
    double *v = v_.data() + margin;
    const double *d = diagonals_.data();
    const double first = u[0];
    const double last = u[n_ - 1];
    const double *x = u;
    if constexpr (further_effects >= 1) {
      double *q = q_.data() + margin;
      for (int i = 0; i < n_; i += n_lanes)
        store(load(u + i) + viscosity * load(v + i), q + i);
      x = q;
    }
    const auto kick = [&](int i) {
      const auto s = stride_;
      const Pack a = load(d + i) * load(x + i - 2) + load(d + s + i) * load(x + i - 1) +
                     load(d + 2 * s + i) * load(x + i) + load(d + 3 * s + i) * load(x + i + 1) +
                     load(d + 4 * s + i) * load(x + i + 2);
      const Pack before = load(v + i);
      const Pack after = (further_effects >= 2 ? Pack((1 - dt * damping) * before) : before) + dt * a;
      store(after, v + i);
      return after;
    };
    if constexpr (further_effects >= 1) {
      for (int i = 0; i < n_; i += n_lanes)
        store(load(u + i) + dt * kick(i), u + i);
    } else {
      static_assert(n_lanes >= 2, "the rows reach back by two");
      Pack before = kick(0);
      int i = n_lanes;
      for (; i < n_; i += n_lanes) {
        const Pack now = kick(i);
        store(load(u + i - n_lanes) + dt * before, u + i - n_lanes);
        before = now;
      }
      store(load(u + i - n_lanes) + dt * before, u + i - n_lanes);
    }
    time_ += dt;
    u[0] = end_[0][1] * u[1] + end_[0][2] * u[2];
    u[n_ - 1] = end_[1][0] * (time_ < 50 ? -1.0 : 0.0) + end_[1][1] * u[n_ - 2] + end_[1][2] * u[n_ - 3];
    v[0] = (u[0] - first) * (1 / dt);
    v[n_ - 1] = (u[n_ - 1] - last) * (1 / dt);
  }

  double displacement(int i) const { return u_[static_cast<std::size_t>(margin + i)]; }

private:
  static constexpr int margin = 8;

  int n_;
  std::size_t stride_;
  linear_algebra::AlignedVector diagonals_;
  linear_algebra::AlignedVector u_, v_, q_;
  std::array<std::array<double, 3>, 2> end_{};
  double time_ = 0;
};

template <int further_effects>
void take_turns(int n, int turns, Turns &result) {
  auto options = performance::bar_options(n);
  if (further_effects >= 1)
    options.viscosity = effects::LinearViscosity{viscosity};
  if (further_effects >= 2)
    options.damping = effects::Damping{damping};
  dynamics::ElasticBar general(options);
  BarByHand<further_effects> by_hand(n);
  const int batch = 1600000 / n; // about a millisecond
  for (int turn = 0; turn < turns; ++turn)
    result.take(
        batch, [&] { general.step(dt); }, [&] { by_hand.step(); });
  double difference = 0;
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    const double u = by_hand.displacement(i);
    difference = std::max(difference, std::abs(general.displacement()[static_cast<std::size_t>(i)] - u));
    largest = std::max(largest, std::abs(u));
  }
  result.difference = std::max(result.difference, difference / largest);
}

template <int further_effects>
void general_over_by_hand(benchmark::State &state) {
  const auto n = static_cast<int>(state.range(0));
  Turns turns;
  // Sizes beside n: how the arrays lie to each other moves either loop by 5 %, which is no cost of the general one.
  for (auto _ : state)
    for (int beside = -8; beside <= 8; ++beside)
      take_turns<further_effects>(n + 8 * beside, 25, turns);
  if (!(turns.difference <= 1e-9)) // of rounding, over some 1e5 steps; loops that compute something else prove nothing
    state.SkipWithError("the two do not compute the same");
  state.counters["general_ns_a_step"] = 1e9 * median(turns.general);
  state.counters["by_hand_ns_a_step"] = 1e9 * median(turns.by_hand);
  state.counters["ratio"] = median(turns.ratio);
  state.counters["difference"] = turns.difference;
}
BENCHMARK(general_over_by_hand<0>)->ArgName("n")->Arg(800)->Arg(8000)->Iterations(1);
BENCHMARK(general_over_by_hand<1>)->ArgName("n")->Arg(800)->Arg(8000)->Iterations(1);
BENCHMARK(general_over_by_hand<2>)->ArgName("n")->Arg(800)->Arg(8000)->Iterations(1);

} // namespace
