#include "comparisons/benchmarks/bar_wave/evolutions.h"

#include "comparisons/methods/method_table.h"

#include "fem_reference/rod/explicit_bar.h"

#include "meshless/basis/derivative_operators.h"
#include "meshless/basis/ssph.h"
#include "meshless/dynamics/violation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::benchmarks::bar_wave {

namespace {

using meshless::dynamics::LineOperators;

/// Growth in units of c / D below which it is the rounding of a double eigenvalue, whose root is of the order 1e-8.
constexpr double rounding_growth = 1e-6;

double energy_balance(double energy, double work) { return work != 0 ? energy / work - 1 : 0; }

class SsphBar final : public BarEvolution {
public:
  SsphBar(const meshless::dynamics::BarOptions &options, PivotCount n_pivoted)
      : places_(options.positions), n_pivoted_(std::move(n_pivoted)), bar_(options) {}

  double time() const override { return bar_.time(); }
  std::int64_t steps() const override { return bar_.steps(); }
  double stable_step() const override { return bar_.stable_step(); }
  double step_unit() const override { return bar_.spacing() / bar_.wave_speed(); }
  void step(double dt) override { bar_.step(dt); }
  double energy_error() const override { return energy_balance(bar_.energy(), bar_.work()); }
  meshless::dynamics::State state() override { return bar_.state(); }
  void adopt_state() override { bar_.adopt_state(); }

  std::vector<double> places() const override { return places_; }
  std::vector<double> stress() const override {
    bar_.check();
    return bar_.stress();
  }
  double energy() const override { return bar_.energy(); }
  double work() const override { return bar_.work(); }
  std::int64_t n_dofs() const override { return bar_.n_particles(); }
  std::int64_t nonzeros() const override { return bar_.nonzeros(); }
  std::size_t n_pivoted() const override { return *n_pivoted_; }

  meshless::dynamics::ElasticBar &bar() { return bar_; }

private:
  std::vector<double> places_;
  PivotCount n_pivoted_;
  meshless::dynamics::ElasticBar bar_;
};

class FemBar final : public BarEvolution {
public:
  explicit FemBar(const fem_reference::rod::WaveBar &bar) : bar_(bar) {}

  double time() const override { return bar_.time(); }
  std::int64_t steps() const override { return bar_.steps(); }
  double stable_step() const override { return bar_.stable_step(); }
  double step_unit() const override { return bar_.spacing() / bar_.wave_speed(); }
  void step(double dt) override { bar_.step(dt); }
  double energy_error() const override { return energy_balance(bar_.energy(), bar_.work()); }
  meshless::dynamics::State state() override {
    meshless::dynamics::State all;
    for (const auto &[name, values] : bar_.state())
      all.push_back({name, values});
    return all;
  }
  void adopt_state() override { bar_.adopt_state(); }

  std::vector<double> places() const override { return bar_.middles(); }
  std::vector<double> stress() const override { return bar_.stress(); }
  double energy() const override { return bar_.energy(); }
  double work() const override { return bar_.work(); }
  std::int64_t n_dofs() const override { return static_cast<std::int64_t>(bar_.displacement().size()); }

private:
  fem_reference::rod::ExplicitBar bar_;
};

double density_of(const PulseSolution &pulse) { return pulse.impedance / pulse.wave_speed; }
double modulus_of(const PulseSolution &pulse) { return pulse.impedance * pulse.wave_speed; }

} // namespace

BarEffects::BarEffects(const scene::Scene &scene) {
  if (const auto found = scene.effect_parameters.find("artificial_viscosity"); found != scene.effect_parameters.end())
    viscosity = found->second.real("linear");
  if (const auto found = scene.effect_parameters.find("damping"); found != scene.effect_parameters.end())
    damping = found->second.real("rate");
}

std::vector<double> bar_places(double length, int n) {
  std::vector<double> places;
  for (int i = 0; i < n; ++i)
    places.push_back(length * i / (n - 1));
  return places;
}

meshless::kernels::Kernel kernel_of(const scene::Parameters &method) {
  const auto optional = [&](const char *key) {
    return method.has(key) ? std::optional<double>(method.real(key)) : std::nullopt;
  };
  return meshless::kernels::make_kernel(method.text("kernel"), optional("support"), optional("kernel_parameter"));
}

std::function<LineOperators(std::span<const double>)> ssph_rows(const scene::Parameters &method, double spacing,
                                                                const PivotCount &n_pivoted) {
  const double h = method.real("smoothing_length") * spacing;
  const std::shared_ptr<const meshless::basis::ShapeFunctions<1>> basis =
      meshless::basis::make_ssph<1>(static_cast<int>(method.integer("order")), kernel_of(method));
  return [=](std::span<const double> places) {
    std::vector<meshless::cloud::Point<1>> points;
    for (const double x : places)
      points.push_back({x});
    const meshless::cloud::Particles<1> particles(points, std::vector<double>(points.size(), h));
    try {
      auto rows = meshless::basis::make_derivative_operators<1>(*basis, particles, {.gradient = true, .hessian = true});
      *n_pivoted = std::max(*n_pivoted, rows.n_indefinite);
      return LineOperators{std::move(rows.gradient.front()), std::move(rows.hessian.front())};
    } catch (const meshless::basis::SingularMomentMatrix &error) {
      throw methods::Refused(error.what());
    }
  };
}

std::unique_ptr<BarEvolution> ssph_bar(const scene::Parameters &method, const PulseSolution &pulse, int n,
                                       const BarEffects &effects) {
  meshless::dynamics::BarOptions options;
  options.positions = bar_places(pulse.length, n);
  options.youngs_modulus = modulus_of(pulse);
  options.density = density_of(pulse);
  const auto n_pivoted = std::make_shared<std::size_t>(0);
  options.operators = ssph_rows(method, pulse.length / (n - 1), n_pivoted);
  options.kernel_positions = method.text("positions") == "current" ? meshless::dynamics::KernelPositions::current
                                                                   : meshless::dynamics::KernelPositions::reference;
  options.right_stress = [pulse](double t) { return pulse.load(t); };
  if (effects.viscosity)
    options.viscosity = meshless::effects::LinearViscosity{*effects.viscosity};
  if (effects.damping)
    options.damping = meshless::effects::Damping{*effects.damping};
  auto evolution = std::make_unique<SsphBar>(options, n_pivoted);
  const auto &bar = evolution->bar();
  if (const double growth = bar.growth_rate(); growth * bar.spacing() / bar.wave_speed() > rounding_growth)
    throw meshless::dynamics::Violation(
        0, -1, 0,
        fmt::format("the operator has complex or positive eigenvalues: waves grow by {:.3g} 1/s ({:.2g} c / D) at any "
                    "time step; choose a smaller smoothing length or another kernel",
                    growth, growth * bar.spacing() / bar.wave_speed()));
  return evolution;
}

std::unique_ptr<BarEvolution> fem_bar(const PulseSolution &pulse, int n, const BarEffects &effects) {
  fem_reference::rod::WaveBar bar;
  bar.vertices = bar_places(pulse.length, n);
  bar.youngs_modulus = modulus_of(pulse);
  bar.density = density_of(pulse);
  bar.right_stress = [pulse](double from, double to) { return pulse.mean_load(from, to); };
  bar.viscosity = effects.viscosity;
  bar.damping = effects.damping;
  return std::make_unique<FemBar>(bar);
}

} // namespace comparisons::benchmarks::bar_wave
