#include "comparisons/benchmarks/shock_tube/problem.h"

#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/benchmarks/shock_tube/tube.h"
#include "comparisons/metrics/memory.h"
#include "comparisons/scene/time_keys.h"

#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::benchmarks::shock_tube {

namespace {

using meshless::linear_algebra::Stopwatch;
using scene::Type;

int count_of(const scene::Level &level, double length) {
  return level.spacing ? static_cast<int>(std::lround(length / *level.spacing)) : level.counts.front();
}

/// Place where values cross `wanted`, seen from the right end; nothing if they do not within |x| <= window.
std::optional<double> crossing_from_right(const std::vector<double> &x, const std::vector<double> &values,
                                          double wanted, double from, double to) {
  for (std::size_t i = x.size() - 1; i > 0; --i) {
    if (x[i] > to || x[i - 1] < from)
      continue;
    if ((values[i] - wanted) * (values[i - 1] - wanted) <= 0 && values[i] != values[i - 1])
      return x[i] + (wanted - values[i]) / (values[i - 1] - values[i]) * (x[i - 1] - x[i]);
  }
  return std::nullopt;
}

class ShockTube final : public study::Experiment {
public:
  ShockTube(const scene::Scene &scene, const scene::ProblemVariant &variant)
      : scene_(scene), variant_(variant), tube_(scene, variant), time_(scene.time),
        exact_(tube_.left, tube_.right, tube_.gamma) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &directory, reports::Cell &cell) const override {
    const metrics::PeakMemory memory;
    Stopwatch watch;
    const auto gas = make(request, level);
    const double preparation = watch.lap();
    study::TimeServices services;
    services.progress = progress();
    services.identity = study::identity_of(scene_, variant_, request, level);
    if (!directory.empty())
      services.checkpoint = directory / study::checkpoint_file(cell);
    std::map<std::string, double> errors;
    if (with_errors)
      services.snapshot = [&](std::int64_t index, study::Measured &measured) {
        const Profile profile = gas->profile();
        errors = errors_of(profile, gas->time());
        if (index == time_.snapshots)
          locate_waves(profile, gas->time(), measured);
        if (!directory.empty())
          write_curves(profile, gas->time(), directory, index, cell);
      };
    const auto outcome = study::run_in_time(*gas, time_, services);
    cell.dimension = 1;
    cell.n_points = gas->n_points();
    cell.n_dofs = gas->n_dofs();
    cell.steps = gas->steps();
    cell.seconds["points"] = {preparation, preparation, preparation};
    cell.seconds["solve"] = {outcome.seconds, outcome.seconds, outcome.seconds};
    const double total = preparation + outcome.seconds;
    cell.seconds["total"] = {total, total, total};
    cell.memory_bytes = memory.bytes();
    if (request.name == "fem")
      for (const auto *effect : {"artificial_viscosity", "heat_conduction"})
        if (scene_.effect_parameters.contains(effect))
          cell.warnings.push_back(fmt::format("{}: not added; the numerical flux dissipates by itself", effect));
    if (gas->n_shrunk_slopes() > 0)
      cell.warnings.push_back(fmt::format("the slopes of cells were shrunk {} times, as the state at an end was no gas",
                                          gas->n_shrunk_slopes()));
    if (!with_errors)
      return;
    cell.errors = errors;
    cell.quantities = outcome.measured;
    if (gas->n_shrunk_slopes() > 0)
      cell.quantities["n_shrunk_slopes"] = static_cast<double>(gas->n_shrunk_slopes());
    for (const auto &[name, value] : gas->balances())
      cell.quantities[name] = value;
    cell.quantities["largest_step"] = outcome.largest_step;
    cell.quantities["largest_step_over_stable"] = outcome.largest_ratio;
  }

  study::Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const override {
    const double n = count_of(level, 2 * tube_.half_length);
    const bool fem = request.name == "fem";
    const double c = std::sqrt(tube_.gamma * std::max(tube_.left.pressure, tube_.right.pressure) /
                               std::max({tube_.left.density, tube_.right.density, 1e-300}));
    const double steps = time_.step ? time_.end / *time_.step : time_.end * 3 * c * n / tube_.half_length / time_.cfl;
    const double functions = fem && request.parameters.text("element") == "P1" ? 2 : 1;
    return {.n_points = n,
            .n_dofs = 3 * n * functions,
            .bytes = 1000 * n + 2e5,
            .seconds = steps * n * (fem ? 2e-7 : 1e-7)};
  }

private:
  std::unique_ptr<GasEvolution> make(const scene::MethodRequest &request, const scene::Level &level) const {
    const int n = count_of(level, 2 * tube_.half_length);
    if (request.name == "fem")
      return mesh_gas(tube_, request.parameters.text("element") == "P1" ? 1 : 0, n);
    return particle_gas(tube_, request.parameters, n);
  }

  std::map<std::string, double> errors_of(const Profile &profile, double time) const {
    double density = 0;
    double pressure = 0;
    double velocity = 0;
    double energy = 0;
    double weight = 0;
    for (std::size_t i = 0; i < profile.x.size(); ++i) {
      if (std::abs(profile.x[i]) > tube_.window)
        continue;
      const GasState exact = exact_.at(profile.x[i] / time);
      const double w = profile.weight[i];
      weight += w;
      density += w * std::abs(profile.density[i] - exact.density);
      pressure += w * std::abs(profile.pressure[i] - exact.pressure);
      if (exact.density > 0) { // a vacuum has neither
        velocity += w * std::abs(profile.velocity[i] - exact.velocity);
        energy += w * std::abs(profile.energy[i] - tube_.energy(exact));
      }
    }
    return {{"density_l1", density / weight},
            {"pressure_l1", pressure / weight},
            {"velocity_l1", velocity / weight},
            {"energy_l1", energy / weight}};
  }

  /// Where the waves are, of a rarefaction to the left and a shock to the right: the rarefaction's ends by a twentieth
  /// of its pressure drop, the shock by half of its jump, the contact by the mean of the densities beside it.
  void locate_waves(const Profile &profile, double time, study::Measured &measured) const {
    double largest = 0;
    for (std::size_t i = 0; i < profile.x.size(); ++i)
      if (std::abs(profile.x[i]) <= tube_.window)
        largest = std::max(largest, profile.density[i]);
    measured["largest_density"] = largest;
    if (!exact_.star_pressure() || exact_.left_wave().shock || !exact_.right_wave().shock)
      return;
    const double star = *exact_.star_pressure();
    const double end = tube_.window;
    const auto put = [&](const char *name, std::optional<double> place) {
      if (place)
        measured[name] = *place;
    };
    const double contact = *exact_.star_velocity() * time;
    put("shock_position",
        crossing_from_right(profile.x, profile.pressure, 0.5 * (star + tube_.right.pressure), 0, end));
    const double jump = star - tube_.right.pressure;
    const auto foot = crossing_from_right(profile.x, profile.pressure, tube_.right.pressure + 0.1 * jump, contact, end);
    const auto top = crossing_from_right(profile.x, profile.pressure, tube_.right.pressure + 0.9 * jump, contact, end);
    if (foot && top)
      measured["shock_width"] = *foot - *top;
    const double drop = tube_.left.pressure - star;
    put("rarefaction_head",
        crossing_from_right(profile.x, profile.pressure, tube_.left.pressure - 0.05 * drop, -end, contact));
    put("rarefaction_tail", crossing_from_right(profile.x, profile.pressure, star + 0.05 * drop, -end, contact));
    const double shock = exact_.right_wave().head * time;
    put("contact_position", crossing_from_right(profile.x, profile.density,
                                                0.5 * (exact_.left_wave().density + exact_.right_wave().density),
                                                exact_.left_wave().tail * time, 0.5 * (contact + shock)));
    measured["exact_star_pressure"] = star;
    measured["exact_star_velocity"] = *exact_.star_velocity();
    measured["exact_shock_position"] = shock;
  }

  void write_curves(const Profile &profile, double time, const std::filesystem::path &directory, std::int64_t index,
                    reports::Cell &cell) const {
    std::vector<std::vector<double>> columns{
        profile.x, profile.density, profile.pressure, profile.velocity, profile.energy, {}, {}, {}, {}};
    for (const double x : profile.x) {
      const GasState exact = exact_.at(x / time);
      columns[5].push_back(exact.density);
      columns[6].push_back(exact.pressure);
      columns[7].push_back(exact.velocity);
      columns[8].push_back(exact.density > 0 ? tube_.energy(exact) : 0);
    }
    rod::write_series(directory, fmt::format("profile-{}", index),
                      {"x", "density", "pressure", "velocity", "energy", "exact_density", "exact_pressure",
                       "exact_velocity", "exact_energy"},
                      columns, cell, time);
  }

  const scene::Scene &scene_;
  const scene::ProblemVariant &variant_;
  Tube tube_;
  study::TimeSettings time_;
  RiemannSolution exact_;
};

std::vector<scene::Declaration> problem_keys() {
  const scene::Range positive{.lower = 0, .lower_open = true};
  const auto state = [&](const std::string &side, double density, double pressure) {
    return std::vector<scene::Declaration>{{.name = side + "_density",
                                            .dimension = scene::dimensions::density,
                                            .range = positive,
                                            .default_value = density,
                                            .meaning = "density of the " + side + " state, kg/m^3"},
                                           {.name = side + "_velocity",
                                            .dimension = scene::dimensions::velocity,
                                            .default_value = 0.0,
                                            .meaning = "its velocity, m/s"},
                                           {.name = side + "_pressure",
                                            .dimension = scene::dimensions::pressure,
                                            .range = positive,
                                            .default_value = pressure,
                                            .meaning = "its pressure, Pa"}};
  };
  auto keys = state("left", 1.0, 1.0);
  const auto right = state("right", 0.25, 0.1795);
  keys.insert(keys.end(), right.begin(), right.end());
  keys.push_back({.name = "half_length",
                  .dimension = scene::dimensions::length,
                  .range = positive,
                  .default_value = 0.6,
                  .meaning = "the tube is |x| <= half_length, m"});
  keys.push_back({.name = "window",
                  .dimension = scene::dimensions::length,
                  .range = positive,
                  .default_value = 0.4,
                  .meaning = "errors are of |x| <= window, m: what the ends have not reached"});
  keys.push_back({.name = "ends",
                  .type = Type::choice,
                  .choices = {"open", "walls"},
                  .default_value = "open",
                  .meaning = "nothing beyond the last particles (finite elements: outflow), or walls that reflect"});
  keys.push_back({.name = "perturbation",
                  .range = {.lower = 0, .upper = 0.49},
                  .default_value = 0.0,
                  .meaning = "random displacement of the particles over their spacing"});
  return keys;
}

std::vector<scene::Declaration> particle_keys() {
  const scene::Range positive{.lower = 0, .lower_open = true};
  std::vector<std::string> kernels;
  for (const auto &description : meshless::kernels::kernel_table())
    kernels.emplace_back(description.name);
  return {{.name = "kernel",
           .type = Type::choice,
           .choices = kernels,
           .default_value = "cubic_spline",
           .meaning = "kernel W"},
          {.name = "kernel_parameter", .range = positive, .meaning = "the kernel's own parameter"},
          {.name = "support",
           .range = {.lower = 1, .upper = 20, .lower_open = true},
           .meaning = "cut-off of a kernel that leaves it free, in units of h; if absent the paper's"},
          {.name = "smoothing_rule",
           .type = Type::choice,
           .choices = {"adaptive", "fixed"},
           .default_value = "adaptive",
           .meaning = "h = smoothing_length m / rho as the density changes, or one h for all"},
          {.name = "smoothing_length",
           .range = {.lower = 0.5, .upper = 20},
           .default_value = 1.5,
           .meaning = "h over the spacing m / rho; fixed: over the finer spacing at t = 0"},
          {.name = "density",
           .type = Type::choice,
           .choices = {"summation", "continuity"},
           .default_value = "summation",
           .meaning = "density by the sum of masses, or by the continuity equation"},
          {.name = "predictor",
           .type = Type::choice,
           .choices = {"last_step", "midpoint"},
           .default_value = "last_step",
           .meaning = "rates that lead to the middle of a step: of the step before, or evaluated for it"}};
}

void check_particles(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto optional = [&](const char *key) {
    return context.method.has(key) ? std::optional<double>(context.method.real(key)) : std::nullopt;
  };
  try {
    meshless::kernels::make_kernel(context.method.text("kernel"), optional("support"), optional("kernel_parameter"));
  } catch (const std::invalid_argument &error) {
    const char *key = context.method.is_given("support") ? "support" : "kernel_parameter";
    diagnostics.error(context.method.location(key), context.method_key + "." + key, error.what());
  }
}

void check_scene(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const int n = count_of(context.level, 2 * context.problem.real("half_length"));
  if (n < 10 || n > 10000000)
    diagnostics.error(
        {}, "study.levels",
        fmt::format("the level {} has {} particles; from 10 to 10000000 are allowed", context.level.text, n));
  if (context.problem.real("window") > context.problem.real("half_length"))
    diagnostics.error(context.problem.location("window"), "problem.window", "the window is larger than the tube",
                      "make it at most half_length");
  for (const auto *needed : {"gas_pressure", "inertia"})
    if (std::find(context.effects.begin(), context.effects.end(), needed) == context.effects.end())
      diagnostics.error({}, "effects", fmt::format("a gas needs the effect '{}'", needed),
                        fmt::format("add {} = true", needed));
}

scene::BenchmarkDescription description() {
  scene::BenchmarkDescription benchmark;
  benchmark.name = "shock_tube";
  benchmark.meaning = "Riemann problems of an ideal gas, Liu, Liu & Lam 2003, section 4.1";
  benchmark.problem = problem_keys();
  benchmark.material = {{.name = "gamma",
                         .range = {.lower = 1, .upper = 10, .lower_open = true},
                         .default_value = 1.4,
                         .meaning = "ratio of specific heats"}};
  benchmark.effects = {"gas_pressure", "inertia", "artificial_viscosity"};
  benchmark.check = check_scene;
  const std::vector<std::string> effects{"gas_pressure", "inertia", "artificial_viscosity", "heat_conduction"};
  benchmark.methods = {{.name = "sph",
                        .meaning = "smoothed particle hydrodynamics, energy by the work of each pair",
                        .parameters = particle_keys(),
                        .effects = effects,
                        .check = check_particles},
                       {.name = "fem",
                        .meaning = "discontinuous Galerkin with the flux HLLC, whose dissipation stands for viscosity",
                        .parameters = {{.name = "element",
                                        .type = Type::choice,
                                        .choices = {"P0", "P1"},
                                        .default_value = "P1",
                                        .meaning = "degree in each cell; P1 with limited slopes"}},
                        .effects = effects,
                        .check = {}}};
  benchmark.counts_per_level = 1;
  benchmark.time = scene::time_declarations(
      {.end = 0.15, .cfl = 0.5, .snapshots = 1, .cfl_meaning = "the largest stable one by the signal speed"});
  benchmark.effect_defaults = {{"artificial_viscosity.linear", 1.0}, {"artificial_viscosity.quadratic", 1.0}};
  benchmark.analyses = {"transient"};
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &scene, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<ShockTube>(scene, variant);
          },
          {}};
}

} // namespace comparisons::benchmarks::shock_tube
