#include "comparisons/benchmarks/detonation/problem.h"

#include "comparisons/benchmarks/detonation/theory.h"
#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/metrics/memory.h"
#include "comparisons/scene/time_keys.h"
#include "comparisons/study/transient.h"

#include "meshless/hydrodynamics/gas_flow.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::benchmarks::detonation {

namespace {

using meshless::hydrodynamics::GasFlow;
using meshless::hydrodynamics::GasOptions;
using meshless::hydrodynamics::GasParticles;
using scene::Type;

/// The published D = 6930 m/s is rounded to four digits.
constexpr double rounding_of_speed = 1e-3;
/// Pressure that tells the front, Pa: about half of the Chapman-Jouguet pressure.
constexpr double front_pressure = 1e10;

int count_of(const scene::Level &level, double length) {
  return level.spacing ? static_cast<int>(std::lround(length / *level.spacing)) : level.counts.front();
}

Explosive explosive_of(const scene::Parameters &material) {
  Explosive explosive;
  explosive.density = material.real("density");
  explosive.energy = material.real("energy") / explosive.density;
  explosive.products = {.A = material.real("A"),
                        .B = material.real("B"),
                        .R1 = material.real("R1"),
                        .R2 = material.real("R2"),
                        .omega = material.real("omega"),
                        .initial_density = explosive.density};
  return explosive;
}

class SlabEvolution final : public study::Evolution {
public:
  SlabEvolution(const GasParticles &particles, const GasOptions &options)
      : gas_(particles, options), energy_(gas_.total_energy()) {}

  double time() const override { return gas_.time(); }
  std::int64_t steps() const override { return gas_.steps(); }
  double stable_step() const override { return gas_.stable_step(); }
  void step(double dt) override { gas_.step(dt); }
  double energy_error() const override { return gas_.total_energy() / energy_ - 1; }
  meshless::dynamics::State state() override { return gas_.state(); }
  void adopt_state() override { gas_.adopt_state(); }
  GasFlow &gas() { return gas_; }

private:
  GasFlow gas_;
  double energy_;
};

class Detonation final : public study::Experiment {
public:
  Detonation(const scene::Scene &scene, const scene::ProblemVariant &variant)
      : scene_(scene), variant_(variant), explosive_(explosive_of(scene.material)),
        length_(variant.parameters.real("length")),
        left_(variant.parameters.text("left_end") == "wall" ? LeftEnd::wall : LeftEnd::free), time_(scene.time),
        theory_(explosive_, left_), speed_(scene.effect_parameters.at("programmed_burn").real("speed")) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &directory, reports::Cell &cell) const override {
    const metrics::PeakMemory memory;
    meshless::linear_algebra::Stopwatch watch;
    const int n = count_of(level, length_);
    SlabEvolution slab(particles(n), options(request.parameters, n));
    const double preparation = watch.lap();
    study::TimeServices services;
    services.progress = progress();
    services.identity = study::identity_of(scene_, variant_, request, level);
    if (!directory.empty())
      services.checkpoint = directory / study::checkpoint_file(cell);
    std::map<std::string, double> errors;
    if (with_errors)
      services.snapshot = [&](std::int64_t index, study::Measured &measured) {
        errors = measure(slab.gas(), measured, index == time_.snapshots ? "" : fmt::format("_snapshot_{}", index));
        if (!directory.empty())
          write_curves(slab.gas(), directory, index, cell);
      };
    const auto outcome = study::run_in_time(slab, time_, services);
    cell.dimension = 1;
    cell.n_points = n;
    cell.n_dofs = 3 * n;
    cell.steps = slab.steps();
    cell.seconds["points"] = {preparation, preparation, preparation};
    cell.seconds["solve"] = {outcome.seconds, outcome.seconds, outcome.seconds};
    const double total = preparation + outcome.seconds;
    cell.seconds["total"] = {total, total, total};
    cell.memory_bytes = memory.bytes();
    if (!with_errors)
      return;
    cell.errors = errors;
    cell.quantities = outcome.measured;
    cell.quantities["energy_error"] = std::abs(slab.energy_error());
    cell.quantities["largest_step"] = outcome.largest_step;
    cell.quantities["time_to_the_end"] = length_ / speed_;
    const auto &front = theory_.front();
    cell.quantities["exact_speed"] = front.speed;
    cell.quantities["exact_pressure"] = front.state.pressure;
    cell.quantities["exact_density"] = front.state.density;
    cell.quantities["exact_velocity"] = front.state.velocity;
    if (left_ == LeftEnd::wall)
      cell.quantities["exact_plateau_pressure"] = theory_.plateau_pressure();
  }

  study::Estimate estimate(const scene::MethodRequest &, const scene::Level &level) const override {
    const double n = count_of(level, length_);
    const double steps = time_.end / (time_.cfl * length_ / n / 5000);
    return {.n_points = n, .n_dofs = 3 * n, .bytes = 1000 * n + 2e5, .seconds = steps * n * 8e-8};
  }

private:
  GasParticles particles(int n) const {
    GasParticles result;
    const double spacing = length_ / n;
    for (int i = 0; i < n; ++i) {
      result.position.push_back((i + 0.5) * spacing);
      result.mass.push_back(explosive_.density * spacing);
      result.velocity.push_back(0);
      result.density.push_back(explosive_.density);
      result.energy.push_back(explosive_.energy);
    }
    return result;
  }

  GasOptions options(const scene::Parameters &method, int n) const {
    using namespace meshless;
    const double spacing = length_ / n;
    GasOptions result{.kernel = kernels::make_kernel(method.text("kernel"), {}),
                      .equation_of_state = explosive_.products};
    result.density = method.text("density") == "summation" ? hydrodynamics::DensityRule::summation
                                                           : hydrodynamics::DensityRule::continuity;
    result.adaptive = method.text("smoothing_rule") == "adaptive";
    result.smoothing = method.real("smoothing_length");
    result.fixed_length = result.smoothing * spacing;
    if (left_ == LeftEnd::wall)
      result.ends = {hydrodynamics::End::mirror, hydrodynamics::End::free};
    const auto &effects = scene_.effect_parameters;
    if (const auto found = effects.find("artificial_viscosity"); found != effects.end())
      result.viscosity = meshless::effects::MonaghanViscosity{.linear = found->second.real("linear"),
                                                              .quadratic = found->second.real("quadratic")};
    if (const auto found = effects.find("heat_conduction"); found != effects.end())
      result.conduction = meshless::effects::HeatConduction{.linear = found->second.real("linear"),
                                                            .quadratic = found->second.real("quadratic")};
    result.burn = meshless::effects::ProgrammedBurn{.speed = speed_,
                                                    .ramp = effects.at("programmed_burn").real("ramp") * spacing};
    return result;
  }

  std::map<std::string, double> measure(GasFlow &gas, study::Measured &measured, const std::string &suffix) const {
    const auto now = gas.snapshot();
    const double t = gas.time();
    double weights = 0;
    double pressure = 0;
    double density = 0;
    double velocity = 0;
    double front = 0;
    double peak = 0;
    for (std::size_t i = 0; i < now.density.size(); ++i) {
      const double x = gas.position()[i];
      peak = std::max(peak, now.pressure[i]);
      if (now.pressure[i] > front_pressure)
        front = x;
      if (x > speed_ * t)
        continue;
      const State exact = theory_.at(x / t);
      const double weight = gas.mass()[i] / now.density[i];
      weights += weight;
      pressure += weight * std::abs(now.pressure[i] - exact.pressure);
      density += weight * std::abs(now.density[i] - exact.density);
      velocity += weight * std::abs(gas.velocity()[i] - exact.velocity);
    }
    const std::map<std::string, double> errors{
        {"pressure_l1", pressure / weights}, {"density_l1", density / weights}, {"velocity_l1", velocity / weights}};
    measured["time" + suffix] = t;
    measured["peak_pressure" + suffix] = peak;
    measured["front" + suffix] = front;
    measured["front_behind" + suffix] = speed_ * t - front;
    if (!suffix.empty())
      for (const auto &[name, value] : errors)
        measured[name + suffix] = value;
    return errors;
  }

  void write_curves(GasFlow &gas, const std::filesystem::path &directory, std::int64_t index,
                    reports::Cell &cell) const {
    auto now = gas.snapshot();
    const auto copy = [](std::span<const double> values) { return std::vector<double>(values.begin(), values.end()); };
    std::vector<std::vector<double>> columns{
        copy(gas.position()), std::move(now.density), std::move(now.pressure), copy(gas.velocity()), {}, {}, {}};
    for (const double x : gas.position()) {
      const State exact = theory_.at(x / gas.time());
      columns[4].push_back(exact.density);
      columns[5].push_back(exact.pressure);
      columns[6].push_back(exact.velocity);
    }
    rod::write_series(directory, fmt::format("profile-{}", index),
                      {"x", "density", "pressure", "velocity", "exact_density", "exact_pressure", "exact_velocity"},
                      columns, cell, gas.time());
  }

  const scene::Scene &scene_;
  const scene::ProblemVariant &variant_;
  Explosive explosive_;
  double length_;
  LeftEnd left_;
  study::TimeSettings time_;
  TaylorWave theory_;
  double speed_;
};

std::vector<scene::Declaration> material_keys() {
  using scene::dimensions::pressure;
  const scene::Range positive{.lower = 0, .lower_open = true};
  return {{.name = "density",
           .dimension = scene::dimensions::density,
           .range = positive,
           .default_value = 1630.0,
           .meaning = "density of the explosive, kg/m^3"},
          {.name = "A", .dimension = pressure, .range = positive, .default_value = 3.712e11, .meaning = "A of JWL, Pa"},
          {.name = "B", .dimension = pressure, .range = positive, .default_value = 3.231e9, .meaning = "B of JWL, Pa"},
          {.name = "R1", .range = positive, .default_value = 4.15, .meaning = "R1 of JWL"},
          {.name = "R2", .range = positive, .default_value = 0.95, .meaning = "R2 of JWL"},
          {.name = "omega", .range = positive, .default_value = 0.30, .meaning = "omega of JWL"},
          {.name = "energy",
           .dimension = pressure,
           .range = positive,
           .default_value = 7e9,
           .meaning = "chemical energy per volume, Pa (J/m^3)"}};
}

void check_scene(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const int n = count_of(context.level, context.problem.real("length"));
  if (n < 50 || n > 10000000)
    diagnostics.error(
        {}, "study.levels",
        fmt::format("the level {} has {} particles; from 50 to 10000000 are allowed", context.level.text, n));
  for (const auto *needed : {"gas_pressure", "inertia", "programmed_burn"})
    if (std::find(context.effects.begin(), context.effects.end(), needed) == context.effects.end())
      diagnostics.error({}, "effects", fmt::format("a detonation needs the effect '{}'", needed),
                        fmt::format("add {} = true", needed));
  ChapmanJouguet front;
  try {
    front = chapman_jouguet(explosive_of(context.material));
  } catch (const std::invalid_argument &error) {
    return diagnostics.error({}, "material", error.what());
  }
  if (context.effect_parameters == nullptr || !context.effect_parameters->contains("programmed_burn"))
    return;
  const auto &burn = context.effect_parameters->at("programmed_burn");
  if (const double speed = burn.real("speed"); speed < front.speed * (1 - rounding_of_speed))
    diagnostics.error(burn.location("speed"), "effects.programmed_burn.speed",
                      fmt::format("{} m/s is below the Chapman-Jouguet speed {:.6g} m/s of this equation of state; no "
                                  "detonation runs slower",
                                  speed, front.speed),
                      fmt::format("write {:.0f} or more", std::ceil(front.speed)));
}

scene::BenchmarkDescription description() {
  const scene::Range positive{.lower = 0, .lower_open = true};
  scene::BenchmarkDescription benchmark;
  benchmark.name = "detonation";
  benchmark.meaning = "plane detonation of TNT, Liu, Liu & Lam 2003, section 4.2";
  benchmark.problem = {{.name = "length",
                        .dimension = scene::dimensions::length,
                        .range = positive,
                        .default_value = 0.1,
                        .meaning = "thickness of the slab, m"},
                       {.name = "left_end",
                        .type = Type::choice,
                        .choices = {"wall", "free"},
                        .default_value = "wall",
                        .meaning = "what stands at x = 0, where the detonation starts"}};
  benchmark.material = material_keys();
  benchmark.effects = {"gas_pressure", "inertia", "artificial_viscosity", "programmed_burn"};
  benchmark.check = check_scene;
  std::vector<std::string> kernels;
  for (const auto &kernel : meshless::kernels::kernel_table())
    kernels.emplace_back(kernel.name);
  benchmark.methods = {
      {.name = "sph",
       .meaning = "smoothed particle hydrodynamics, energy by the work of each pair",
       .parameters = {{.name = "kernel",
                       .type = Type::choice,
                       .choices = kernels,
                       .default_value = "gauss",
                       .meaning = "kernel W"},
                      {.name = "smoothing_rule",
                       .type = Type::choice,
                       .choices = {"fixed", "adaptive"},
                       .default_value = "fixed",
                       .meaning = "one h for all, or h = smoothing_length m / rho"},
                      {.name = "smoothing_length",
                       .range = {.lower = 0.5, .upper = 20},
                       .default_value = 1.2,
                       .meaning = "h over the spacing"},
                      {.name = "density",
                       .type = Type::choice,
                       .choices = {"summation", "continuity"},
                       .default_value = "summation",
                       .meaning = "density by the sum of masses, or by the continuity equation"}},
       .effects = {"gas_pressure", "inertia", "artificial_viscosity", "heat_conduction", "programmed_burn"},
       .check = {}}};
  benchmark.counts_per_level = 1;
  benchmark.time = scene::time_declarations(
      {.end = 14e-6, .cfl = 0.1, .snapshots = 14, .cfl_meaning = "the largest stable one by the signal speed"});
  benchmark.effect_defaults = {{"artificial_viscosity.linear", 1.0}, {"artificial_viscosity.quadratic", 1.0}};
  benchmark.analyses = {"transient"};
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &scene, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<Detonation>(scene, variant);
          },
          {}};
}

} // namespace comparisons::benchmarks::detonation
