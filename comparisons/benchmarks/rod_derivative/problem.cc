#include "comparisons/benchmarks/rod_derivative/problem.h"

#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/benchmarks/rod/methods.h"

#include "fem_reference/rod/elastic_rod.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace comparisons::benchmarks::rod_derivative {

namespace {

using scene::Type;

/// A function of x / length with its first two derivatives with respect to x.
struct Function {
  std::function<double(double)> value, first, second;
};

Function make_function(const std::string &name, double length) {
  constexpr double pi = std::numbers::pi;
  const double l = length;
  if (name == "sine")
    return {[l](double x) { return std::sin(pi * x / l); }, [l](double x) { return pi / l * std::cos(pi * x / l); },
            [l](double x) { return -pi * pi / (l * l) * std::sin(pi * x / l); }};
  if (name == "exponential")
    return {[l](double x) { return std::exp(x / l); }, [l](double x) { return std::exp(x / l) / l; },
            [l](double x) { return std::exp(x / l) / (l * l); }};
  const int p = name == "constant" ? 0 : name == "linear" ? 1 : name == "quadratic" ? 2 : 3;
  return {[=](double x) { return std::pow(x / l, p); },
          [=](double x) { return p < 1 ? 0 : p * std::pow(x / l, p - 1) / l; },
          [=](double x) { return p < 2 ? 0 : p * (p - 1) * std::pow(x / l, p - 2) / (l * l); }};
}

std::vector<double> at(const std::function<double(double)> &function, const std::vector<double> &places) {
  std::vector<double> values;
  values.reserve(places.size());
  for (const double x : places)
    values.push_back(function(x));
  return values;
}

/// Derivatives at the particles; at a vertex between two elements the one farther from `second`.
struct Derivatives {
  std::vector<double> first, second;
  std::int64_t n_dofs = 0;
  std::int64_t nonzeros = 0;
};

class RodDerivative final : public study::Experiment {
public:
  RodDerivative(const scene::Scene &scene, const scene::ProblemVariant &variant)
      : problem_(variant.parameters), seed_(scene.study.integer("seed")),
        function_(make_function(problem_.text("function"), problem_.real("length"))) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &series_directory, reports::Cell &cell) const override {
    rod::Measurement measurement;
    bool first_arrangement = true;
    for (const auto &arrangement : rod::arrangements(problem_, level, seed_)) {
      meshless::linear_algebra::Stopwatch watch;
      const std::vector<double> places = arrangement.places();
      measurement.seconds["points"] += watch.lap();
      const Derivatives computed = request.name == "fem" ? by_elements(request.parameters, places, measurement.seconds)
                                                         : by_particles(request.parameters, places, measurement);
      watch.lap();
      if (with_errors)
        measurement.add(errors(places, computed));
      if (first_arrangement) {
        cell.n_points = arrangement.n;
        cell.n_dofs = computed.n_dofs;
        cell.nonzeros = computed.nonzeros;
        if (with_errors && !series_directory.empty())
          rod::write_series(series_directory, "second_derivative", {"x", "second_derivative", "exact"},
                            {places, computed.second, at(function_.second, places)}, cell);
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
  Derivatives by_particles(const scene::Parameters &method, const std::vector<double> &places,
                           rod::Measurement &measurement) const {
    auto &seconds = measurement.seconds;
    const auto operators = rod::particle_operators(method, places, measurement);
    meshless::linear_algebra::Stopwatch watch;
    const std::vector<double> values = at(function_.value, places);
    Derivatives result{std::vector<double>(places.size()), std::vector<double>(places.size()),
                       static_cast<std::int64_t>(places.size()), operators.second.nonzeros()};
    operators.first.multiply(values, result.first);
    operators.second.multiply(values, result.second);
    seconds["recovery"] += watch.lap();
    return result;
  }

  /// Derivatives of the interpolant with elements of the same vertices.
  Derivatives by_elements(const scene::Parameters &method, const std::vector<double> &places,
                          std::map<std::string, double> &seconds) const {
    const int degree = rod::degree_of(method);
    if (degree < 2)
      throw methods::Refused("linear elements have no second derivative; use element = \"Q2\" or \"Q3\"");
    meshless::linear_algebra::Stopwatch watch;
    const auto interpolant = fem_reference::rod::interpolate(
        places,
        [this](std::span<const double> x, std::span<double> values) {
          for (std::size_t i = 0; i < x.size(); ++i)
            values[i] = function_.value(x[i]);
        },
        rod::degree_of(method));
    seconds["assembly"] += watch.lap();
    Derivatives result{std::vector<double>(places.size()), std::vector<double>(places.size()),
                       static_cast<std::int64_t>(interpolant.n_dofs()), 0};
    interpolant.strain(places, result.first);
    const auto ends = interpolant.second_derivatives_at_cell_ends();
    const std::size_t last = places.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      const double exact = function_.second(places[i]);
      const double left = ends[i == 0 ? 0 : 2 * i - 1];
      const double right = ends[i == last ? 2 * i - 1 : 2 * i];
      result.second[i] = std::abs(left - exact) > std::abs(right - exact) ? left : right;
    }
    seconds["recovery"] += watch.lap();
    return result;
  }

  std::map<std::string, double> errors(const std::vector<double> &places, const Derivatives &computed) const {
    std::map<std::string, double> result{{"first_derivative_max", 0},
                                         {"first_derivative_max_inside", 0},
                                         {"second_derivative_max", 0},
                                         {"second_derivative_max_inside", 0}};
    const auto keep = [&](const std::string &name, double error, bool inside) {
      for (auto *largest : {&result[name], inside ? &result[name + "_inside"] : nullptr})
        if (largest != nullptr && !(error <= *largest)) // keeps what is not a number
          *largest = error;
    };
    const double length = problem_.real("length");
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool inside = std::abs(places[i] / length - 0.5) <= 0.25;
      keep("first_derivative_max", std::abs(computed.first[i] - function_.first(places[i])), inside);
      keep("second_derivative_max", std::abs(computed.second[i] - function_.second(places[i])), inside);
    }
    return result;
  }

  const scene::Parameters problem_;
  std::int64_t seed_;
  Function function_;
};

scene::BenchmarkDescription description() {
  scene::BenchmarkDescription benchmark;
  benchmark.name = "rod_derivative";
  benchmark.meaning = "second derivative of a function from its values at particles, Asprone et al. 2010, section 5.1";
  benchmark.problem = rod::arrangement_keys(true);
  benchmark.problem.push_back({.name = "function",
                               .type = Type::choice,
                               .choices = {"exponential", "sine", "constant", "linear", "quadratic", "cubic"},
                               .default_value = "exponential",
                               .meaning = "f of x / length: e^x (the paper's), sin(pi x), 1, x, x^2, x^3"});
  benchmark.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
    rod::check_arrangement(context, rod::least_particles, 100000, diagnostics);
  };
  benchmark.methods = {rod::collocation({}), rod::finite_elements({.lowest_degree = 2}, {})};
  benchmark.counts_per_level = 1;
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &scene, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<RodDerivative>(scene, variant);
          },
          rod::add_slopes};
}

} // namespace comparisons::benchmarks::rod_derivative
