// The exact solutions against the equations that they solve: differences, jump conditions, invariants.

#include "comparisons/benchmarks/bar_wave/exact.h"
#include "comparisons/benchmarks/detonation/theory.h"
#include "comparisons/benchmarks/shock_tube/riemann.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace {

namespace bar = comparisons::benchmarks::bar_wave;
namespace tube = comparisons::benchmarks::shock_tube;
namespace slab = comparisons::benchmarks::detonation;

using Vector = std::array<double, 3>;

Vector conserved(const tube::GasState &s, double gamma) {
  return {s.density, s.density * s.velocity, s.pressure / (gamma - 1) + 0.5 * s.density * s.velocity * s.velocity};
}
Vector flux(const tube::GasState &s, double gamma) {
  const auto u = conserved(s, gamma);
  return {u[1], u[1] * s.velocity + s.pressure, (u[2] + s.pressure) * s.velocity};
}

/// Integral form over a box that holds all waves, -a < x < a, 0 < t < 1: what is in it at the end is what was in it and
/// has come in. Holds shocks, contacts and fans together. Midpoint rule with 4e4 cells: jumps give 5e-5 of their size.
void check_balance(const tube::GasState &left, const tube::GasState &right, double gamma) {
  const tube::RiemannSolution solution(left, right, gamma);
  const double a = 1.1 * std::max({std::abs(left.velocity) + 3 * std::sqrt(gamma * left.pressure / left.density),
                                   std::abs(right.velocity) + 3 * std::sqrt(gamma * right.pressure / right.density),
                                   std::abs(solution.left_wave().head), std::abs(solution.right_wave().head)});
  Vector inside{};
  Vector scale{};
  const int cells = 40000;
  for (int i = 0; i < cells; ++i) {
    const auto u = conserved(solution.at(a * (2 * (i + 0.5) / cells - 1)), gamma);
    for (std::size_t k = 0; k < 3; ++k) {
      inside[k] += 2 * a / cells * u[k];
      scale[k] += 2 * a / cells * std::abs(u[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double before = a * (conserved(left, gamma)[k] + conserved(right, gamma)[k]);
    const double came = flux(left, gamma)[k] - flux(right, gamma)[k];
    EXPECT_NEAR(inside[k], before + came, 2e-4 * (scale[k] + std::abs(came))) << k;
  }
}

TEST(Riemann, ConservesMassMomentumAndEnergy) {
  check_balance({1, 0, 1}, {.25, 0, .1795}, 1.4);
  check_balance({1, 0, 1}, {.125, 0, .1}, 1.4);
  check_balance({1, -2, .4}, {1, 2, .4}, 1.4);        // two rarefactions
  check_balance({1, 1, 1e-6}, {1, -1, 1e-6}, 5. / 3); // two shocks
  check_balance({1, 0, 1000}, {1, 0, .01}, 1.4);
  check_balance({1, 0, .01}, {1, 0, 100}, 1.4);
  check_balance({1, -20, .4}, {1, 20, .4}, 1.4); // leaves a vacuum
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 20; ++i)
    check_balance({unit(random) + .01, 4 * unit(random) - 2, unit(random) + .01},
                  {unit(random) + .01, 4 * unit(random) - 2, unit(random) + .01}, 1.1 + unit(random));
}

TEST(Riemann, StarStateOfThePaper) { // to the printed digits of an independent computation
  const tube::RiemannSolution s({1, 0, 1}, {.25, 0, .1795}, 1.4);
  EXPECT_NEAR(*s.star_pressure(), .429346, 5e-7);
  EXPECT_NEAR(*s.star_velocity(), .673103, 5e-7);
  EXPECT_NEAR(s.left_wave().density, .546663, 5e-7);
  EXPECT_NEAR(s.right_wave().density, .457328, 5e-7);
  EXPECT_NEAR(s.right_wave().head, 1.484743, 5e-7);
  EXPECT_NEAR(.15 * s.left_wave().head, -.17748, 5e-6);
  EXPECT_NEAR(.15 * s.left_wave().tail, -.05632, 5e-6);
}

TEST(Riemann, ShocksSatisfyRankineHugoniot) {
  const tube::RiemannSolution s({1, 0, 1000}, {1, 0, .01}, 1.4);
  const double speed = s.right_wave().head;
  const auto before = s.at(speed * (1 + 1e-12));
  const auto after = s.at(speed * (1 - 1e-12));
  for (std::size_t k = 0; k < 3; ++k) {
    const double jump = speed * (conserved(after, 1.4)[k] - conserved(before, 1.4)[k]);
    EXPECT_NEAR(jump, flux(after, 1.4)[k] - flux(before, 1.4)[k], 1e-11 * std::abs(jump)) << k;
  }
}

TEST(Riemann, FansAreIsentropicAndCarryTheirInvariant) {
  const tube::RiemannSolution s({1, -2, .4}, {1, 2, .4}, 1.4);
  const auto invariant = [](const tube::GasState &q, double sign) {
    return q.velocity + sign * 2 / .4 * std::sqrt(1.4 * q.pressure / q.density);
  };
  for (double part = .05; part < 1; part += .1)
    for (const double sign : {-1., 1.}) {
      const auto &wave = sign < 0 ? s.left_wave() : s.right_wave();
      const double speed = wave.head + part * (wave.tail - wave.head);
      const auto q = s.at(speed);
      EXPECT_NEAR(q.pressure / std::pow(q.density, 1.4), .4, 1e-13);
      EXPECT_NEAR(invariant(q, -sign), invariant({1, 2 * sign, .4}, -sign), 1e-12);
      EXPECT_NEAR(q.velocity + sign * std::sqrt(1.4 * q.pressure / q.density), speed, 1e-12);
    }
}

TEST(Riemann, NohAndVacuum) {
  const tube::RiemannSolution noh({1, 1, 1e-12}, {1, -1, 1e-12}, 5. / 3);
  EXPECT_NEAR(noh.at(0).density, 4, 1e-9);
  EXPECT_NEAR(noh.right_wave().head, 1. / 3, 1e-9);
  const tube::RiemannSolution apart({1, -20, .4}, {1, 20, .4}, 1.4);
  EXPECT_FALSE(apart.star_pressure());
  EXPECT_EQ(apart.at(0).density, 0);
  const tube::RiemannSolution into({1, 0, 1}, {0, 0, 0}, 1.4); // gas runs into a vacuum at 2 c / (gamma - 1)
  EXPECT_NEAR(into.left_wave().tail, 5 * std::sqrt(1.4), 1e-12);
  EXPECT_EQ(into.at(5.93).density, 0);
  EXPECT_GT(into.at(5.9).density, 0);
  const tube::RiemannSolution from({0, 0, 0}, {1, 0, 1}, 1.4);
  for (const double x : {-5.9, -3., 0., 2.})
    EXPECT_NEAR(from.at(x).density, into.at(-x).density, 1e-14);
}

TEST(Riemann, NoGasIsRefused) {
  EXPECT_THROW(tube::RiemannSolution({1, 0, 1}, {1, 0, 1}, 1), std::invalid_argument);
  EXPECT_THROW(tube::RiemannSolution({-1, 0, 1}, {1, 0, 1}, 1.4), std::invalid_argument);
  EXPECT_THROW(tube::RiemannSolution({0, 0, 1}, {1, 0, 1}, 1.4), std::invalid_argument);
  EXPECT_THROW(tube::RiemannSolution({1, NAN, 1}, {1, 0, 1}, 1.4), std::invalid_argument);
}

bar::PulseSolution pulse() {
  return {.length = .1, .wave_speed = 5000, .impedance = 4e7, .stress = 1e9, .duration = 3e-6};
}

TEST(BarPulse, SatisfiesHookeAndNewtonAwayFromFronts) {
  const auto p = pulse(); // piecewise constant: sigma_t = rho c^2 v_x and rho v_t = sigma_x say that jumps fit
  for (const double t : {5e-6, 25e-6, 45e-6, 65e-6})
    for (double x = 0; x < .1; x += .0007) {
      const double jump = p.stress_at(x + 1e-7, t) - p.stress_at(x - 1e-7, t);
      const double speed = p.velocity_at(x + 1e-7, t) - p.velocity_at(x - 1e-7, t);
      EXPECT_NEAR(std::abs(jump), p.impedance * std::abs(speed), 1e-3); // [sigma] = -+ rho c [v]
    }
}

TEST(BarPulse, EndsAreFreeAfterThePulseAndTheReflectionIsTensile) {
  const auto p = pulse();
  for (double t = 3.1e-6; t < 100e-6; t += .37e-6) {
    EXPECT_EQ(p.stress_at(0, t), 0) << t;
    EXPECT_EQ(p.stress_at(p.length, t), 0) << t;
  }
  EXPECT_EQ(p.stress_at(.05, 11e-6), -1e9);
  EXPECT_EQ(p.stress_at(.02, 25e-6), 1e9);
  EXPECT_EQ(p.stress_at(.07, 47.5e-6), -1e9);
}

TEST(BarPulse, EnergyIsTheWork) {
  const auto p = pulse();
  const double density = p.impedance / p.wave_speed;
  const double modulus = p.impedance * p.wave_speed;
  for (const double t : {10e-6, 21e-6, 33e-6}) { // 21: half of it is being reflected
    double sum = 0;
    const int cells = 100000;
    for (int i = 0; i < cells; ++i) {
      const double x = p.length * (i + .5) / cells;
      const double s = p.stress_at(x, t);
      const double v = p.velocity_at(x, t);
      sum += p.length / cells * .5 * (density * v * v + s * s / modulus);
    }
    EXPECT_NEAR(sum / p.work(), 1, 1e-3) << t; // the midpoint rule at four jumps
  }
}

TEST(BarPulse, MeanLoadIsHalfWhereItSwitches) {
  const auto p = pulse();
  EXPECT_DOUBLE_EQ(p.mean_load(-1e-7, 1e-7), -.5e9);
  EXPECT_DOUBLE_EQ(p.mean_load(2.9e-6, 3.1e-6), -.5e9);
  EXPECT_DOUBLE_EQ(p.mean_load(1e-6, 1.1e-6), -1e9);
  EXPECT_EQ(p.mean_load(3.1e-6, 3.2e-6), 0);
}

const slab::Explosive tnt{.products = {}, .density = 1630, .energy = 7e9 / 1630};

TEST(ChapmanJouguet, SatisfiesTheJumpConditionsAndSound) {
  const auto front = slab::chapman_jouguet(tnt);
  const auto &s = front.state;
  EXPECT_NEAR(s.density * (front.speed - s.velocity), tnt.density * front.speed, 1e-8 * tnt.density * front.speed);
  EXPECT_NEAR(s.pressure, tnt.density * front.speed * s.velocity, 1e-8 * s.pressure);
  EXPECT_NEAR(front.energy - tnt.energy, .5 * s.pressure * (1 / tnt.density - 1 / s.density), 1e-8 * front.energy);
  EXPECT_NEAR(tnt.products.pressure(s.density, front.energy), s.pressure, 1e-8 * s.pressure);
  EXPECT_NEAR(std::sqrt(tnt.products.sound_speed_squared(s.density, front.energy)), front.speed - s.velocity,
              1e-6 * front.speed);
  // What follows from the published constants: D = 6930 m/s and p = 2.1e10 Pa to their digits.
  EXPECT_NEAR(front.speed, 6930, 1);
  EXPECT_NEAR(s.pressure, 2.1e10, 5e7);
  EXPECT_NEAR(s.density, 2227, 1);
  EXPECT_NEAR(s.velocity, 1858, 2);
}

// (rho, u) of x / t = z: (u - z) rho' + rho u' = 0 and rho (u - z) u' + p' = 0. The table is linear between entries
// 1e-4 apart in ln rho: derivatives by differences over many entries are good to 1e-4.
TEST(TaylorWave, SatisfiesTheEquationsOfMotion) {
  for (const auto end : {slab::LeftEnd::wall, slab::LeftEnd::free}) {
    const slab::TaylorWave wave(tnt, end);
    const double speed = wave.front().speed;
    for (double part = .55; part < .98; part += .03) {
      const double z = part * speed;
      const double h = .01 * speed;
      const auto a = wave.at(z - h);
      const auto b = wave.at(z);
      const auto c = wave.at(z + h);
      const double rho = (c.density - a.density) / (2 * h);
      const double u = (c.velocity - a.velocity) / (2 * h);
      const double p = (c.pressure - a.pressure) / (2 * h);
      EXPECT_NEAR((b.velocity - z) * rho + b.density * u, 0, 2e-3 * b.density * u) << part;
      EXPECT_NEAR(b.density * (b.velocity - z) * u + p, 0, 2e-3 * p) << part;
    }
  }
}

TEST(TaylorWave, EndsAtThePlateauOrWithoutPressure) {
  const slab::TaylorWave wall(tnt, slab::LeftEnd::wall);
  EXPECT_NEAR(wall.plateau_pressure(), 5.634e9, 6e6); // of an independent computation with D = 6930
  EXPECT_NEAR(wall.plateau_speed() / wall.front().speed, .522, 1e-3);
  EXPECT_EQ(wall.at(100).velocity, 0);
  EXPECT_EQ(wall.at(100).pressure, wall.plateau_pressure());
  const slab::TaylorWave free(tnt, slab::LeftEnd::free);
  EXPECT_LT(free.at(-5000).pressure, 1e8);
  EXPECT_LT(free.at(-5000).velocity, 0);
  EXPECT_EQ(free.at(1.001 * free.front().speed).density, tnt.density);
}

TEST(TaylorWave, MassFromTheWallToTheFrontIsThatOfTheExplosive) {
  const slab::TaylorWave wave(tnt, slab::LeftEnd::wall);
  double mass = 0;
  const int cells = 20000;
  for (int i = 0; i < cells; ++i)
    mass += wave.at(wave.front().speed * (i + .5) / cells).density / cells;
  EXPECT_NEAR(mass / tnt.density, 1, 1e-6);
}

} // namespace
