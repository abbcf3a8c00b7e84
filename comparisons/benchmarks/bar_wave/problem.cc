#include "comparisons/benchmarks/bar_wave/problem.h"

#include "comparisons/benchmarks/bar_wave/evolutions.h"
#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/methods/method_table.h"
#include "comparisons/metrics/memory.h"
#include "comparisons/scene/time_keys.h"

#include "meshless/dynamics/stretched_bar.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::benchmarks::bar_wave {

namespace {

using meshless::linear_algebra::Stopwatch;
using scene::Type;

constexpr int least_particles = 20;
constexpr int most_particles = 1000000;

int count_of(const scene::Level &level, double length) {
  return level.spacing ? static_cast<int>(std::lround(length / *level.spacing)) + 1 : level.counts.front();
}

/// The stretched bar as an evolution; its only result is how much the disturbance has grown.
class StretchedEvolution final : public study::Evolution {
public:
  explicit StretchedEvolution(const meshless::dynamics::StretchedBarOptions &options)
      : unit_(options.spacing * std::sqrt(options.density / options.youngs_modulus)), bar_(options) {}

  double time() const override { return bar_.time(); }
  std::int64_t steps() const override { return bar_.steps(); }
  /// The gradient's largest eigenvalue is below 1.3 / D for all kernels of the papers; both rates together 1.3 c / D.
  double stable_step() const override { return unit_; }
  double step_unit() const override { return unit_; }
  bool constant_step() const override { return true; }
  void step(double dt) override {
    bar_.step(dt);
    largest_ = std::max(largest_, bar_.growth());
  }
  double energy_error() const override { return 0; }
  meshless::dynamics::State state() override { return bar_.state(); }
  void adopt_state() override { bar_.adopt_state(); }
  double largest_growth() const { return largest_; }

private:
  double unit_;
  meshless::dynamics::StretchedBar bar_;
  double largest_ = 1;
};

class BarWave final : public study::Experiment {
public:
  BarWave(const scene::Scene &scene, const scene::ProblemVariant &variant)
      : scene_(scene), variant_(variant), problem_(variant.parameters), time_(scene.time), effects_(scene) {
    const double modulus = scene.material.real("E");
    const double density = scene.material.real("density");
    pulse_.length = problem_.real("length");
    pulse_.wave_speed = std::sqrt(modulus / density);
    pulse_.impedance = std::sqrt(modulus * density);
    pulse_.stress = problem_.real("stress");
    pulse_.duration = problem_.real("duration");
  }

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &directory, reports::Cell &cell) const override {
    const metrics::PeakMemory memory;
    const int n = count_of(level, pulse_.length);
    study::TimeServices services;
    services.progress = progress();
    services.identity = study::identity_of(scene_, variant_, request, level);
    if (!directory.empty())
      services.checkpoint = directory / study::checkpoint_file(cell);
    cell.dimension = 1;
    cell.n_points = n;
    if (problem_.text("case") == "stretched")
      run_stretched(request, n, services, cell);
    else
      run_pulse(request, n, with_errors, directory, services, cell);
    cell.memory_bytes = memory.bytes();
  }

  study::Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const override {
    const double n = count_of(level, pulse_.length);
    const double steps = time_.end * pulse_.wave_speed / pulse_.length * n / time_.cfl;
    const bool anew = request.parameters.has("positions") && request.parameters.text("positions") == "current";
    return {.n_points = n, .n_dofs = n, .bytes = 500 * n, .seconds = steps * n * (anew ? 3e-6 : 3e-9) + 0.05};
  }

private:
  static void keep_seconds(const std::map<std::string, double> &seconds, reports::Cell &cell) {
    double total = 0;
    for (const auto &[phase, value] : seconds) {
      cell.seconds[phase] = {value, value, value};
      total += value;
    }
    cell.seconds["total"] = {total, total, total};
  }

  void run_pulse(const scene::MethodRequest &request, int n, bool with_errors, const std::filesystem::path &directory,
                 study::TimeServices &services, reports::Cell &cell) const {
    Stopwatch watch;
    if (request.name == "sph")
      throw methods::Refused("sph is here for the stretched bar alone; write case = \"stretched\" or name ssph");
    const auto bar =
        request.name == "fem" ? fem_bar(pulse_, n, effects_) : ssph_bar(request.parameters, pulse_, n, effects_);
    const double preparation = watch.lap();
    std::map<std::string, double> errors;
    if (with_errors)
      services.snapshot = [&](std::int64_t index, study::Measured &measured) {
        errors = measure(*bar, measured, index == time_.snapshots ? "" : fmt::format("_snapshot_{}", index));
        if (!directory.empty())
          write_curve(*bar, directory, index, cell);
      };
    const auto outcome = study::run_in_time(*bar, time_, services);
    cell.n_dofs = bar->n_dofs();
    cell.nonzeros = bar->nonzeros();
    cell.steps = bar->steps();
    keep_seconds({{"basis", preparation}, {"solve", outcome.seconds}}, cell);
    if (!with_errors)
      return;
    cell.errors = errors;
    cell.quantities = outcome.measured;
    if (bar->n_pivoted() > 0)
      cell.quantities["n_pivoted"] = static_cast<double>(bar->n_pivoted());
    cell.quantities["time_step"] = outcome.largest_step;
    cell.quantities["cfl"] = outcome.largest_step / bar->step_unit();
    cell.quantities["cfl_limit"] = bar->stable_step() / bar->step_unit();
    cell.quantities["work"] = bar->work();
    cell.quantities["work_exact"] = pulse_.work();
  }

  /// Errors at the present time, and into `measured` the quantities with `suffix`.
  std::map<std::string, double> measure(const BarEvolution &bar, study::Measured &measured,
                                        const std::string &suffix) const {
    const auto places = bar.places();
    const auto stress = bar.stress();
    const double t = bar.time();
    double sum = 0;
    double largest = -INFINITY;
    double least = INFINITY;
    for (std::size_t i = 0; i < places.size(); ++i) {
      sum += std::abs(stress[i] - pulse_.stress_at(places[i], t));
      largest = std::max(largest, stress[i]);
      least = std::min(least, stress[i]);
    }
    const double l1 = sum / static_cast<double>(places.size()) / pulse_.stress;
    const auto put = [&](const std::string &name, double value) { measured[name + suffix] = value; };
    put("time", t);
    put("overshoot", std::max(largest, -least) / pulse_.stress - 1);
    put("tension", largest / pulse_.stress);
    put("pressure", -least / pulse_.stress);
    put("energy_over_work", bar.energy() / bar.work());
    if (const double speed = front_speed(places, stress, t); speed > 0)
      put("front_speed", speed);
    if (!suffix.empty() && !effects_.damping)
      put("stress_l1", l1);
    // Damping has no exact solution here.
    return effects_.damping ? std::map<std::string, double>{} : std::map<std::string, double>{{"stress_l1", l1}};
  }

  /// Speed of the front by where half of the stress first stands, seen from the free end; 0 once the front has passed
  /// it.
  double front_speed(const std::vector<double> &places, const std::vector<double> &stress, double t) const {
    if (t * pulse_.wave_speed > 0.95 * pulse_.length)
      return 0;
    for (std::size_t i = 1; i < places.size(); ++i)
      if (stress[i] <= -0.5 * pulse_.stress) {
        const double part = (-0.5 * pulse_.stress - stress[i - 1]) / (stress[i] - stress[i - 1]);
        return (pulse_.length - places[i - 1] - part * (places[i] - places[i - 1])) / t;
      }
    return 0;
  }

  void write_curve(const BarEvolution &bar, const std::filesystem::path &directory, std::int64_t index,
                   reports::Cell &cell) const {
    const auto places = bar.places();
    std::vector<double> exact;
    for (const double x : places)
      exact.push_back(pulse_.stress_at(x, bar.time()));
    rod::write_series(directory, fmt::format("stress-{}", index), {"x", "stress", "exact_stress"},
                      {places, bar.stress(), exact}, cell, bar.time());
  }

  void run_stretched(const scene::MethodRequest &request, int n, study::TimeServices &services,
                     reports::Cell &cell) const {
    if (request.name == "fem")
      throw methods::Refused("the stretched bar is a test of particles; finite elements have no kernels to move");
    const auto n_pivoted = std::make_shared<std::size_t>(0);
    meshless::dynamics::StretchedBarOptions options{.kernel = kernel_of(request.parameters)};
    options.n_particles = static_cast<std::size_t>(n);
    options.spacing = pulse_.length / (n - 1);
    options.youngs_modulus = scene_.material.real("E");
    options.density = scene_.material.real("density");
    options.stretch = problem_.real("stretch");
    options.seed = static_cast<std::uint64_t>(scene_.study.integer("seed"));
    options.smoothing_length = request.parameters.real("smoothing_length") * options.spacing;
    options.kernel_positions = request.parameters.text("positions") == "current"
                                   ? meshless::dynamics::KernelPositions::current
                                   : meshless::dynamics::KernelPositions::reference;
    if (request.name == "ssph")
      options.operators = ssph_rows(request.parameters, options.spacing, n_pivoted);
    StretchedEvolution evolution(options);
    const auto outcome = study::run_in_time(evolution, time_, services);
    cell.n_dofs = n;
    cell.steps = evolution.steps();
    keep_seconds({{"solve", outcome.seconds}}, cell);
    if (*n_pivoted > 0)
      cell.quantities["n_pivoted"] = static_cast<double>(*n_pivoted);
    cell.quantities["growth"] = evolution.largest_growth();
    cell.quantities["time_step"] = outcome.largest_step;
  }

  const scene::Scene &scene_;
  const scene::ProblemVariant &variant_;
  const scene::Parameters problem_;
  study::TimeSettings time_;
  BarEffects effects_;
  PulseSolution pulse_;
};

std::vector<scene::Declaration> particle_keys(const char *kernel, bool with_order) {
  const scene::Range positive{.lower = 0, .lower_open = true};
  std::vector<std::string> kernels;
  for (const auto &description : meshless::kernels::kernel_table())
    kernels.emplace_back(description.name);
  std::vector<scene::Declaration> keys;
  if (with_order)
    keys.push_back({.name = "order",
                    .type = Type::integer,
                    .range = {.lower = 2, .upper = 4},
                    .default_value = std::int64_t{2},
                    .meaning = "degree of the monomials"});
  keys.insert(
      keys.end(),
      {{.name = "kernel", .type = Type::choice, .choices = kernels, .default_value = kernel, .meaning = "kernel W"},
       {.name = "kernel_parameter", .range = positive, .meaning = "the kernel's own parameter, such as the decay a"},
       {.name = "smoothing_length",
        .range = {.lower = 0.1, .upper = 20},
        .default_value = 1.2,
        .meaning = "h over the spacing"},
       {.name = "support",
        .range = {.lower = 1, .upper = 20, .lower_open = true},
        .meaning = "cut-off of a kernel that leaves it free, in units of h; if absent the paper's"},
       {.name = "positions",
        .type = Type::choice,
        .choices = {"reference", "current"},
        .default_value = "reference",
        .meaning = "where kernels are evaluated: at the places of t = 0, once, or where the particles are"}});
  return keys;
}

void check_kernel(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  try {
    kernel_of(context.method);
  } catch (const std::invalid_argument &error) {
    const char *key = context.method.is_given("support") ? "support" : "kernel_parameter";
    diagnostics.error(context.method.location(key), context.method_key + "." + key, error.what());
  }
}

void check_scene(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const int n = count_of(context.level, context.problem.real("length"));
  if (n < least_particles || n > most_particles)
    diagnostics.error({}, "study.levels",
                      fmt::format("the level {} has {} particles; from {} to {} are allowed", context.level.text, n,
                                  least_particles, most_particles));
  if (context.effect_parameters != nullptr)
    if (const auto viscosity = context.effect_parameters->find("artificial_viscosity");
        viscosity != context.effect_parameters->end() && viscosity->second.real("quadratic") > 0)
      diagnostics.error(viscosity->second.location("quadratic"), "effects.artificial_viscosity.quadratic",
                        "the viscosity of an elastic bar is linear", "remove the key");
  for (const auto *needed : {"elasticity", "inertia"})
    if (std::find(context.effects.begin(), context.effects.end(), needed) == context.effects.end())
      diagnostics.error({}, "effects", fmt::format("a wave needs the effect '{}'", needed),
                        fmt::format("add {} = true", needed));
}

scene::BenchmarkDescription description() {
  const scene::Range positive{.lower = 0, .lower_open = true};
  scene::BenchmarkDescription benchmark;
  benchmark.name = "bar_wave";
  benchmark.meaning = "stress wave in an elastic bar, Zhang & Batra 2008, section 6.4";
  benchmark.problem = {
      {.name = "case",
       .type = Type::choice,
       .choices = {"pulse", "stretched"},
       .default_value = "pulse",
       .meaning = "a pressure pulse on a free bar, or a stretched and held bar with a disturbance (Swegle's test)"},
      {.name = "length",
       .dimension = scene::dimensions::length,
       .range = positive,
       .default_value = 0.1,
       .meaning = "length, m"},
      {.name = "stress",
       .dimension = scene::dimensions::pressure,
       .range = positive,
       .default_value = 1e9,
       .meaning = "pressure at x = length, Pa"},
      {.name = "duration",
       .dimension = scene::dimensions::time,
       .range = positive,
       .default_value = 3e-6,
       .meaning = "how long it acts, s"},
      {.name = "stretch",
       .range = {.lower = -0.5, .upper = 1},
       .default_value = 0.01,
       .meaning = "strain of the stretched bar at t = 0"}};
  benchmark.material = {{.name = "E",
                         .dimension = scene::dimensions::pressure,
                         .range = positive,
                         .default_value = 200e9,
                         .meaning = "Young's modulus"},
                        {.name = "density",
                         .dimension = scene::dimensions::density,
                         .range = positive,
                         .default_value = 7865.0,
                         .meaning = "density, kg/m^3"}};
  benchmark.effects = {"elasticity", "inertia"};
  benchmark.check = check_scene;
  const std::vector<std::string> effects{"elasticity", "inertia", "artificial_viscosity", "damping"};
  benchmark.methods = {{.name = "ssph",
                        .meaning = "collocation with SSPH rows, central differences in time",
                        .parameters = particle_keys("revised_super_gauss", true),
                        .effects = effects,
                        .check = check_kernel},
                       {.name = "sph",
                        .meaning = "SPH with symmetric forces, for the stretched bar",
                        .parameters = particle_keys("cubic_spline", false),
                        .effects = {"elasticity", "inertia"},
                        .check = check_kernel},
                       {.name = "fem",
                        .meaning = "linear finite elements with lumped mass, central differences in time",
                        .parameters = {},
                        .effects = effects,
                        .check = {}}};
  benchmark.counts_per_level = 1;
  benchmark.time = scene::time_declarations(
      {.end = 10e-6, .cfl = 0.8, .snapshots = 1, .cfl_meaning = "D / c, spacing over wave speed"});
  benchmark.analyses = {"transient"};
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &scene, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<BarWave>(scene, variant);
          },
          rod::add_slopes};
}

} // namespace comparisons::benchmarks::bar_wave
