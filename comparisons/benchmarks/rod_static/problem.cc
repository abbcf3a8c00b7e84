#include "comparisons/benchmarks/rod_static/problem.h"

#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/benchmarks/rod/methods.h"

#include "fem_reference/rod/elastic_rod.h"

#include "meshless/linear_algebra/sparse_lu.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace comparisons::benchmarks::rod_static {

namespace {

using meshless::linear_algebra::SparseRows;
using meshless::linear_algebra::Stopwatch;
using scene::Type;

/// Load and exact solution; x in m.
struct Statement {
  std::function<double(double)> force;        ///< N/m^3
  std::function<double(double)> displacement; ///< m
  std::function<double(double)> strain;
};

/// Solutions of -E u'' = b, u(0) = 0, u'(L) = 0 with s = x / L and c = b0 L^2 / E:
///   b = b0 e^s:        u = c (1 + e s - e^s)
///   b = b0 sin(pi s):  u = c (sin(pi s) / pi^2 + s / pi)
///   b = b0:            u = c (s - s^2 / 2)
Statement make_statement(const std::string &load, double b0, double length, double youngs_modulus) {
  constexpr double pi = std::numbers::pi;
  constexpr double e = std::numbers::e;
  const double l = length;
  const double c = b0 * l * l / youngs_modulus;
  if (load == "sine")
    return {[=](double x) { return b0 * std::sin(pi * x / l); },
            [=](double x) { return c * (std::sin(pi * x / l) / (pi * pi) + x / l / pi); },
            [=](double x) { return c / l * (std::cos(pi * x / l) + 1) / pi; }};
  if (load == "constant")
    return {[=](double) { return b0; }, [=](double x) { return c * (x / l) * (1 - x / l / 2); },
            [=](double x) { return c / l * (1 - x / l); }};
  return {[=](double x) { return b0 * std::exp(x / l); },
          [=](double x) { return c * (1 + e * x / l - std::exp(x / l)); },
          [=](double x) { return c / l * (e - std::exp(x / l)); }};
}

std::vector<double> at(const std::function<double(double)> &function, const std::vector<double> &places) {
  std::vector<double> values;
  values.reserve(places.size());
  for (const double x : places)
    values.push_back(function(x));
  return values;
}

/// What a method gives for one arrangement.
struct Solved {
  std::vector<double> displacement, strain; ///< at the particles or vertices
  std::map<std::string, double> further_errors;
  std::map<std::string, double> quantities;
  std::int64_t n_dofs = 0;
  std::int64_t nonzeros = 0;
};

/// The system of the collocation: entries of row i are -E times those of the second derivative, but for the two ends.
SparseRows assemble(const rod::ParticleOperators &operators, double youngs_modulus) {
  const auto n = operators.second.n_rows();
  SparseRows matrix(n);
  const auto append = [&matrix](const SparseRows &from, std::int64_t row, double factor) {
    const auto begin = static_cast<std::size_t>(from.offsets()[static_cast<std::size_t>(row)]);
    const auto size = static_cast<std::size_t>(from.offsets()[static_cast<std::size_t>(row) + 1]) - begin;
    std::vector<double> values(from.values().begin() + static_cast<std::ptrdiff_t>(begin),
                               from.values().begin() + static_cast<std::ptrdiff_t>(begin + size));
    for (double &value : values)
      value *= factor;
    matrix.append_row(from.columns().subspan(begin, size), values);
  };
  const std::vector<std::int64_t> first_column{0};
  const std::vector<double> one{1};
  matrix.append_row(first_column, one);
  for (std::int64_t i = 1; i + 1 < n; ++i)
    append(operators.second, i, -youngs_modulus);
  append(operators.first, n - 1, 1);
  return matrix;
}

class RodStatic final : public study::Experiment {
public:
  RodStatic(const scene::Scene &scene, const scene::ProblemVariant &variant)
      : problem_(variant.parameters), seed_(scene.study.integer("seed")), youngs_modulus_(scene.material.real("E")),
        statement_(
            make_statement(problem_.text("load"), problem_.real("force"), problem_.real("length"), youngs_modulus_)) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &series_directory, reports::Cell &cell) const override {
    rod::Measurement measurement;
    bool first_arrangement = true;
    for (const auto &arrangement : rod::arrangements(problem_, level, seed_)) {
      Stopwatch watch;
      const std::vector<double> places = arrangement.places();
      measurement.seconds["points"] += watch.lap();
      const Solved solved = request.name == "fem" ? by_elements(request.parameters, places, measurement.seconds)
                                                  : by_particles(request.parameters, places, measurement);
      watch.lap();
      if (with_errors)
        measurement.add(errors(places, solved));
      if (first_arrangement) {
        cell.n_points = arrangement.n;
        cell.n_dofs = solved.n_dofs;
        cell.nonzeros = solved.nonzeros;
        if (with_errors)
          cell.quantities = solved.quantities;
        if (with_errors && !series_directory.empty())
          rod::write_series(series_directory, "displacement", {"x", "u", "exact_u", "strain", "exact_strain"},
                            {places, solved.displacement, at(statement_.displacement, places), solved.strain,
                             at(statement_.strain, places)},
                            cell);
      }
      first_arrangement = false;
      measurement.seconds["evaluation"] += watch.lap();
    }
    measurement.write(cell);
  }

  study::Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const override {
    const auto all = rod::arrangements(problem_, level, seed_);
    return rod::estimate(request, all.front().n, all.size());
  }

private:
  Solved by_particles(const scene::Parameters &method, const std::vector<double> &places,
                      rod::Measurement &measurement) const {
    auto &seconds = measurement.seconds;
    const auto operators = rod::particle_operators(method, places, measurement);
    Stopwatch watch;
    SparseRows matrix = assemble(operators, youngs_modulus_);
    std::vector<double> load = at(statement_.force, places);
    load.front() = 0; // u(0) = 0
    load.back() = 0;  // u'(L) = 0
    const std::vector<double> scales = matrix.equilibrate_rows();
    for (std::size_t i = 0; i < load.size(); ++i)
      load[i] /= scales[i];
    seconds["assembly"] += watch.lap();
    auto solution = meshless::linear_algebra::solve_lu(matrix, load);
    seconds["solve"] += watch.lap();
    Solved solved;
    solved.displacement = std::move(solution.solution);
    solved.strain.resize(places.size());
    operators.first.multiply(solved.displacement, solved.strain);
    solved.quantities = {{"reciprocal_condition", solution.reciprocal_condition},
                         {"backward_error", backward_error(matrix, solved.displacement, load)}};
    solved.n_dofs = matrix.n_rows();
    solved.nonzeros = matrix.nonzeros();
    seconds["recovery"] += watch.lap();
    return solved;
  }

  Solved by_elements(const scene::Parameters &method, const std::vector<double> &places,
                     std::map<std::string, double> &seconds) const {
    fem_reference::rod::Rod rod;
    rod.vertices = places;
    rod.youngs_modulus = youngs_modulus_;
    rod.ends[1].kind = fem_reference::rod::EndKind::traction;
    rod.body_force = [this](std::span<const double> x, std::span<double> values) {
      for (std::size_t i = 0; i < x.size(); ++i)
        values[i] = statement_.force(x[i]);
    };
    const auto solution = fem_reference::rod::solve(rod, {.degree = rod::degree_of(method)});
    const auto &phases = solution.seconds();
    seconds["points"] += phases.mesh;
    seconds["neighbours"] += phases.degrees_of_freedom;
    seconds["assembly"] += phases.assembly;
    seconds["solve"] += phases.solve;
    Solved solved;
    solved.displacement.resize(places.size());
    solved.strain.resize(places.size());
    solution.displacement(places, solved.displacement);
    solution.strain(places, solved.strain);
    solved.quantities = {{"backward_error", solution.backward_error()}};
    solved.n_dofs = static_cast<std::int64_t>(solution.n_dofs());
    solved.nonzeros = static_cast<std::int64_t>(solution.nonzeros());
    std::vector<double> between;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      for (int i = 0; i < 10; ++i)
        between.push_back(places[k] + (places[k + 1] - places[k]) * (i + 0.5) / 10);
    std::vector<double> values(between.size());
    solution.displacement(between, values);
    solved.further_errors["displacement_max_between"] =
        rod::largest_difference(values, at(statement_.displacement, between));
    return solved;
  }

  std::map<std::string, double> errors(const std::vector<double> &places, const Solved &solved) const {
    auto result = solved.further_errors;
    result["displacement_max"] = rod::largest_difference(solved.displacement, at(statement_.displacement, places));
    result["strain_max"] = rod::largest_difference(solved.strain, at(statement_.strain, places));
    return result;
  }

  const scene::Parameters problem_;
  std::int64_t seed_;
  double youngs_modulus_;
  Statement statement_;
};

scene::BenchmarkDescription description() {
  scene::BenchmarkDescription benchmark;
  benchmark.name = "rod_static";
  benchmark.meaning = "rod fixed at one end under an axial load, Asprone et al. 2010, section 5.2";
  benchmark.problem = rod::arrangement_keys(true);
  benchmark.problem.push_back({.name = "load",
                               .type = Type::choice,
                               .choices = {"exponential", "sine", "constant"},
                               .default_value = "exponential",
                               .meaning = "load along s = x / length: e^s (the paper's), sin(pi s), 1"});
  benchmark.problem.push_back({.name = "force",
                               .dimension = {.mass = 1, .length = -2, .time = -2},
                               .default_value = 1.0,
                               .meaning = "force per volume that multiplies the load, N/m^3"});
  benchmark.material = {{.name = "E",
                         .dimension = scene::dimensions::pressure,
                         .range = {.lower = 0, .lower_open = true},
                         .default_value = 1.0,
                         .meaning = "Young's modulus"}};
  benchmark.effects = {"elasticity", "body_force"};
  benchmark.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    rod::check_arrangement(context, rod::least_particles, 100000, diagnostics);
  };
  benchmark.methods = {rod::collocation(benchmark.effects), rod::finite_elements({}, benchmark.effects)};
  benchmark.counts_per_level = 1;
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &scene, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<RodStatic>(scene, variant);
          },
          rod::add_slopes};
}

} // namespace comparisons::benchmarks::rod_static
