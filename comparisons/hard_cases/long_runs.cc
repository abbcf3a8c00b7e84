#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/scene_case.h"

#include "meshless/basis/derivative_operators.h"
#include "meshless/basis/ssph.h"
#include "meshless/dynamics/elastic_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace comparisons::hard_cases {

namespace {

constexpr int n_points = 100;
constexpr double cfl = .8;
constexpr int n_snapshots = 200;
constexpr int n_steps = 1000000;
/// The benchmark's pulse of 3 us on .1 m of steel, in units of D / c.
constexpr double pulse_duration = 3e-6 * 5042.7 / (.1 / (n_points - 1));

/// By how much the energy of central differences may oscillate, over its mean. A mode w has u(n) = A cos(n phi),
/// v(n - 1/2) = -A w sin((n - 1/2) phi), sin(phi / 2) = w dt / 2; kinetic and strain energy, half a step apart, are
///   A^2 w^2 / 2 (1 - w dt / 2 sin((2 n - 1/2) phi)),
/// so that no more than sum e w dt / 2 over sum e comes of all modes. The modes are those of linear elements with
/// lumped mass; the pulse gives them the energies e = (sin(w T / 2) / w)^2, the first and last half of it.
double energy_oscillation() {
  double oscillation = 0;
  double sum = 0;
  for (int k = 0; k < n_points; ++k) {
    const double w = 2 * std::sin(k * std::numbers::pi / (2 * (n_points - 1))); // c / D
    const double speed = k == 0 ? .5 * pulse_duration : std::sin(.5 * w * pulse_duration) / w;
    const double energy = (k == 0 || k == n_points - 1 ? .5 : 1) * speed * speed;
    sum += energy;
    oscillation += energy * .5 * w * cfl;
  }
  return oscillation / sum;
}

/// Energy over work at all snapshots.
std::vector<double> energies_of(const reports::Cell &cell) {
  std::vector<double> energies;
  for (int i = 1; i < n_snapshots; ++i)
    energies.push_back(value_of(cell.quantities, fmt::format("energy_over_work_snapshot_{}", i)));
  energies.push_back(value_of(cell.quantities, "energy_over_work"));
  return energies;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double largest_deviation(const reports::Cell &cell) {
  const auto energies = energies_of(cell);
  const double middle = mean(energies);
  double largest = 0;
  for (const double energy : energies)
    largest = std::max(largest, std::abs(energy / middle - 1));
  return cell.steps < n_steps ? std::nan("") : largest;
}

double drift(const reports::Cell &cell) {
  const auto energies = energies_of(cell);
  const std::span<const double> all(energies);
  return cell.steps < n_steps ? std::nan("")
                              : std::abs(mean(all.last(n_snapshots / 2)) / mean(all.first(n_snapshots / 2)) - 1);
}

/// The bar without the look at its eigenvalues that a scene takes first: unit spacing, wave speed and pressure.
double energy_of_growing_bar(double smoothing_length) {
  meshless::dynamics::BarOptions options;
  for (int i = 0; i < n_points; ++i)
    options.positions.push_back(i);
  options.operators = [=](std::span<const double> places) {
    std::vector<meshless::cloud::Point<1>> points;
    for (const double x : places)
      points.push_back({x});
    const meshless::cloud::Particles<1> particles(points, std::vector<double>(points.size(), smoothing_length));
    const auto basis = meshless::basis::make_ssph<1>(2, meshless::kernels::make_kernel("cubic_spline", {}, {}));
    auto rows = meshless::basis::make_derivative_operators<1>(*basis, particles, {.gradient = true, .hessian = true});
    return meshless::dynamics::LineOperators{std::move(rows.gradient.front()), std::move(rows.hessian.front())};
  };
  options.right_stress = [](double t) { return t < pulse_duration ? -1.0 : 0.0; };
  meshless::dynamics::ElasticBar bar(options);
  for (int step = 0; step < n_steps; ++step)
    bar.step(cfl);
  return std::abs(bar.energy() / bar.work() - 1);
}

} // namespace

std::vector<HardCase> long_run_cases(const study::Catalogue &catalogue) {
  std::vector<HardCase> cases;
  cases.push_back(
      {"long runs",
       "plate, complex eigenvalues",
       "a step load on a plate of 21 x 5 points for ten periods, mean acceleration; error of the energy",
       "the energy is the work; an operator whose motions grow ends the run by name",
       .05,
       "5 %: mean acceleration conserves the energy of a symmetric operator to rounding",
       {"weak1", "weak2", "fem Q2"},
       true,
       [&catalogue](const std::string &m) {
         return measure_scene(
             catalogue,
             plate_scene(m, "supports = \"left\"\nlength = \"1 m\"\nwidth = \"0.2 m\"",
                         "[time]\nend = \"20 ms\"\ncfl = 4.0\n[study]\nanalysis = \"transient\"\nlevels = [\"21x5\"]"),
             [](const reports::Cell &cell) { return std::abs(value_of(cell.errors, "energy_relative")); });
       }});
  cases.push_back({"long runs",
                   "bar, complex eigenvalues",
                   "the pulse in a bar with the cubic spline at h = 2 D, whose operator has complex eigenvalues",
                   "an end by name before the first step",
                   .1,
                   "nothing may come out",
                   {"ssph"},
                   true,
                   [&catalogue](const std::string &m) {
                     return measure_scene(
                         catalogue, bar_scene(m, "kernel = \"cubic_spline\"\nsmoothing_length = 2.0", "", "", 200),
                         [](const reports::Cell &cell) { return value_of(cell.errors, "stress_l1"); });
                   }});
  for (const double h : {1.88, 1.9, 2.})
    cases.push_back({"long runs",
                     fmt::format("bar, growth on its way, h = {:g} D", h),
                     "a pulse in 100 points with the cubic spline, up to a million steps, without looking at the "
                     "eigenvalues beforehand; energy over work less 1",
                     "an end by name: the energy grows like e^(2 g t), g from 2e-4 to 2e-3 c / D by the eigenvalues",
                     .1,
                     "nothing may come out",
                     {"ssph"},
                     true,
                     [h](const std::string &) {
                       return with_named_ends([h] { return Measurement{.error = energy_of_growing_bar(h)}; });
                     }});
  const std::string time = fmt::format("end = \"0.1603 s\"\ncfl = {}\nsnapshots = {}", cfl, n_snapshots);
  const std::string meaning = "a pulse to and fro in 100 points, a million steps; ";
  const double oscillation = energy_oscillation();
  cases.push_back(
      {"long runs",
       "bar, 1e6 steps, bounds of the energy",
       meaning + "the largest of 200 deviations of the energy from its mean",
       "central differences conserve a modified energy; kinetic and strain energy, half a step apart, "
       "oscillate around it by w dt / 2 in a mode w",
       oscillation,
       fmt::format("{:.1f} %: w dt / 2 over the modes of linear elements, weighted with the energy that the "
                   "pulse gives them",
                   100 * oscillation),
       {"ssph", "fem"},
       true,
       [&catalogue, time](const std::string &m) {
         return measure_scene(catalogue, bar_scene(m, "", "", time, n_points), largest_deviation);
       }});
  cases.push_back({"long runs",
                   "bar, 1e6 steps, drift of the energy",
                   meaning + "mean energy of its second half over that of its first, less 1",
                   "none: a growth of 1.2e-8 c / D would make 1 %, a hundredth of what is refused beforehand",
                   .01,
                   "1 %: seven times what is left of the oscillation in means of 100 values",
                   {"ssph", "fem"},
                   true,
                   [&catalogue, time](const std::string &m) {
                     return measure_scene(catalogue, bar_scene(m, "", "", time, n_points), drift);
                   }});
  return cases;
}

} // namespace comparisons::hard_cases
