#include "comparisons/benchmarks/geometry/benchmark.h"

#include "comparisons/problems/geometry_problem.h"
#include "comparisons/scene/default_parameters.h"
#include "comparisons/scene/geometry_tables.h"
#include "comparisons/study/plane_experiment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comparisons::benchmarks::geometry {

namespace {

/// The fields of a solution of a method; the solution lives as long as they do.
problems::ExactSolution fields_of(std::shared_ptr<const methods::Solution> solution) {
  problems::ExactSolution fields;
  fields.displacement = [solution](std::span<const problems::Point2> points, std::span<problems::Vector2> values) {
    std::vector<double> u(2 * points.size());
    solution->evaluate("displacement", points, u);
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = {u[2 * i], u[2 * i + 1]};
  };
  fields.stress = [solution](std::span<const problems::Point2> points, std::span<problems::Stress2> values) {
    std::vector<double> s(3 * points.size());
    solution->evaluate("stress", points, s);
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = {s[3 * i], s[3 * i + 1], s[3 * i + 2]};
  };
  return fields;
}

problems::ReferenceSolver reference_solver(const std::vector<methods::Method> &methods) {
  return [&methods](const problems::PlaneStatement &statement, const problems::Mesh &mesh, const std::string &element) {
    const auto fem = std::ranges::find(methods, "fem", [](const methods::Method &m) { return m.description.name; });
    if (fem == methods.end())
      throw std::logic_error("there is no method 'fem' to make a reference with");
    const auto parameters = scene::default_parameters(fem->description.parameters, {{"element", element}});
    return fields_of(fem->solve({statement, [] { return problems::Cloud{}; }, [&] { return mesh; }, parameters}));
  };
}

std::unique_ptr<study::Experiment> make_experiment(const scene::Scene &scene, const scene::ProblemVariant &,
                                                   const std::vector<methods::Method> &methods) {
  auto resolved = std::static_pointer_cast<const problems::ResolvedGeometry>(scene.resolved);
  if (resolved == nullptr || scene.geometry == nullptr)
    throw std::logic_error("the scene's geometry was not read");
  return study::make_plane_experiment(
      std::make_unique<problems::GeometryProblem>(std::move(resolved), *scene.geometry,
                                                  static_cast<std::uint64_t>(scene.study.integer("seed")),
                                                  reference_solver(methods)),
      methods, study::extras_of(scene));
}

} // namespace

study::Benchmark benchmark() {
  scene::BenchmarkDescription description;
  description.name = "geometry";
  description.meaning = "the user's own geometry from Gmsh, by [geometry]";
  description.material = scene::region_material_declarations();
  description.effects = {"elasticity"};
  description.counts_per_level = 1;
  description.own_geometry = true;
  description.resolve = [](scene::Scene &scene, scene::Diagnostics &diagnostics) {
    scene.resolved = problems::resolve_geometry(scene, diagnostics);
  };
  return {description, make_experiment};
}

} // namespace comparisons::benchmarks::geometry
