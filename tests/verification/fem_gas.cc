// Discontinuous Galerkin for gases and explicit bars, both by deal.II: orders on smooth solutions, sums that stay,
// uneven meshes.

#include "fem_reference/gas/discontinuous_galerkin.h"
#include "fem_reference/rod/explicit_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace fem_reference;

constexpr double speed = 0.5;

/// A wave of density in a gas of constant velocity and pressure: the exact solution moves it. It rises everywhere,
/// because the limiter clips what is largest or smallest.
double wave(double x) { return 1 + 0.2 * std::tanh(20 * (x - 0.45)); }

/// Mean error of the density in the cells' centres at t = 0.2.
double wave_error(int degree, std::size_t n) {
  gas::Tube tube;
  tube.n_cells = n;
  tube.initial = [](std::span<const double> x, std::span<gas::Primitive> states) {
    for (std::size_t i = 0; i < x.size(); ++i)
      states[i] = {wave(x[i]), speed, 1};
  };
  gas::DiscontinuousGalerkin flow(tube, degree);
  constexpr double end = 0.2;
  const auto steps = static_cast<int>(std::ceil(end / (0.5 * flow.stable_step())));
  for (int s = 0; s < steps; ++s)
    flow.step(end / steps);
  std::vector<gas::Primitive> states(n);
  flow.evaluate(flow.centres(), states);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    sum += std::abs(states[i].density - wave(flow.centres()[i] - speed * end));
  return sum / static_cast<double>(n);
}

TEST(FemGas, OrderOneForConstantsAndTwoForLinearFunctions) {
  EXPECT_NEAR(std::log2(wave_error(0, 400) / wave_error(0, 800)), 1, 0.1);
  EXPECT_NEAR(std::log2(wave_error(1, 400) / wave_error(1, 800)), 2, 0.1);
  EXPECT_LT(wave_error(1, 200), 0.05 * wave_error(0, 200));
}

TEST(FemGas, SumsStayBetweenWalls) {
  for (const int degree : {0, 1}) {
    gas::Tube tube;
    tube.n_cells = 101; // the jump lies inside a cell
    tube.boundaries = {gas::Boundary::wall, gas::Boundary::wall};
    tube.initial = [](std::span<const double> x, std::span<gas::Primitive> states) {
      for (std::size_t i = 0; i < x.size(); ++i)
        states[i] = x[i] < 0.5 ? gas::Primitive{1, 0, 1} : gas::Primitive{0.125, 0, 0.1};
    };
    gas::DiscontinuousGalerkin flow(tube, degree);
    const auto before = flow.totals();
    for (int s = 0; s < 500; ++s) // the waves have met both walls
      flow.step(0.4 * flow.stable_step());
    const auto after = flow.totals();
    EXPECT_NEAR(after[0] / before[0], 1, 1e-13) << degree;
    EXPECT_NEAR(after[2] / before[2], 1, 1e-13) << degree;
  }
}

/// Two gases part so fast that almost nothing is left between them: there slopes that minmod lets pass would make a
/// pressure negative at a cell's end. Means alone, and a gas at rest, need nothing.
TEST(FemGas, ShrunkSlopesAreCountedAndKeptWithTheState) {
  const auto shrunk = [](int degree, double part) {
    gas::Tube tube;
    tube.initial = [part](std::span<const double> x, std::span<gas::Primitive> states) {
      for (std::size_t i = 0; i < x.size(); ++i)
        states[i] = {1, x[i] < 0.5 ? -part : part, 0.4};
    };
    gas::DiscontinuousGalerkin flow(tube, degree);
    while (flow.time() < 0.1)
      flow.step(0.3 * flow.stable_step());
    gas::DiscontinuousGalerkin other(tube, degree);
    const auto from = flow.state();
    const auto to = other.state();
    for (std::size_t k = 0; k < from.size(); ++k)
      std::copy(from[k].second.begin(), from[k].second.end(), to[k].second.begin());
    other.adopt_state();
    EXPECT_EQ(other.n_shrunk_slopes(), flow.n_shrunk_slopes());
    return flow.n_shrunk_slopes();
  };
  EXPECT_GT(shrunk(1, 3), 0);
  EXPECT_EQ(shrunk(1, 0), 0);
  EXPECT_EQ(shrunk(0, 3), 0);
}

TEST(FemBar, ElementsOfAnyLengthHaveTheirMassAndStiffness) {
  rod::WaveBar given;
  given.vertices = {1, 1.5, 1.7, 2.7};
  given.youngs_modulus = 3;
  given.density = 2;
  given.right_stress = [](double, double) { return 4.0; };
  rod::ExplicitBar bar(given);
  EXPECT_NEAR(bar.spacing(), 0.2, 1e-15);
  EXPECT_NEAR(bar.stable_step(), 0.2 / std::sqrt(1.5), 1e-15);
  ASSERT_EQ(bar.middles().size(), 3u);
  EXPECT_NEAR(bar.middles()[2], 2.2, 1e-15);
  const double dt = 0.01;
  bar.step(dt); // from rest: the load and half the mass of the last element, rho L / 2 = 1
  EXPECT_NEAR(bar.displacement()[3], dt * dt * 4, 1e-17);
  EXPECT_EQ(bar.displacement()[2], 0);
  EXPECT_NEAR(bar.stress()[2], 3 * dt * dt * 4 / 1.0, 1e-16);
  bar.step(dt); // the element pulls on its left vertex, whose mass is rho (0.2 + 1) / 2
  EXPECT_NEAR(bar.displacement()[2], dt * dt * 3 * dt * dt * 4 / 1.2, 1e-18);
}

TEST(FemBar, BadBarsAreRefused) {
  for (const auto &vertices : {std::vector<double>{0}, std::vector<double>{0, 1, 1}, std::vector<double>{0, NAN}}) {
    rod::WaveBar bar;
    bar.vertices = vertices;
    EXPECT_THROW(rod::ExplicitBar{bar}, std::invalid_argument);
  }
}

} // namespace
