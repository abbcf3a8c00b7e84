#include "comparisons/benchmarks/shock_tube/tube.h"

#include "fem_reference/gas/discontinuous_galerkin.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace comparisons::benchmarks::shock_tube {

namespace {

using meshless::hydrodynamics::GasFlow;
using meshless::hydrodynamics::GasOptions;
using meshless::hydrodynamics::GasParticles;

class ParticleGas final : public GasEvolution {
public:
  ParticleGas(const Tube &tube, const GasParticles &particles, const GasOptions &options)
      : walls_(tube.walls), gas_(particles, options), energy_(gas_.total_energy()), momentum_(gas_.total_momentum()),
        mass_(sum_of_masses()) {}

  double time() const override { return gas_.time(); }
  std::int64_t steps() const override { return gas_.steps(); }
  double stable_step() const override { return gas_.stable_step(); }
  void step(double dt) override { gas_.step(dt); }
  double energy_error() const override { return gas_.total_energy() / energy_ - 1; }
  meshless::dynamics::State state() override { return gas_.state(); }
  void adopt_state() override { gas_.adopt_state(); }

  Profile profile() override {
    // Density and pressure of the present positions; the run goes on from what a step left, so that looking at it
    // changes nothing.
    GasFlow::Snapshot snapshot = gas_.snapshot();
    Profile profile;
    const auto copy = [](std::span<const double> values) { return std::vector<double>(values.begin(), values.end()); };
    profile.x = copy(gas_.position());
    profile.velocity = copy(gas_.velocity());
    profile.energy = copy(gas_.energy());
    profile.density = std::move(snapshot.density);
    profile.pressure = std::move(snapshot.pressure);
    for (std::size_t i = 0; i < profile.x.size(); ++i)
      profile.weight.push_back(gas_.mass()[i] / profile.density[i]);
    return profile;
  }
  std::int64_t n_points() const override { return gas_.n_particles(); }
  std::int64_t n_dofs() const override { return 3 * gas_.n_particles(); }
  std::map<std::string, double> balances() const override {
    std::map<std::string, double> result{{"mass_error", std::abs(sum_of_masses() / mass_ - 1)},
                                         {"energy_error", std::abs(energy_error())}};
    if (!walls_)
      result["momentum_error"] = std::abs(gas_.total_momentum() - momentum_) / gas_.momentum_scale();
    return result;
  }

private:
  double sum_of_masses() const {
    double sum = 0;
    for (const double m : gas_.mass())
      sum += m;
    return sum;
  }

  bool walls_;
  GasFlow gas_;
  double energy_, momentum_, mass_;
};

class MeshGas final : public GasEvolution {
public:
  MeshGas(const fem_reference::gas::Tube &tube, int degree, bool walls)
      : gamma_(tube.gamma), walls_(walls), gas_(tube, degree), first_(gas_.totals()) {}

  double time() const override { return gas_.time(); }
  std::int64_t steps() const override { return steps_; }
  double stable_step() const override { return gas_.stable_step(); }
  void step(double dt) override {
    gas_.step(dt);
    ++steps_;
  }
  double energy_error() const override { return gas_.totals()[2] / first_[2] - 1; }
  meshless::dynamics::State state() override {
    counters_[0] = static_cast<double>(steps_);
    meshless::dynamics::State all;
    for (const auto &[name, values] : gas_.state())
      all.push_back({name, values});
    all.push_back({"steps", counters_});
    return all;
  }
  void adopt_state() override {
    gas_.adopt_state();
    steps_ = static_cast<std::int64_t>(counters_[0]);
  }

  Profile profile() override {
    Profile profile;
    profile.x = gas_.centres();
    std::vector<fem_reference::gas::Primitive> states(profile.x.size());
    gas_.evaluate(profile.x, states);
    for (const auto &state : states) {
      profile.weight.push_back(gas_.cell_width());
      profile.density.push_back(state.density);
      profile.pressure.push_back(state.pressure);
      profile.velocity.push_back(state.velocity);
      profile.energy.push_back(state.pressure / ((gamma_ - 1) * state.density));
    }
    return profile;
  }
  std::int64_t n_points() const override { return static_cast<std::int64_t>(gas_.centres().size()); }
  std::int64_t n_dofs() const override { return static_cast<std::int64_t>(gas_.n_unknowns()); }
  std::map<std::string, double> balances() const override {
    if (!walls_)
      return {};
    return {{"mass_error", std::abs(gas_.totals()[0] / first_[0] - 1)}, {"energy_error", std::abs(energy_error())}};
  }

  std::int64_t n_shrunk_slopes() const override { return gas_.n_shrunk_slopes(); }

private:
  double gamma_;
  bool walls_;
  fem_reference::gas::DiscontinuousGalerkin gas_;
  fem_reference::gas::Conserved first_;
  std::int64_t steps_ = 0;
  std::array<double, 1> counters_{};
};

} // namespace

Tube::Tube(const scene::Scene &scene, const scene::ProblemVariant &variant)
    : gamma(scene.material.real("gamma")), seed(static_cast<std::uint64_t>(scene.study.integer("seed"))) {
  const auto &problem = variant.parameters;
  const auto state = [&](const std::string &side) {
    return GasState{problem.real(side + "_density"), problem.real(side + "_velocity"),
                    problem.real(side + "_pressure")};
  };
  left = state("left");
  right = state("right");
  half_length = problem.real("half_length");
  window = problem.real("window");
  walls = problem.text("ends") == "walls";
  perturbation = problem.real("perturbation");
  if (const auto found = scene.effect_parameters.find("artificial_viscosity"); found != scene.effect_parameters.end())
    viscosity = meshless::effects::MonaghanViscosity{.linear = found->second.real("linear"),
                                                     .quadratic = found->second.real("quadratic")};
  if (const auto found = scene.effect_parameters.find("heat_conduction"); found != scene.effect_parameters.end())
    conduction = meshless::effects::HeatConduction{.linear = found->second.real("linear"),
                                                   .quadratic = found->second.real("quadratic")};
}

GasParticles place_particles(const Tube &tube, int n) {
  const double share = tube.left.density / (tube.left.density + tube.right.density);
  const int n_left = std::clamp(static_cast<int>(std::lround(n * share)), 1, n - 1);
  GasParticles particles;
  std::mt19937_64 random(tube.seed);
  const auto fill = [&](int count, double from, const GasState &state) {
    const double spacing = tube.half_length / count;
    for (int i = 0; i < count; ++i) {
      const double unit = static_cast<double>(random() >> 11) * 0x1.0p-52 - 1; // in [-1, 1)
      particles.position.push_back(from + (i + 0.5 + tube.perturbation * unit) * spacing);
      particles.mass.push_back(state.density * spacing);
      particles.velocity.push_back(state.velocity);
      particles.density.push_back(state.density);
      particles.energy.push_back(tube.energy(state));
    }
  };
  fill(n_left, -tube.half_length, tube.left);
  fill(n - n_left, 0, tube.right);
  return particles;
}

GasOptions gas_options(const Tube &tube, const scene::Parameters &method, int n) {
  const auto optional = [&](const char *key) {
    return method.has(key) ? std::optional<double>(method.real(key)) : std::nullopt;
  };
  GasOptions options{.kernel = meshless::kernels::make_kernel(method.text("kernel"), optional("support"),
                                                              optional("kernel_parameter")),
                     .equation_of_state = meshless::hydrodynamics::IdealGas{tube.gamma}};
  options.density = method.text("density") == "summation" ? meshless::hydrodynamics::DensityRule::summation
                                                          : meshless::hydrodynamics::DensityRule::continuity;
  options.predictor = method.text("predictor") == "midpoint" ? meshless::hydrodynamics::Predictor::midpoint
                                                             : meshless::hydrodynamics::Predictor::last_step;
  options.adaptive = method.text("smoothing_rule") == "adaptive";
  options.smoothing = method.real("smoothing_length");
  if (!options.adaptive) {
    // Over the finer of the two spacings.
    const double share = tube.left.density / (tube.left.density + tube.right.density);
    options.fixed_length = options.smoothing * tube.half_length / (n * std::max(share, 1 - share));
  }
  if (tube.walls) {
    options.ends = {meshless::hydrodynamics::End::mirror, meshless::hydrodynamics::End::mirror};
    options.walls = {-tube.half_length, tube.half_length};
  }
  options.viscosity = tube.viscosity;
  options.conduction = tube.conduction;
  return options;
}

std::unique_ptr<GasEvolution> particle_gas(const Tube &tube, const scene::Parameters &method, int n) {
  return std::make_unique<ParticleGas>(tube, place_particles(tube, n), gas_options(tube, method, n));
}

std::unique_ptr<GasEvolution> mesh_gas(const Tube &tube, int degree, int n_cells) {
  using fem_reference::gas::Boundary;
  fem_reference::gas::Tube mesh;
  mesh.left = -tube.half_length;
  mesh.right = tube.half_length;
  mesh.n_cells = static_cast<std::size_t>(n_cells);
  mesh.gamma = tube.gamma;
  if (tube.walls)
    mesh.boundaries = {Boundary::wall, Boundary::wall};
  mesh.initial = [&tube](std::span<const double> x, std::span<fem_reference::gas::Primitive> states) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const GasState &state = tube.at(x[i]);
      states[i] = {state.density, state.velocity, state.pressure};
    }
  };
  return std::make_unique<MeshGas>(mesh, degree, tube.walls);
}

} // namespace comparisons::benchmarks::shock_tube
