#include "comparisons/study/plane_experiment.h"

#include "comparisons/methods/lower_order.h"
#include "comparisons/metrics/error_indicator.h"
#include "comparisons/metrics/error_norms.h"
#include "comparisons/metrics/force_balance.h"
#include "comparisons/metrics/memory.h"
#include "comparisons/metrics/requested_quantities.h"
#include "comparisons/reports/files.h"
#include "comparisons/study/fields.h"
#include "comparisons/study/method_comparison.h"

#include "meshless/linear_algebra/stopwatch.h"
#include "meshless/linear_algebra/system_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace comparisons::study {

namespace {

using problems::Stress2;
using problems::Vector2;

std::string series_text(const problems::SampleLine &line, const methods::Solution &solution,
                        const problems::ExactSolution &exact) {
  const std::size_t n = line.points.size();
  std::vector<double> displacement(2 * n);
  std::vector<double> stress(3 * n);
  solution.evaluate("displacement", line.points, displacement);
  solution.evaluate("stress", line.points, stress);
  const auto names = solution.fields();
  std::vector<double> pressure;
  if (std::find(names.begin(), names.end(), "pressure") != names.end()) {
    pressure.resize(n);
    solution.evaluate("pressure", line.points, pressure);
  }
  std::vector<Vector2> exact_displacement(n);
  std::vector<Stress2> exact_stress(n);
  const bool known = exact.displacement && exact.stress && !exact.only_at;
  if (known) {
    exact.displacement(line.points, exact_displacement);
    exact.stress(line.points, exact_stress);
  }
  std::string text = "x1,x2,u1,u2,s11,s22,s12";
  text += known ? ",exact_u1,exact_u2,exact_s11,exact_s22,exact_s12" : "";
  text += pressure.empty() ? "\n" : ",pressure\n";
  for (std::size_t i = 0; i < n; ++i) {
    text += fmt::format("{},{},{},{},{},{},{}", line.points[i][0], line.points[i][1], displacement[2 * i],
                        displacement[2 * i + 1], stress[3 * i], stress[3 * i + 1], stress[3 * i + 2]);
    if (known)
      text += fmt::format(",{},{},{},{},{}", exact_displacement[i][0], exact_displacement[i][1], exact_stress[i][0],
                          exact_stress[i][1], exact_stress[i][2]);
    if (!pressure.empty())
      text += fmt::format(",{}", pressure[i]);
    text += '\n';
  }
  return text;
}

void add_cloud_quality(const methods::CloudReport &cloud, reports::Cell &cell) {
  auto &quantities = cell.quantities;
  quantities["cloud_fewest_neighbours"] = static_cast<double>(cloud.fewest_neighbours);
  quantities["cloud_median_neighbours"] = static_cast<double>(cloud.median_neighbours);
  quantities["cloud_most_neighbours"] = static_cast<double>(cloud.most_neighbours);
  quantities["cloud_smallest_distance"] = cloud.smallest_distance;
  quantities["cloud_pivot_ratio"] = cloud.pivot_ratio;
  quantities["cloud_worst_x"] = cloud.worst_point[0];
  quantities["cloud_worst_y"] = cloud.worst_point[1];
  if (cloud.n_pivoted == 0)
    return;
  quantities["n_pivoted"] = static_cast<double>(cloud.n_pivoted);
  cell.warnings.push_back(fmt::format("{} moment matrices at the particles and around them are not positive definite, "
                                      "as the kernel is negative in places; factorised with complete pivoting",
                                      cloud.n_pivoted));
}

/// The rule for every linear solver: its error is at most a hundredth of the discretisation's.
void check_algebraic_error(reports::Cell &cell) {
  const auto algebraic = cell.quantities.find("algebraic_error");
  const auto whole = cell.errors.find("displacement_l2_relative");
  if (algebraic == cell.quantities.end() || whole == cell.errors.end())
    return;
  constexpr double rounding = 1e-10; // what is left of a solution that the method can represent, as in a patch test
  if (whole->second > rounding && algebraic->second > .01 * whole->second)
    cell.warnings.push_back(fmt::format("the linear system was solved with a relative error of {:.1e}, more than a "
                                        "hundredth of the displacement's",
                                        algebraic->second));
}

/// With the order that was solved, which may be lower than the one asked for.
scene::Parameters solved_parameters(const scene::Parameters &asked, const methods::SolveRecord &record) {
  const auto lowered = record.quantities.find("n_orders_lowered");
  return lowered == record.quantities.end()
             ? asked
             : methods::with_order(asked, asked.integer("order") - static_cast<std::int64_t>(lowered->second));
}

class PlaneExperiment final : public Experiment {
public:
  PlaneExperiment(std::unique_ptr<problems::PlaneProblem> problem, const std::vector<methods::Method> &methods,
                  const PlaneExtras &extras)
      : problem_(std::move(problem)), methods_(methods), extras_(extras) {}

  void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
           const std::filesystem::path &series_directory, reports::Cell &cell) const override {
    const auto solve_request = to_solve(request, level);
    const auto &method = find(request.name);
    const metrics::PeakMemory memory;
    meshless::linear_algebra::Stopwatch watch;
    const auto solution = method.solve(solve_request);
    const double total = watch.lap();
    if (!solution)
      throw std::runtime_error("the method returned no solution");
    cell.memory_bytes = memory.bytes();
    const auto &record = solution->record();
    cell.n_points = record.n_points;
    cell.n_dofs = record.n_dofs;
    cell.nonzeros = record.nonzeros;
    cell.warnings = record.warnings;
    cell.linear_solver = record.linear_solver;
    const auto condition = record.quantities.find("reciprocal_condition");
    if (condition != record.quantities.end() && condition->second < 1e-12)
      cell.warnings.push_back(fmt::format(
          "the linear system is nearly singular: the reciprocal of its condition is {:.1e}", condition->second));
    for (const auto &[phase, seconds] : record.seconds)
      cell.seconds[phase] = {seconds, seconds, seconds};
    cell.seconds["total"] = {total, total, total};
    if (!with_errors)
      return;
    cell.quantities = record.quantities;
    const auto &quadrature = quadrature_of(level);
    watch.lap();
    cell.errors = metrics::error_norms(*solution, *problem_, quadrature);
    check_algebraic_error(cell);
    const auto equilibrium = metrics::equilibrium(*solution, problem_->statement(), quadrature);
    cell.quantities["force_imbalance"] = equilibrium.imbalance;
    if (equilibrium.discrete_imbalance)
      cell.quantities["discrete_force_imbalance"] = *equilibrium.discrete_imbalance;
    const auto indicators = metrics::error_indicators(*solution, problem_->statement(), equilibrium, quadrature.points);
    for (const auto &[name, value] : indicators)
      if (name != "force_imbalance") {
        cell.quantities[name] = value;
        if (const auto effectivity = metrics::effectivity(value, cell.errors))
          cell.quantities[name + "_effectivity"] = *effectivity;
      }
    for (auto &doubt : metrics::doubts(indicators))
      cell.warnings.push_back(std::move(doubt));
    metrics::add_requested_quantities(*solution, *problem_, quadrature, equilibrium, cell.quantities);
    if (const auto cloud = solution->cloud())
      add_cloud_quality(*cloud, cell);
    for (auto &remark : problem_->remarks())
      cell.warnings.push_back(std::move(remark));
    if (extras_.facts) {
      const auto parameters = solved_parameters(request.parameters, record);
      const methods::SolveRequest solved{solve_request.statement, solve_request.cloud, solve_request.mesh, parameters};
      cell.quantities.merge(measured_facts(method, solved, *solution, *problem_, quadrature, cell.warnings));
    }
    const double evaluation = watch.lap();
    cell.seconds["evaluation"] = {evaluation, evaluation, evaluation};
    if (series_directory.empty())
      return;
    for (const auto &line : problem_->sample_lines()) {
      const std::string file = series_file(cell, line.name);
      reports::write_file_atomically(series_directory / file, series_text(line, *solution, problem_->exact()));
      cell.series.push_back({line.name, file});
    }
    if (extras_.fields)
      write_fields(*solution, request, level, series_directory, cell);
  }

  void prepare() const override { problem_->exact(); }

  std::optional<methods::CloudReport> inspect(const scene::MethodRequest &request,
                                              const scene::Level &level) const override {
    const auto &method = find(request.name);
    if (!method.inspect)
      return {};
    return method.inspect(to_solve(request, level));
  }

  /// Constants were measured on one core of a server of 2026, alone on it.
  Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const override {
    Estimate e;
    const auto &p = request.parameters;
    const bool elements = p.has("element");
    e.n_points =
        static_cast<double>(elements ? problem_->mesh(level).vertices.size() : problem_->cloud(level).positions.size());
    if (elements)
      estimate_elements(p.text("element")[1] - '0', p.has("solver") && p.text("solver") == "multigrid", e);
    else if (p.has("order"))
      estimate_particles(p, e);
    return e;
  }

  Estimate estimate(const scene::MethodRequest &request, const scene::Level &level,
                    const methods::CloudReport &cloud) const override {
    auto e = estimate(request, level);
    estimate_system(cloud.nonzeros, iterates(request.parameters), e);
    e.seconds += cloud.seconds;
    return e;
  }

private:
  static void estimate_elements(double degree, bool multigrid, Estimate &e) {
    e.n_dofs = 2 * e.n_points * degree * degree;
    if (multigrid) {
      e.bytes = 2e5 + 240 * e.n_dofs;
      e.seconds = 1e-3 + 1.8e-6 * e.n_dofs;
      return;
    }
    const double nonzeros = e.n_dofs * 2 * (2 * degree + 1) * (degree + 1);
    // 8 bytes for each entry of the factor: 7 log2 N a row, and more in large systems (2.6e6 unknowns take 6 GB).
    const double log = std::log2(e.n_dofs + 2);
    e.bytes = 2e5 + 12 * nonzeros + 60 * e.n_dofs * log * (1 + std::max(0.0, log - 12) / 20);
    e.seconds = 3.6e-6 * e.n_dofs * (1 + std::sqrt(e.n_dofs) / 2000);
  }

  /// Matrix entries from the mean number of neighbours.
  static void estimate_particles(const scene::Parameters &p, Estimate &e) {
    const bool mixed = p.has("stabilisation");
    e.n_dofs = (mixed ? 3 : 2) * e.n_points;
    const double order = static_cast<double>(p.integer("order"));
    const double support = (p.has("support") ? p.real("support") : order + 2) *
                           (p.has("smoothing_length") ? p.real("smoothing_length") : 1);
    const bool weak = mixed || p.has("quadrature_points");
    const double reach = weak ? support + (p.has("test_radius") ? p.real("test_radius") : 1) : support;
    const double neighbours = std::min(e.n_points, std::numbers::pi * reach * reach);
    estimate_system(e.n_dofs * 2 * neighbours, iterates(p), e);
    const bool consistent = mixed || (weak && p.text("quadrature") == "consistent");
    const double quadrature = consistent ? 24
                              : weak     ? 4 * std::pow(static_cast<double>(p.integer("quadrature_points")), 2)
                                         : 10;
    e.seconds += e.n_points * quadrature * neighbours * 8e-9;
  }

  static bool iterates(const scene::Parameters &p) { return p.has("solver") && p.text("solver") != "umfpack"; }

  /// A sparse LU in two dimensions fills like N log N and works like N^1.5. The iteration's work hardly grows faster
  /// than N.
  static void estimate_system(double nonzeros, bool iterative, Estimate &e) {
    if (iterative && e.n_dofs >= meshless::linear_algebra::least_unknowns_to_iterate) {
      e.bytes = 2e5 + 30 * nonzeros;
      e.seconds = 6e-8 * nonzeros * (1 + .25 * std::log10(e.n_dofs / 1000));
      return;
    }
    e.bytes = 2e5 + 16 * nonzeros + 10 * nonzeros * std::log2(e.n_points + 2);
    e.seconds = nonzeros * (1e-7 + 3e-9 * std::sqrt(e.n_dofs));
  }

  methods::SolveRequest to_solve(const scene::MethodRequest &request, const scene::Level &level) const {
    return {problem_->statement(), [this, &level] { return problem_->cloud(level); },
            [this, &level] { return problem_->mesh(level); }, request.parameters};
  }

  void write_fields(const methods::Solution &solution, const scene::MethodRequest &request, const scene::Level &level,
                    const std::filesystem::path &series_directory, reports::Cell &cell) const {
    const auto &p = request.parameters;
    const int degree = p.has("element") ? p.text("element")[1] - '0' : 1;
    const auto grid = solution.own_points().empty() ? grid_of(problem_->mesh(level), degree)
                                                    : grid_of(solution.own_points(), problem_->cloud(level).regions);
    const auto fields = fields_on(grid, solution, *problem_);
    const std::string table = series_file(cell, "field");
    const std::string vtu = table.substr(0, table.rfind('.')) + ".vtu";
    reports::write_file_atomically(series_directory / vtu, reports::vtu_text(grid, fields));
    reports::write_file_atomically(series_directory / table, reports::field_table(grid, fields));
    cell.series.push_back({"vtu", vtu});
    cell.series.push_back({"field", table});
  }

  const methods::Method &find(const std::string &name) const {
    for (const auto &method : methods_)
      if (method.description.name == name)
        return method;
    throw std::invalid_argument(fmt::format("no method '{}'", name));
  }

  const problems::Quadrature &quadrature_of(const scene::Level &level) const {
    const auto found = quadratures_.find(level.text);
    return found != quadratures_.end() ? found->second : (quadratures_[level.text] = problem_->quadrature(level));
  }

  std::unique_ptr<problems::PlaneProblem> problem_;
  const std::vector<methods::Method> &methods_;
  PlaneExtras extras_;
  mutable std::map<std::string, problems::Quadrature> quadratures_;
};

} // namespace

PlaneExtras extras_of(const scene::Scene &scene) {
  return {.fields = std::find(scene.formats.begin(), scene.formats.end(), "vtu") != scene.formats.end(),
          .facts = scene.study.boolean("facts")};
}

std::unique_ptr<Experiment> make_plane_experiment(std::unique_ptr<problems::PlaneProblem> problem,
                                                  const std::vector<methods::Method> &methods,
                                                  const PlaneExtras &extras) {
  return std::make_unique<PlaneExperiment>(std::move(problem), methods, extras);
}

} // namespace comparisons::study
