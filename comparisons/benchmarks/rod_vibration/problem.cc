#include "comparisons/benchmarks/rod_vibration/problem.h"

#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/benchmarks/rod/methods.h"

#include "fem_reference/rod/elastic_rod.h"

#include "meshless/linear_algebra/eigenvalues.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace comparisons::benchmarks::rod_vibration {

namespace {

using meshless::linear_algebra::Stopwatch;

/// The dense eigenproblem works like N^3: 1500 particles take half a minute.
constexpr int most_particles = 1500;

/// Imaginary parts below this part of the largest eigenvalue are rounding: eps times the condition of an eigenvalue, up
/// to 1e4 here.
constexpr double imaginary_rounding = 1e-11;

/// Squares of the frequencies by real part, 1/s^2.
struct Spectrum {
  std::vector<std::complex<double>> squares;
  std::int64_t n_dofs = 0;
  std::int64_t nonzeros = 0;
};

/// -factor D2 of the interior particles, row by row.
std::vector<double> interior(const meshless::linear_algebra::SparseRows &second, double factor) {
  const auto n = second.n_rows() - 2;
  std::vector<double> dense(static_cast<std::size_t>(n * n));
  for (std::int64_t i = 0; i < n; ++i)
    for (auto k = second.offsets()[static_cast<std::size_t>(i + 1)];
         k < second.offsets()[static_cast<std::size_t>(i + 2)]; ++k) {
      const auto j = second.columns()[static_cast<std::size_t>(k)] - 1;
      if (j >= 0 && j < n)
        dense[static_cast<std::size_t>(i * n + j)] = -factor * second.values()[static_cast<std::size_t>(k)];
    }
  return dense;
}

class RodVibration final : public study::Experiment {
public:
  RodVibration(const scene::Scene &scene, const scene::ProblemVariant &variant)
      : problem_(variant.parameters), seed_(scene.study.integer("seed")), youngs_modulus_(scene.material.real("E")),
        density_(scene.material.real("density")) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &series_directory, reports::Cell &cell) const override {
    rod::Measurement measurement;
    Stopwatch watch;
    const auto arrangement = rod::arrangements(problem_, level, seed_).front();
    const std::vector<double> places = arrangement.places();
    measurement.seconds["points"] += watch.lap();
    const Spectrum spectrum = request.name == "fem" ? by_elements(request.parameters, places, measurement.seconds)
                                                    : by_particles(request.parameters, places, measurement);
    cell.dimension = 1;
    cell.n_points = arrangement.n;
    cell.n_dofs = spectrum.n_dofs;
    cell.nonzeros = spectrum.nonzeros;
    watch.lap();
    if (with_errors) {
      const std::vector<double> ratios = frequency_ratios(spectrum);
      measurement.add(errors(ratios));
      fill_quantities(spectrum, ratios, cell);
      if (!series_directory.empty())
        write_spectrum(spectrum, ratios, series_directory, cell);
    }
    measurement.seconds["evaluation"] += watch.lap();
    measurement.write(cell);
  }

  study::Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const override {
    const auto n = rod::arrangements(problem_, level, seed_).front().n;
    study::Estimate e = rod::estimate(request, n, 1);
    e.bytes += 16 * e.n_dofs * e.n_dofs;
    e.seconds += 1e-8 * std::pow(e.n_dofs, 3);
    return e;
  }

private:
  double exact_frequency(std::size_t mode) const {
    return static_cast<double>(mode) * std::numbers::pi * std::sqrt(youngs_modulus_ / density_) /
           problem_.real("length");
  }

  Spectrum by_particles(const scene::Parameters &method, const std::vector<double> &places,
                        rod::Measurement &measurement) const {
    auto &seconds = measurement.seconds;
    const auto operators = rod::particle_operators(method, places, measurement);
    Stopwatch watch;
    const auto matrix = interior(operators.second, youngs_modulus_ / density_);
    seconds["assembly"] += watch.lap();
    Spectrum spectrum{meshless::linear_algebra::eigenvalues(matrix, places.size() - 2),
                      static_cast<std::int64_t>(places.size()), operators.second.nonzeros()};
    seconds["solve"] += watch.lap();
    return spectrum;
  }

  Spectrum by_elements(const scene::Parameters &method, const std::vector<double> &places,
                       std::map<std::string, double> &seconds) const {
    using fem_reference::rod::Mass;
    fem_reference::rod::Rod rod;
    rod.vertices = places;
    rod.youngs_modulus = youngs_modulus_;
    rod.density = density_;
    const auto frequencies = fem_reference::rod::natural_frequencies(
        rod, {rod::degree_of(method), method.text("mass") == "lumped" ? Mass::lumped : Mass::consistent});
    seconds["points"] += frequencies.seconds.mesh;
    seconds["neighbours"] += frequencies.seconds.degrees_of_freedom;
    seconds["assembly"] += frequencies.seconds.assembly;
    seconds["solve"] += frequencies.seconds.solve;
    Spectrum spectrum;
    for (const double omega : frequencies.omega)
      spectrum.squares.emplace_back(omega * omega, 0);
    spectrum.n_dofs = static_cast<std::int64_t>(frequencies.n_dofs);
    spectrum.nonzeros = static_cast<std::int64_t>(frequencies.nonzeros);
    return spectrum;
  }

  /// sqrt(Re) over the exact frequency, mode 1 first; 0 where Re is not positive.
  std::vector<double> frequency_ratios(const Spectrum &spectrum) const {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < spectrum.squares.size(); ++k)
      ratios.push_back(std::sqrt(std::max(0., spectrum.squares[k].real())) / exact_frequency(k + 1));
    return ratios;
  }

  static std::map<std::string, double> errors(const std::vector<double> &ratios) {
    std::map<std::string, double> result{{"frequency_1_relative", std::abs(ratios[0] - 1)}};
    if (ratios.size() >= 10)
      result["frequency_10_relative"] = std::abs(ratios[9] - 1);
    double worst = 0;
    for (const double ratio : ratios)
      worst = std::max(worst, std::abs(ratio - 1));
    result["frequency_max_relative"] = worst;
    return result;
  }

  static void fill_quantities(const Spectrum &spectrum, const std::vector<double> &ratios, reports::Cell &cell) {
    for (const std::size_t mode : {1UL, 2UL, 10UL, 50UL, 98UL})
      if (mode <= ratios.size())
        cell.quantities[fmt::format("ratio_{}", mode)] = ratios[mode - 1];
    double largest = 0;
    for (const auto &square : spectrum.squares)
      largest = std::max(largest, std::abs(square));
    int n_complex = 0;
    int n_negative = 0;
    for (const auto &square : spectrum.squares) {
      n_complex += std::abs(square.imag()) > imaginary_rounding * largest;
      n_negative += !(square.real() > 0);
    }
    cell.quantities["n_modes"] = static_cast<double>(ratios.size());
    cell.quantities["imaginary_part"] = meshless::linear_algebra::largest_imaginary_part(spectrum.squares) / largest;
    cell.quantities["n_complex"] = n_complex;
    cell.quantities["n_negative"] = n_negative;
    if (n_complex > 0)
      cell.warnings.push_back(fmt::format("{} of {} eigenvalues are complex; frequencies are those of their real parts",
                                          n_complex, ratios.size()));
    if (n_negative > 0)
      cell.warnings.push_back(
          fmt::format("{} eigenvalues have a real part that is not positive: these modes grow", n_negative));
  }

  void write_spectrum(const Spectrum &spectrum, const std::vector<double> &ratios,
                      const std::filesystem::path &directory, reports::Cell &cell) const {
    std::vector<std::vector<double>> columns(6);
    for (std::size_t k = 0; k < ratios.size(); ++k) {
      const double exact = exact_frequency(k + 1);
      const double row[] = {static_cast<double>(k + 1),
                            static_cast<double>(k + 1) / static_cast<double>(ratios.size()),
                            ratios[k] * exact,
                            exact,
                            ratios[k],
                            spectrum.squares[k].imag()};
      for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c].push_back(row[c]);
    }
    rod::write_series(directory, "spectrum",
                      {"mode", "mode_over_n_modes", "omega", "exact_omega", "ratio", "imaginary_part_of_square"},
                      columns, cell);
  }

  const scene::Parameters problem_;
  std::int64_t seed_;
  double youngs_modulus_;
  double density_;
};

scene::BenchmarkDescription description() {
  scene::BenchmarkDescription benchmark;
  benchmark.name = "rod_vibration";
  benchmark.meaning = "natural frequencies of a rod with fixed ends, Asprone et al. 2010, section 5.3";
  benchmark.problem = rod::arrangement_keys(false);
  benchmark.material = {{.name = "E",
                         .dimension = scene::dimensions::pressure,
                         .range = {.lower = 0, .lower_open = true},
                         .default_value = 1.0,
                         .meaning = "Young's modulus"},
                        {.name = "density",
                         .dimension = scene::dimensions::density,
                         .range = {.lower = 0, .lower_open = true},
                         .default_value = 1.0,
                         .meaning = "mass per volume"}};
  benchmark.effects = {"elasticity", "inertia"};
  benchmark.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    rod::check_arrangement(context, rod::least_particles, most_particles, diagnostics);
  };
  benchmark.methods = {rod::collocation(benchmark.effects), rod::finite_elements({.mass = true}, benchmark.effects)};
  benchmark.counts_per_level = 1;
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &scene, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<RodVibration>(scene, variant);
          },
          rod::add_slopes};
}

} // namespace comparisons::benchmarks::rod_vibration
