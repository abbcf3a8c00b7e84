#include "comparisons/hard_cases/plane_case.h"

#include "comparisons/geometry/mesh_operations.h"
#include "comparisons/metrics/error_indicator.h"
#include "comparisons/problems/rectangle_grid.h"

#include "meshless/cloud/particles.h"

#include <algorithm>
#include <cmath>

namespace comparisons::hard_cases {

double lambda_of(const Material &m) {
  const double nu = m.poisson_ratio;
  return m.youngs_modulus * nu / (m.plane_strain ? (1 + nu) * (1 - 2 * nu) : 1 - nu * nu);
}

double mu_of(const Material &m) { return m.youngs_modulus / (2 * (1 + m.poisson_ratio)); }

Stress2 stress_of(const Material &material, const std::array<double, 4> &g) {
  const double pressure = lambda_of(material) * (g[0] + g[3]);
  const double mu = mu_of(material);
  return {pressure + 2 * mu * g[0], pressure + 2 * mu * g[3], mu * (g[1] + g[2])};
}

problems::PlaneStatement statement_of(std::vector<problems::Region> regions, const Field &field,
                                      const std::vector<int> &fixed) {
  problems::PlaneStatement statement;
  for (const auto &region : regions)
    for (const auto &piece : region.boundary) {
      if (piece.id == problems::interface_id)
        continue;
      problems::BoundaryCondition condition;
      const bool held = std::find(fixed.begin(), fixed.end(), piece.id) != fixed.end();
      condition.displacement_prescribed = {held, held};
      condition.displacement = [field](std::span<const Point2> x, std::span<Vector2> u) {
        std::transform(x.begin(), x.end(), u.begin(), field.displacement);
      };
      condition.traction = [field, material = region.material](std::span<const Point2> x, std::span<const Vector2> n,
                                                               std::span<Vector2> t) {
        for (std::size_t i = 0; i < x.size(); ++i) {
          const auto s = stress_of(material, field.gradient(x[i]));
          t[i] = {s[0] * n[i][0] + s[2] * n[i][1], s[2] * n[i][0] + s[1] * n[i][1]};
        }
      };
      statement.conditions[piece.id] = condition;
    }
  if (field.second)
    statement.body_force = [field, material = regions.front().material](std::span<const Point2> x,
                                                                        std::span<Vector2> b) {
      const double lambda = lambda_of(material), mu = mu_of(material);
      for (std::size_t i = 0; i < x.size(); ++i) {
        const auto d = field.second(x[i]);
        b[i] = {-(lambda + mu) * (d[0] + d[4]) - mu * (d[0] + d[2]),
                -(lambda + mu) * (d[1] + d[5]) - mu * (d[3] + d[5])};
      }
    };
  statement.regions = std::move(regions);
  return statement;
}

PlaneSetup rectangle(const Point2 &low, const Point2 &high, std::array<int, 2> n, double jitter, std::uint64_t seed,
                     const Material &material, const Field &field) {
  const problems::RectangleGrid grid(low, high, n, jitter, seed);
  PlaneSetup setup;
  setup.statement = statement_of({{"", material, problems::rectangle_boundary(low, high)}}, field, {0});
  setup.statement.characteristic_length = high[0] - low[0];
  setup.statement.corners = problems::rectangle_corners(low, high);
  setup.cloud = grid.cloud();
  if (jitter > 0) {
    setup.cloud.spacing = meshless::cloud::smoothing_lengths_by_mean<2>(setup.cloud.positions, 4, 1);
    setup.cloud.regular = false;
  }
  setup.mesh = grid.mesh();
  return setup;
}

double displacement_error(const methods::Solution &solution, const std::vector<Point2> &points, const Field &field) {
  std::vector<double> u(2 * points.size());
  solution.evaluate("displacement", points, u);
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto exact = field.displacement(points[i]);
    for (std::size_t k = 0; k < 2; ++k) {
      error += (u[2 * i + k] - exact[k]) * (u[2 * i + k] - exact[k]);
      norm += exact[k] * exact[k];
    }
  }
  return std::sqrt(error / norm);
}

/// What the solution lets one see of its error without the exact one: into the measurement.
void check(const methods::Solution &solution, const PlaneSetup &setup, Measurement &measurement) {
  std::vector<Point2> off_centre; // where the stress of elements is not better than elsewhere
  for (const auto &cell : setup.mesh.cells) {
    Point2 centre{};
    for (unsigned v = 0; v < cell.n_vertices; ++v)
      for (std::size_t k = 0; k < 2; ++k)
        centre[k] += setup.mesh.vertices[cell.vertices[v]][k] / cell.n_vertices;
    for (unsigned v = 0; v < cell.n_vertices; ++v) {
      const auto &a = setup.mesh.vertices[cell.vertices[v]];
      off_centre.push_back({.5 * (a[0] + centre[0]), .5 * (a[1] + centre[1])});
    }
  }
  const auto quadrature = geometry::cell_quadrature(setup.mesh, 4);
  const auto equilibrium = metrics::equilibrium(solution, setup.statement, quadrature);
  measurement.indicators = metrics::error_indicators(solution, setup.statement, equilibrium, off_centre);
  if (setup.statement.body_force && setup.mesh.cells.empty())
    measurement.indicators.erase("force_imbalance"); // there is nothing to integrate it with
  for (auto &doubt : metrics::doubts(measurement.indicators))
    measurement.warnings.push_back(std::move(doubt));
}

Measurement measure(const std::string &method, const PlaneSetup &setup, const Field &field,
                    const std::map<std::string, scene::Value> &keys, const std::vector<Point2> &points) {
  const auto solution = solve(method, setup.statement, setup.cloud, setup.mesh, keys);
  const auto &at = !points.empty() ? points : setup.mesh.vertices.empty() ? setup.cloud.positions : setup.mesh.vertices;
  Measurement result{displacement_error(*solution, at, field), {}, solution->record().warnings};
  check(*solution, setup, result);
  return result;
}

Measurement measure_at(const std::string &method, const PlaneSetup &setup, const char *quantity, std::size_t component,
                       const Point2 &point, double reference, const std::map<std::string, scene::Value> &keys) {
  const auto solution = solve(method, setup.statement, setup.cloud, setup.mesh, keys);
  std::vector<double> values(solution->n_components(quantity));
  solution->evaluate(quantity, {&point, 1}, values);
  Measurement result{std::abs(values[component] / reference - 1), values[component], solution->record().warnings};
  check(*solution, setup, result);
  return result;
}

Field cantilever_field(double length, double height, const Material &material) {
  const double nu = material.poisson_ratio;
  const double E = material.plane_strain ? material.youngs_modulus / (1 - nu * nu) : material.youngs_modulus;
  const double nu0 = material.plane_strain ? nu / (1 - nu) : nu;
  const double l = length / height, w = height;
  // Scaled so that the displacement of the tip is about 1.
  const double f = 1 / (4 * l * l * l) * w;
  (void)E;
  return {[=](Point2 p) -> Vector2 {
            const double x = p[0] / w, y = p[1] / w;
            return {-2 * f * (y - .5) * (3 * x * (2 * l - x) + (2 + nu0) * y * (y - 1)),
                    2 * f * (x * x * (3 * l - x) + 3 * nu0 * (l - x) * (y - .5) * (y - .5) + (4 + 5 * nu0) / 4 * x)};
          },
          [=](Point2 p) -> std::array<double, 4> {
            const double x = p[0] / w, y = p[1] / w;
            const double g = 2 * f / w;
            return {-g * (y - .5) * 6 * (l - x), -g * (3 * x * (2 * l - x) + (2 + nu0) * (3 * y * y - 3 * y + .5)),
                    g * (6 * l * x - 3 * x * x - 3 * nu0 * (y - .5) * (y - .5) + (4 + 5 * nu0) / 4),
                    g * 6 * nu0 * (l - x) * (y - .5)};
          }};
}

Field polynomial_field(double s) {
  return {[=](Point2 p) -> Vector2 {
            const auto [x, y] = p;
            return {.1 + .3 * x - .2 * y + s * (.3 * x * x - .4 * x * y + .2 * y * y),
                    -.3 + .4 * x + .5 * y + s * (-.5 * x * x + .6 * x * y + .35 * y * y)};
          },
          [=](Point2 p) -> std::array<double, 4> {
            const auto [x, y] = p;
            return {.3 + s * (.6 * x - .4 * y), -.2 + s * (-.4 * x + .4 * y), .4 + s * (-x + .6 * y),
                    .5 + s * (.6 * x + .7 * y)};
          },
          s == 0 ? std::function<std::array<double, 6>(Point2)>()
                 : [=](Point2) -> std::array<double, 6> { return {.6 * s, -.4 * s, .4 * s, -s, .6 * s, .7 * s}; }};
}

} // namespace comparisons::hard_cases
