// Conservation, guards and state of the gas; the equations of state by differences.

#include "meshless/dynamics/violation.h"
#include "meshless/hydrodynamics/gas_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace {

using namespace meshless;
using namespace meshless::hydrodynamics;

GasParticles tube(std::size_t n, double right_pressure = 0.2) {
  GasParticles p;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    p.position.push_back(x);
    p.mass.push_back(1.0 / static_cast<double>(n));
    p.velocity.push_back(0.1 * std::sin(6 * x));
    p.density.push_back(1);
    p.energy.push_back((x < 0.5 ? 1 : right_pressure) / 0.4);
  }
  return p;
}

GasOptions options(const char *kernel = "cubic_spline") {
  GasOptions o{.kernel = kernels::make_kernel(kernel, {}), .equation_of_state = IdealGas{1.4}};
  o.viscosity = effects::MonaghanViscosity{};
  return o;
}

void run(GasFlow &gas, int steps, double cfl = 0.3) {
  for (int s = 0; s < steps; ++s)
    gas.step(cfl * gas.stable_step());
}

// Sums of 200 terms over 100 steps: relative rounding far below 1e-13.
TEST(GasFlow, MassMomentumAndEnergyStayWhateverTheKernelAndTheDensity) {
  for (const auto &description : kernels::kernel_table())
    for (const bool adaptive : {true, false})
      for (const auto rule : {DensityRule::summation, DensityRule::continuity}) {
        GasOptions o = options(std::string(description.name).c_str());
        o.adaptive = adaptive;
        o.density = rule;
        o.fixed_length = 2.0 / 200;
        o.smoothing = 2;
        o.conduction = effects::HeatConduction{};
        GasFlow gas(tube(200, 0.8), o);
        const double energy = gas.total_energy();
        const double momentum = gas.total_momentum();
        run(gas, 20, 0.2);
        EXPECT_NEAR(gas.total_energy() / energy, 1, 1e-13) << description.name;
        EXPECT_NEAR(gas.total_momentum(), momentum, 1e-14 * gas.momentum_scale()) << description.name;
      }
}

TEST(GasFlow, AGasAtRestStaysAtRestBetweenWalls) {
  GasParticles p = tube(100, 1);
  std::fill(p.velocity.begin(), p.velocity.end(), 0.0);
  GasOptions o = options();
  o.ends = {End::mirror, End::mirror};
  o.walls = {0, 1};
  GasFlow gas(p, o);
  run(gas, 50);
  for (const double v : gas.velocity())
    EXPECT_NEAR(v, 0, 1e-12);
  for (const double rho : gas.snapshot().density)
    EXPECT_NEAR(rho, gas.density()[50], 1e-12);
}

TEST(GasFlow, AMovingFrameChangesNothing) {
  GasParticles moving = tube(100);
  for (double &v : moving.velocity)
    v += 16; // a power of two, so that differences are exact to 1e-15 of it
  GasFlow a(tube(100), options());
  GasFlow b(moving, options());
  for (int s = 0; s < 50; ++s) {
    const double dt = 0.3 * a.stable_step();
    a.step(dt);
    b.step(std::min(dt, b.stable_step()));
  }
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_NEAR(a.velocity()[i] + 16, b.velocity()[i], 1e-11) << i;
}

// With h = 1.5 and 2 m / rho on both sides of a jump: the ranges hold every pair that brute force finds.
TEST(GasFlow, SummationDensityIsThatOfAllPairs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  GasParticles p;
  double x = 0;
  for (int i = 0; i < 300; ++i) {
    x += i % 70 < 35 ? 0.01 * (0.5 + unit(random)) : 0.08 * (0.5 + unit(random));
    p.position.push_back(x);
    p.mass.push_back(0.01 * (0.5 + unit(random)));
    p.velocity.push_back(0);
    p.density.push_back(1);
    p.energy.push_back(1);
  }
  for (const auto &description : kernels::kernel_table()) {
    GasFlow gas(p, options(std::string(description.name).c_str()));
    const auto h = gas.smoothing_length();
    const auto density = gas.snapshot().density;
    const auto kernel = kernels::make_kernel(description.name, {});
    std::visit(
        [&](const auto &w) {
          for (std::size_t i = 0; i < 300; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < 300; ++j) {
              const double mean = 0.5 * (h[i] + h[j]);
              const double s = std::abs(p.position[i] - p.position[j]) / mean;
              if (s < w.support())
                sum += p.mass[j] * w.normalisation(1) / mean * w.value(s * s);
            }
            ASSERT_NEAR(density[i] / sum, 1, 1e-12) << description.name << ' ' << i;
          }
        },
        kernel);
  }
}

std::string violation(GasFlow &gas, double time_step) {
  try {
    for (int s = 0; s < 200; ++s)
      gas.step(time_step);
  } catch (const dynamics::Violation &error) {
    return error.what();
  }
  return {};
}

TEST(GasFlow, ATimeStepTenTimesTooLargeIsCaughtAtOnce) {
  GasFlow gas(tube(100), options());
  const std::string reason = violation(gas, 10 * gas.stable_step());
  EXPECT_NE(reason.find("at t = 0 s, particle"), std::string::npos) << reason;
  EXPECT_NE(reason.find("10 times the largest stable one"), std::string::npos) << reason;
}

TEST(GasFlow, ParticlesThatCrossAreCaught) {
  GasParticles p = tube(100);
  p.velocity[50] = 30; // without viscosity nothing stops it
  GasOptions o = options();
  o.viscosity.reset();
  GasFlow gas(p, o);
  const std::string reason = violation(gas, 0.9 * gas.stable_step());
  EXPECT_NE(reason.find("particle"), std::string::npos) << reason;
}

TEST(GasFlow, BadInputIsRefusedByName) {
  const auto refused = [](auto change) {
    GasParticles p = tube(20);
    GasOptions o = options();
    change(p, o);
    try {
      GasFlow gas(p, o);
    } catch (const std::invalid_argument &error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refused([](auto &p, auto &) { p.energy[3] = 0; }).find("particle 4"), std::string::npos);
  EXPECT_NE(refused([](auto &p, auto &) { p.mass[4] = -1; }).find("particle 5"), std::string::npos);
  EXPECT_NE(refused([](auto &p, auto &) { std::swap(p.position[7], p.position[8]); }).find("behind"),
            std::string::npos);
  EXPECT_NE(refused([](auto &p, auto &) { p.velocity.pop_back(); }).find("lengths"), std::string::npos);
  EXPECT_NE(refused([](auto &, auto &o) { o.adaptive = false; }).find("smoothing length"), std::string::npos);
  EXPECT_NE(refused([](auto &, auto &o) {
              o.ends = {End::mirror, End::free}, o.walls = {0.5, 0};
            }).find("left wall"),
            std::string::npos);
}

TEST(GasFlow, ARunThatTakesOverAStateGoesOnWithTheSameBits) {
  for (const auto rule : {DensityRule::summation, DensityRule::continuity}) {
    GasOptions o = options();
    o.density = rule;
    o.adaptive = false;
    o.fixed_length = 0.02;
    o.ends = {End::mirror, End::free};
    GasFlow first(tube(150), o);
    run(first, 37);
    GasFlow second(tube(150), o);
    auto from = first.state();
    auto to = second.state();
    ASSERT_EQ(from.size(), to.size());
    for (std::size_t f = 0; f < from.size(); ++f)
      std::copy(from[f].values.begin(), from[f].values.end(), to[f].values.begin());
    second.adopt_state();
    first.snapshot(); // looking changes nothing
    run(first, 41);
    run(second, 41);
    EXPECT_EQ(first.time(), second.time());
    for (std::size_t i = 0; i < 150; ++i) {
      ASSERT_EQ(first.position()[i], second.position()[i]);
      ASSERT_EQ(first.energy()[i], second.energy()[i]);
    }
  }
}

/// Central differences: the remainder is h^2, and rounding 1e-16 / h; with h = 1e-5 both are below 1e-9.
template <typename Law>
void check_sound_speed(const Law &law, double rho, double e) {
  const double h = 1e-5;
  const double by_density = (law.pressure(rho * (1 + h), e) - law.pressure(rho * (1 - h), e)) / (2 * h * rho);
  const double by_energy = (law.pressure(rho, e * (1 + h)) - law.pressure(rho, e * (1 - h))) / (2 * h * e);
  const double squared = by_density + law.pressure(rho, e) / (rho * rho) * by_energy;
  EXPECT_NEAR(law.sound_speed_squared(rho, e) / squared, 1, 1e-8) << rho << ' ' << e;
}

TEST(EquationOfState, SoundSpeedIsTheDerivativeOfPressure) {
  for (const double rho : {0.1, 1.0, 7.0})
    check_sound_speed(IdealGas{1.4}, rho, 2.5);
  for (const double rho : {200.0, 800.0, 1630.0, 2227.0, 3000.0})
    for (const double e : {1e5, 4.3e6, 8e6})
      check_sound_speed(Jwl{}, rho, e);
}

TEST(EquationOfState, JwlOfThinProductsIsAnIdealGas) {
  // e^(-R / eta) is below 1e-41 at eta = 0.01 for R2: what remains is omega rho e.
  EXPECT_NEAR(Jwl{}.pressure(16.3, 1e6) / (0.3 * 16.3 * 1e6), 1, 1e-12);
}

} // namespace
