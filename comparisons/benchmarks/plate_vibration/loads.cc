#include "comparisons/benchmarks/plate_vibration/loads.h"

#include "comparisons/problems/boundary_quadrature.h"

#include <algorithm>

namespace comparisons::benchmarks::plate_vibration {

namespace {

using problems::Point2;
using problems::Vector2;

constexpr int loaded_side = 1;

bool calls_for(const scene::Scene &scene, const char *effect) {
  return std::ranges::find(scene.effects, effect) != scene.effects.end();
}

/// Slope of the free strain along y: the temperature rises from zero at the lower side.
double strain_slope(const scene::Parameters &problem) {
  return problem.real("expansion") * problem.real("temperature") / problem.real("width");
}

double thermal_modulus(const problems::Material &material) {
  const double nu = material.poisson_ratio;
  return material.youngs_modulus / (material.plane_strain ? 1 - 2 * nu : 1 - nu);
}

} // namespace

std::vector<scene::Declaration> load_keys() {
  return {{.name = "shear",
           .dimension = scene::dimensions::pressure,
           .default_value = 1e6,
           .meaning = "traction along y on the right side from t = 0 on, Pa; in a transient analysis"},
          {.name = "weight",
           .dimension = {.mass = 1, .length = -2, .time = -2},
           .default_value = 77e3,
           .meaning = "force per volume along -y from t = 0 on, N/m^3; with the effect body_force"},
          {.name = "expansion",
           .range = {.lower = -1, .upper = 1},
           .default_value = 1.2e-5,
           .meaning = "coefficient of linear expansion, 1/K; with the effect thermal_expansion"},
          {.name = "temperature",
           .default_value = 100.0,
           .meaning = "temperature of the upper side from t = 0 on, K; linear down to zero at the lower side; with the "
                      "effect thermal_expansion"}};
}

void add_loads(const scene::Scene &scene, const scene::Parameters &problem, problems::PlaneStatement &statement) {
  const double shear = problem.real("shear");
  statement.conditions[loaded_side].traction = [shear](std::span<const Point2>, std::span<const Vector2>,
                                                       std::span<Vector2> values) {
    std::fill(values.begin(), values.end(), Vector2{0, shear});
  };
  if (calls_for(scene, "body_force"))
    statement.body_force = [weight = problem.real("weight")](std::span<const Point2>, std::span<Vector2> values) {
      std::fill(values.begin(), values.end(), Vector2{0, -weight});
    };
  if (calls_for(scene, "thermal_expansion"))
    statement.thermal_strain = [slope = strain_slope(problem)](std::span<const Point2> points,
                                                               std::span<double> values) {
      for (std::size_t i = 0; i < points.size(); ++i)
        values[i] = slope * points[i][1];
    };
}

void add_forces(const scene::Scene &scene, const scene::Parameters &problem, const problems::PlaneStatement &statement,
                const problems::Quadrature &inside, Watch &watch) {
  const auto add = [&](const Point2 &point, const Vector2 &force) {
    watch.force_points.push_back(point);
    watch.forces.push_back(force);
  };
  const auto edges = problems::boundary_quadrature(statement);
  const auto &loaded = edges.at(loaded_side);
  for (std::size_t q = 0; q < loaded.points.size(); ++q)
    add(loaded.points[q], {0, loaded.weights[q] * problem.real("shear")});
  if (calls_for(scene, "body_force"))
    for (std::size_t q = 0; q < inside.points.size(); ++q)
      add(inside.points[q], {0, -inside.weights[q] * problem.real("weight")});
  if (!calls_for(scene, "thermal_expansion"))
    return;
  const double slope = thermal_modulus(statement.regions.front().material) * strain_slope(problem);
  for (const auto &[id, edge] : edges)
    for (std::size_t q = 0; q < edge.points.size(); ++q) {
      const double stress = slope * edge.points[q][1] * edge.weights[q];
      add(edge.points[q], {stress * edge.normals[q][0], stress * edge.normals[q][1]});
    }
  for (std::size_t q = 0; q < inside.points.size(); ++q)
    add(inside.points[q], {0, -inside.weights[q] * slope});
}

std::optional<std::string> effect_with_load(const scene::Scene &scene) {
  for (const auto *effect : {"body_force", "thermal_expansion"})
    if (calls_for(scene, effect))
      return effect;
  return std::nullopt;
}

} // namespace comparisons::benchmarks::plate_vibration
