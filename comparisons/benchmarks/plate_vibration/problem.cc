#include "comparisons/benchmarks/plate_vibration/problem.h"

#include "comparisons/benchmarks/plate_vibration/loads.h"
#include "comparisons/benchmarks/plate_vibration/plates.h"
#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/metrics/memory.h"
#include "comparisons/problems/rectangle_grid.h"
#include "comparisons/scene/time_keys.h"

#include "meshless/dynamics/violation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <tuple>

namespace comparisons::benchmarks::plate_vibration {

namespace {

using problems::Point2;
using problems::Vector2;
using scene::Type;

constexpr std::size_t n_compared = 6;
constexpr std::size_t n_rigid_motions = 3;

/// Imaginary parts below this part of the largest eigenvalue are rounding: eps times the condition of an eigenvalue, up
/// to 1e4 here.
constexpr double imaginary_rounding = 1e-11;

/// Prefixes under which a curve's points are kept in what checkpoints keep.
constexpr std::string_view curve_keys[] = {"~time", "~tip", "~kinetic", "~strain", "~work"};

/// Elastic frequencies (rad/s), lowest first, and the largest |omega^2| of rigid motions.
struct Frequencies {
  std::vector<double> elastic;
  double rigid = 0;
  int n_negative = 0;
};

/// The `n_rigid` squares nearest to zero are those of rigid motions.
Frequencies sorted(const Spectrum &spectrum, std::size_t n_rigid) {
  auto squares = spectrum.squares;
  std::stable_sort(squares.begin(), squares.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  Frequencies result;
  for (std::size_t k = 0; k < squares.size(); ++k)
    if (k < n_rigid)
      result.rigid = std::max(result.rigid, std::abs(squares[k]));
    else if (squares[k].real() > 0)
      result.elastic.push_back(std::sqrt(squares[k].real()));
    else
      ++result.n_negative;
  std::sort(result.elastic.begin(), result.elastic.end());
  return result;
}

/// Mean distance of the upward crossings of a level; 0 if there are fewer than two.
struct Crossings {
  double first = 0;
  double last = 0;
  int n = 0;
  double period() const { return n > 1 ? (last - first) / (n - 1) : 0; }
};

Crossings crossings(const std::vector<double> &time, const std::vector<double> &values, double level, double sign) {
  Crossings found;
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double before = sign * (values[i - 1] - level);
    const double after = sign * (values[i] - level);
    if (!(before < 0 && after >= 0))
      continue;
    found.last = time[i - 1] + (time[i] - time[i - 1]) * before / (before - after);
    if (found.n++ == 0)
      found.first = found.last;
  }
  return found;
}

class PlateVibration final : public study::Experiment {
public:
  PlateVibration(const scene::Scene &scene, const scene::ProblemVariant &variant)
      : scene_(scene), variant_(variant), transient_(scene.study.text("analysis") == "transient"),
        supports_(variant.parameters.text("supports")), jitter_(variant.parameters.real("jitter")),
        seed_(static_cast<std::uint64_t>(scene.study.integer("seed"))), time_(scene.time) {
    upper_ = {variant.parameters.real("length"), variant.parameters.real("width")};
    const problems::Material material{scene.material.real("E"), scene.material.real("nu"),
                                      scene.material.text("model") == "plane strain", scene.material.real("density")};
    const double nu = material.poisson_ratio;
    const double modulus = material.plane_strain ? material.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
                                                 : material.youngs_modulus / (1 - nu * nu);
    wave_speed_ = std::sqrt(modulus / material.density);
    statement_.regions = {{{}, material, problems::rectangle_boundary({0, 0}, upper_)}};
    statement_.corners = problems::rectangle_corners({0, 0}, upper_);
    statement_.characteristic_length = upper_[0];
    problems::BoundaryCondition clamped;
    clamped.displacement_prescribed = {true, true};
    clamped.displacement = [](std::span<const Point2>, std::span<Vector2> values) {
      std::fill(values.begin(), values.end(), Vector2{});
    };
    for (int id = 0; id < 4; ++id)
      statement_.conditions[id] =
          supports_ == "clamped" || (supports_ == "left" && id == 0) ? clamped : problems::BoundaryCondition{};
    if (transient_)
      add_loads(scene, variant.parameters, statement_);
    if (const auto found = scene.effect_parameters.find("damping"); found != scene.effect_parameters.end())
      damping_ = found->second.real("rate");
  }

  /// Frequencies and, for a load, the static deflection, by elements of degree 4.
  void prepare() const override {
    if (!reference_.elastic.empty())
      return;
    const double ratio = upper_[0] / upper_[1];
    const int along = static_cast<int>(std::lround(std::min(20 * std::max(ratio, 1 / ratio), 48.0)));
    const int across = std::max(8, static_cast<int>(std::lround(along / std::max(ratio, 1 / ratio))));
    const problems::RectangleGrid grid(
        {0, 0}, upper_, ratio >= 1 ? std::array{along + 1, across + 1} : std::array{across + 1, along + 1}, 0, 0);
    scene::Parameters fine;
    fine.add({{.name = "element", .meaning = {}}, std::string("Q4"), true, {}});
    fine.add({{.name = "mass", .meaning = {}}, std::string("consistent"), true, {}});
    fine.add({{.name = "solver", .meaning = {}}, std::string("cholesky"), true, {}});
    const methods::SolveRequest request{statement_, [] { return problems::Cloud{}; }, [&] { return grid.mesh(); },
                                        fine};
    reference_ = sorted(spectrum(request, "fem", n_modes(), scale()), n_rigid());
    if (!transient_)
      return;
    for (const auto &method : methods::method_table())
      if (method.description.name == "fem") {
        const auto solution = method.solve(request);
        std::array<double, 2> u{};
        const Point2 at = tip();
        solution->evaluate("displacement", {&at, 1}, u);
        static_deflection_ = u[1];
        static_work_ = static_work(*solution, grid.quadrature());
      }
  }

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &directory, reports::Cell &cell) const override {
    if (const auto effect = effect_with_load(scene_); effect && !transient_)
      throw methods::Refused(fmt::format("{} is a load, which has no part in natural frequencies; remove the effect or "
                                         "set study.analysis = \"transient\"",
                                         *effect));
    prepare();
    const metrics::PeakMemory memory;
    const auto grid = grid_of(level);
    cell.n_points = static_cast<std::int64_t>(grid.points().size());
    const methods::SolveRequest solve_request{statement_, [&] { return grid.cloud(); }, [&] { return grid.mesh(); },
                                              request.parameters};
    if (transient_)
      run_load(request, level, solve_request, grid, with_errors, directory, cell);
    else
      run_modes(request, solve_request, with_errors, directory, cell);
    cell.memory_bytes = memory.bytes();
  }

  study::Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const override {
    const auto grid = grid_of(level);
    study::Estimate e;
    e.n_points = static_cast<double>(grid.points().size());
    const double degree = request.name == "fem" ? request.parameters.text("element").back() - '0' : 1;
    e.n_dofs = 2 * e.n_points * degree * degree;
    e.bytes = 3000 * e.n_dofs;
    e.seconds = request.name == "fem" ? 1e-4 * e.n_dofs : 1e-3 * e.n_dofs;
    if (transient_)
      e.seconds += 1e-6 * e.n_dofs * time_.end / (time_.step.value_or(time_.cfl * unit(grid)));
    return e;
  }

private:
  std::size_t n_rigid() const { return supports_ == "free" ? n_rigid_motions : 0; }
  unsigned n_modes() const { return static_cast<unsigned>(n_compared + n_rigid() + 3); }
  /// About the lowest elastic frequency: of the first bending of a free beam, or of shear between clamps.
  double scale() const {
    const double slenderness = std::min(upper_[0], upper_[1]) / std::max(upper_[0], upper_[1]);
    return wave_speed_ / std::max(upper_[0], upper_[1]) * slenderness;
  }
  Point2 tip() const { return {upper_[0], 0.5 * upper_[1]}; }

  /// Of the loads at rest, twice the strain energy.
  double static_work(const methods::Solution &solution, const problems::Quadrature &inside) const {
    if (!statement_.thermal_strain)
      return 2 * solution.own_strain_energy().value_or(0);
    Watch loads;
    add_forces(scene_, variant_.parameters, statement_, inside, loads);
    std::vector<double> u(2 * loads.force_points.size());
    solution.evaluate("displacement", loads.force_points, u);
    double work = 0;
    for (std::size_t q = 0; q < loads.forces.size(); ++q)
      work += loads.forces[q][0] * u[2 * q] + loads.forces[q][1] * u[2 * q + 1];
    return work;
  }

  problems::RectangleGrid grid_of(const scene::Level &level) const {
    std::array<int, 2> n{};
    for (std::size_t k = 0; k < 2; ++k)
      n[k] =
          level.spacing ? std::max(3, 1 + static_cast<int>(std::lround(upper_[k] / *level.spacing))) : level.counts[k];
    return {{0, 0}, upper_, n, jitter_, seed_};
  }
  double unit(const problems::RectangleGrid &grid) const { return grid.spacing() / wave_speed_; }

  static void keep_seconds(const std::map<std::string, double> &seconds, reports::Cell &cell) {
    double total = 0;
    for (const auto &[phase, value] : seconds) {
      cell.seconds[phase] = {value, value, value};
      total += value;
    }
    cell.seconds["total"] = {total, total, total};
  }

  static void keep_recoveries(const methods::Recoveries &recoveries, reports::Cell &cell) {
    cell.quantities.insert(recoveries.quantities.begin(), recoveries.quantities.end());
    cell.warnings.insert(cell.warnings.end(), recoveries.warnings.begin(), recoveries.warnings.end());
  }

  void fill_spectrum(const Spectrum &found, reports::Cell &cell) const {
    double largest = 0;
    for (const auto &square : found.squares)
      largest = std::max(largest, std::abs(square));
    double imaginary = 0;
    int n_complex = 0;
    for (const auto &square : found.squares) {
      imaginary = std::max(imaginary, std::abs(square.imag()));
      n_complex += std::abs(square.imag()) > imaginary_rounding * largest;
    }
    cell.quantities["imaginary_part"] = imaginary / largest;
    cell.quantities["n_complex"] = n_complex;
    cell.quantities["n_eigenvalues"] = static_cast<double>(found.squares.size());
    cell.quantities["growth_rate"] =
        n_complex > 0 ? growth_rate(found, std::max(1e-6 * scale() * scale(), imaginary_rounding * largest)) : 0;
    if (!found.whole && !found.symmetric)
      cell.warnings.push_back(fmt::format("only the {} lowest of the eigenvalues were looked at; others may be complex",
                                          found.squares.size()));
    if (n_complex > 0)
      cell.warnings.push_back(
          fmt::format("{} of {} eigenvalues are complex: such motions grow, the fastest by {:.3g} 1/s", n_complex,
                      found.squares.size(), cell.quantities["growth_rate"]));
  }

  void run_modes(const scene::MethodRequest &request, const methods::SolveRequest &solve_request, bool with_errors,
                 const std::filesystem::path &directory, reports::Cell &cell) const {
    const auto found = spectrum(solve_request, request.name, n_modes(), scale());
    cell.n_dofs = found.n_dofs;
    cell.nonzeros = found.nonzeros;
    keep_seconds(found.seconds, cell);
    if (!with_errors)
      return;
    keep_recoveries(found.recoveries, cell);
    const auto frequencies = sorted(found, n_rigid());
    std::vector<double> mode, omega, exact;
    double worst = 0;
    for (std::size_t k = 0; k < n_compared; ++k) {
      const double own = frequencies.elastic.at(k);
      const double error = std::abs(own / reference_.elastic[k] - 1);
      cell.quantities[fmt::format("frequency_{}", k + 1)] = own / (2 * std::numbers::pi);
      cell.errors[fmt::format("frequency_{}_relative", k + 1)] = error;
      worst = std::max(worst, error);
      mode.push_back(static_cast<double>(k + 1));
      omega.push_back(own);
      exact.push_back(reference_.elastic[k]);
    }
    cell.errors["frequency_max_relative"] = worst;
    if (n_rigid() > 0)
      cell.quantities["rigid_over_first"] = std::sqrt(frequencies.rigid) / reference_.elastic[0];
    cell.quantities["n_negative"] = frequencies.n_negative;
    fill_spectrum(found, cell);
    if (frequencies.n_negative > 0)
      cell.warnings.push_back(fmt::format("{} eigenvalues have a real part that is not positive: these motions grow",
                                          frequencies.n_negative));
    if (!directory.empty())
      rod::write_series(directory, "frequencies", {"mode", "omega", "reference_omega"}, {mode, omega, exact}, cell);
  }

  void run_load(const scene::MethodRequest &request, const scene::Level &level,
                const methods::SolveRequest &solve_request, const problems::RectangleGrid &grid, bool with_errors,
                const std::filesystem::path &directory, reports::Cell &cell) const {
    Watch watch;
    watch.tip = tip();
    watch.quadrature = grid.quadrature();
    watch.step_unit = unit(grid);
    watch.least_work = static_work_;
    watch.damping = damping_;
    add_forces(scene_, variant_.parameters, statement_, watch.quadrature, watch);
    const auto plate = evolution(solve_request, request.name, watch);
    study::TimeServices services;
    services.progress = progress();
    services.identity = study::identity_of(scene_, variant_, request, level);
    if (!directory.empty())
      services.checkpoint = directory / study::checkpoint_file(cell);
    if (with_errors)
      services.snapshot = [&](std::int64_t index, study::Measured &measured) { keep(*plate, index, measured); };
    const auto outcome = in_time(*plate, services, request, solve_request);
    cell.n_dofs = plate->n_dofs();
    cell.nonzeros = plate->nonzeros();
    cell.steps = plate->steps();
    auto seconds = plate->seconds();
    seconds["solve"] += outcome.seconds;
    keep_seconds(seconds, cell);
    if (!with_errors)
      return;
    keep_recoveries(plate->recoveries(), cell);
    cell.quantities["time_step"] = outcome.largest_step;
    cell.quantities["cfl"] = outcome.largest_step / watch.step_unit;
    if (std::isfinite(plate->stable_step()))
      cell.quantities["cfl_limit"] = plate->stable_step() / watch.step_unit;
    fill_curve(outcome.measured, directory, cell);
    if (request.name != "fem")
      fill_spectrum(spectrum(solve_request, request.name, n_modes() + 10, scale()), cell);
  }

  /// A run that grows says what its spectrum is.
  study::TimeOutcome in_time(PlateEvolution &plate, const study::TimeServices &services,
                             const scene::MethodRequest &request, const methods::SolveRequest &solve_request) const {
    try {
      return study::run_in_time(plate, time_, services);
    } catch (const meshless::dynamics::Violation &violation) {
      reports::Cell spectral;
      fill_spectrum(spectrum(solve_request, request.name, n_modes() + 10, scale()), spectral);
      throw std::runtime_error(fmt::format(
          "{}; of {} eigenvalues looked at {} are complex, the largest imaginary part is {:.2g} of the largest "
          "eigenvalue, and the fastest growth {:.3g} 1/s",
          violation.what(), spectral.quantities["n_eigenvalues"], spectral.quantities["n_complex"],
          spectral.quantities["imaginary_part"], spectral.quantities["growth_rate"]));
    }
  }

  static void keep(const PlateEvolution &plate, std::int64_t index, study::Measured &measured) {
    const double values[] = {plate.time(), plate.tip(), plate.kinetic(), plate.strain(), plate.work()};
    for (std::size_t k = 0; k < std::size(values); ++k)
      measured[fmt::format("{}-{:07}", curve_keys[k], index)] = values[k];
  }

  void fill_curve(const study::Measured &measured, const std::filesystem::path &directory, reports::Cell &cell) const {
    std::vector<std::vector<double>> columns(std::size(curve_keys), std::vector<double>{0});
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (const auto &[name, value] : measured)
        if (name.starts_with(fmt::format("{}-", curve_keys[k])))
          columns[k].push_back(value);
    const auto &[time, deflection, kinetic, strain, work] =
        std::tie(columns[0], columns[1], columns[2], columns[3], columns[4]);
    double largest_work = 0;
    for (const double w : work)
      largest_work = std::max(largest_work, std::abs(w));
    double error = 0;
    for (std::size_t i = 0; i < work.size(); ++i)
      error = std::max(error, std::abs(kinetic[i] + strain[i] - work[i]));
    if (!damping_) {
      cell.errors["energy_relative"] = error / largest_work;
      cell.quantities["energy_drift"] = (kinetic.back() + strain.back() - work.back()) / largest_work;
    }
    cell.quantities["static_deflection"] = static_deflection_;
    cell.quantities["largest_deflection"] = *std::max_element(deflection.begin(), deflection.end());
    cell.quantities["last_deflection"] = deflection.back();
    const auto up = crossings(time, deflection, static_deflection_, static_deflection_ > 0 ? 1 : -1);
    if (up.n > 1 && !damping_) {
      const double expected = 2 * std::numbers::pi / reference_.elastic[0];
      cell.quantities["period"] = up.period();
      cell.errors["period_relative"] = std::abs(up.period() / expected - 1);
      cell.errors["mean_deflection_relative"] = std::abs(mean(time, deflection, up) / static_deflection_ - 1);
    }
    if (!directory.empty())
      rod::write_series(directory, "tip", {"time", "deflection", "kinetic_energy", "strain_energy", "work"}, columns,
                        cell);
  }

  /// Over whole periods, by trapezia between the snapshots.
  static double mean(const std::vector<double> &time, const std::vector<double> &values, const Crossings &up) {
    double sum = 0;
    double span = 0;
    for (std::size_t i = 1; i < time.size(); ++i)
      if (time[i - 1] >= up.first && time[i] <= up.last) {
        sum += 0.5 * (time[i] - time[i - 1]) * (values[i] + values[i - 1]);
        span += time[i] - time[i - 1];
      }
    return sum / span;
  }

  const scene::Scene &scene_;
  const scene::ProblemVariant &variant_;
  bool transient_;
  std::string supports_;
  double jitter_;
  std::uint64_t seed_;
  study::TimeSettings time_;
  Point2 upper_{};
  double wave_speed_ = 0;
  problems::PlaneStatement statement_;
  std::optional<double> damping_;
  mutable Frequencies reference_;
  mutable double static_deflection_ = 0;
  mutable double static_work_ = 0;
};

void check(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const auto &level = context.level;
  double points = 1;
  if (level.spacing)
    points =
        (context.problem.real("length") / *level.spacing + 1) * (context.problem.real("width") / *level.spacing + 1);
  else
    for (const int n : level.counts)
      points *= n;
  constexpr double least_points = 20;
  constexpr double most_points = 1e5;
  if (points < least_points || points > most_points)
    diagnostics.error({}, "study.levels",
                      fmt::format("level {} has {:.3g} points; from {} to {} are allowed", level.text, points,
                                  least_points, most_points));
  if (context.material.text("model") == "plane strain" && context.material.real("nu") >= 0.5)
    diagnostics.error(context.material.location("nu"), "material.nu", "0.5 is incompressible in plane strain",
                      "use nu = 0.49, or model = \"plane stress\"");
  for (const auto *needed : {"elasticity", "inertia"})
    if (std::find(context.effects.begin(), context.effects.end(), needed) == context.effects.end())
      diagnostics.error({}, "effects", fmt::format("a vibration needs the effect '{}'", needed),
                        fmt::format("add {} = true", needed));
}

/// The methods of the static problems with keys for motion.
std::vector<scene::MethodDescription> descriptions() {
  std::vector<scene::MethodDescription> result;
  for (const auto &method : methods::method_table()) {
    if (method.description.name == "mixed")
      continue; // has no equations of motion
    auto description = method.description;
    description.effects = {"elasticity", "inertia", "damping", "body_force", "thermal_expansion"};
    std::erase_if(description.parameters,
                  [](const auto &p) { return p.name == "ordering" || p.name == "preconditioner"; });
    description.parameters.push_back({.name = "integration",
                                      .type = Type::choice,
                                      .choices = {"newmark", "central_difference"},
                                      .default_value = "newmark",
                                      .meaning = "steps in time: mean acceleration, or explicit with lumped mass"});
    if (description.name == "fem") {
      std::erase_if(description.parameters, [](const auto &p) { return p.name == "solver"; });
      std::ranges::find(description.parameters, "element", &scene::Declaration::name)->choices = {"Q1", "Q2", "Q3",
                                                                                                  "Q4"};
      description.parameters.push_back({.name = "mass",
                                        .type = Type::choice,
                                        .choices = {"consistent", "lumped"},
                                        .default_value = "consistent",
                                        .meaning = "mass matrix; central differences need the lumped one"});
      description.check = [](const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
        if (context.method.text("integration") == "central_difference" && context.method.text("mass") != "lumped")
          diagnostics.error(context.method.location("integration"), context.method_key + ".integration",
                            "central differences need a lumped mass", "write mass = \"lumped\"");
      };
    }
    result.push_back(std::move(description));
  }
  return result;
}

std::vector<scene::Declaration> problem_keys() {
  const scene::Range positive{.lower = 0, .lower_open = true};
  std::vector<scene::Declaration> keys{{.name = "supports",
                                        .type = Type::choice,
                                        .choices = {"free", "clamped", "left"},
                                        .default_value = "free",
                                        .meaning = "what is held: nothing, all four sides, the left side"},
                                       {.name = "length",
                                        .dimension = scene::dimensions::length,
                                        .range = positive,
                                        .default_value = 2.0,
                                        .meaning = "length along x, m"},
                                       {.name = "width",
                                        .dimension = scene::dimensions::length,
                                        .range = positive,
                                        .default_value = 1.0,
                                        .meaning = "width along y, m"},
                                       {.name = "jitter",
                                        .range = {.lower = 0, .upper = 0.49},
                                        .default_value = 0.0,
                                        .meaning = "largest random move of a particle or vertex, in spacings"}};
  for (auto &key : load_keys())
    keys.push_back(std::move(key));
  return keys;
}

scene::BenchmarkDescription description() {
  const scene::Range positive{.lower = 0, .lower_open = true};
  scene::BenchmarkDescription benchmark;
  benchmark.name = "plate_vibration";
  benchmark.meaning = "natural frequencies of a plate in its plane, and a step load on it";
  benchmark.problem = problem_keys();
  benchmark.material = {{.name = "E",
                         .dimension = scene::dimensions::pressure,
                         .range = positive,
                         .default_value = 210e9,
                         .meaning = "Young's modulus"},
                        {.name = "nu",
                         .range = {.lower = -1, .upper = 0.5, .lower_open = true},
                         .default_value = 0.3,
                         .meaning = "Poisson's ratio"},
                        {.name = "density",
                         .dimension = scene::dimensions::density,
                         .range = positive,
                         .default_value = 7850.0,
                         .meaning = "density, kg/m^3"},
                        {.name = "model",
                         .type = Type::choice,
                         .choices = {"plane stress", "plane strain"},
                         .default_value = "plane stress",
                         .meaning = "plane model"}};
  benchmark.effects = {"elasticity", "inertia"};
  benchmark.check = check;
  benchmark.methods = descriptions();
  benchmark.counts_per_level = 2;
  benchmark.time = scene::time_declarations(
      {.end = 20e-3, .cfl = 4, .snapshots = 400, .cfl_meaning = "spacing over the speed of pressure waves"});
  benchmark.analyses = {"modes", "transient"};
  return benchmark;
}

} // namespace

study::Benchmark benchmark() {
  return {description(),
          [](const scene::Scene &scene, const scene::ProblemVariant &variant, const std::vector<methods::Method> &) {
            return std::make_unique<PlateVibration>(scene, variant);
          }};
}

} // namespace comparisons::benchmarks::plate_vibration
