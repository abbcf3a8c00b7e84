#pragma once

#include "concave_samples.h"

#include "meshless/cloud_generation/generator.h"
#include "meshless/elasticity/cell_shapes.h"
#include "meshless/elasticity/mixed_form/displacement_pressure.h"

#include <numbers>

/// Nearly incompressible problems with known answers, on jittered clouds.
namespace plane_samples {

inline cloud::Particles<2> particles_of(const domain::Boundary &boundary, std::vector<Point2> points) {
  auto h = cloud_generation::local_spacing(std::vector<domain::Boundary>{boundary}, points);
  return {std::move(points), std::move(h)};
}

/// Moves particles by up to `amount` times their spacing, those of the boundary along it.
inline cloud::Particles<2> jittered(const domain::Boundary &boundary, std::vector<Point2> points, double amount,
                                    std::uint64_t seed) {
  const std::vector<domain::Boundary> boundaries{boundary};
  if (amount > 0)
    cloud_generation::jitter(boundaries, cloud_generation::local_spacing(boundaries, points), {}, amount, seed, points);
  return particles_of(boundary, std::move(points));
}

/// A relaxed cloud of n particles with one spacing, jittered.
inline cloud::Particles<2> even_cloud(const domain::Boundary &boundary, std::size_t n, double amount,
                                      std::uint64_t seed) {
  const auto even = [](std::span<const Point2>, std::span<double> spacing) {
    std::fill(spacing.begin(), spacing.end(), 1.0);
  };
  auto cloud = cloud_generation::generate({{boundary}, even, seed, n, {}});
  return jittered(boundary, std::move(cloud.positions), amount, seed);
}

/// The same particles with supports as long and wide as their cells.
inline cloud::Particles<2> with_elliptic_supports(const domain::Boundary &boundary, const Material &material,
                                                  const std::vector<Point2> &points) {
  auto shapes = cell_shapes(Surroundings({{boundary, material}}), points, {});
  return {points, std::move(shapes.smoothing_lengths), {}, {}, std::move(shapes.flattenings)};
}

/// Quarter of a ring with the radii 1 and 2: ids 0 on x2 = 0, 1 outside, 2 on x1 = 0, 3 inside.
inline domain::Boundary quarter_ring() {
  return domain::Boundary({{{1, 0}, {2, 0}, 0},
                           {{2, 0}, {0, 2}, 1, domain::Arc{{0, 0}, true}},
                           {{0, 2}, {0, 1}, 2},
                           {{0, 1}, {1, 0}, 3, domain::Arc{{0, 0}, false}}});
}

/// n points along the radius, as many along the arc as have the same spacing in the middle.
inline std::vector<Point2> ring_points(int n) {
  const int n_angle = static_cast<int>(std::lround((n - 1) * 1.5 * std::numbers::pi / 2)) + 1;
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n_angle; ++j) {
      const double r = 1 + static_cast<double>(i) / (n - 1);
      const double angle = std::numbers::pi / 2 * j / (n_angle - 1);
      points.push_back({j + 1 == n_angle ? 0 : r * std::cos(angle), j == 0 ? 0 : r * std::sin(angle)});
    }
  return points;
}

/// Lame's thick cylinder under unit pressure inside, in plane strain: u = A r + B / r.
struct ThickCylinder {
  Material material;

  double A() const { return .5 / ((material.axial() + material.coupling()) * 1.5); } // of p a^2 / (b^2 - a^2) = 1/3
  double B() const { return 4. / 3 / (2 * material.shear()); }
  Exact exact() const {
    const double a = A(), b = B();
    return {[=](Point2 p) -> Vector2 {
              const double r2 = p[0] * p[0] + p[1] * p[1];
              return {(a + b / r2) * p[0], (a + b / r2) * p[1]};
            },
            [=](Point2 p) -> std::array<double, 4> {
              const auto [x, y] = p;
              const double r2 = x * x + y * y;
              const double cross = -2 * b * x * y / (r2 * r2);
              return {a + b / r2 - 2 * b * x * x / (r2 * r2), cross, cross, a + b / r2 - 2 * b * y * y / (r2 * r2)};
            },
            {}};
  }
  /// Rollers on the two cuts, the exact tractions on the arcs.
  PlaneProblem problem() const {
    PlaneProblem result{{{quarter_ring(), material}}, {}, {}};
    const Kinds kinds{{{loaded, fixed}, {loaded, loaded}, {fixed, loaded}, {loaded, loaded}}};
    for (int id = 0; id < 4; ++id)
      result.conditions[id] = {kinds[static_cast<std::size_t>(id)], field(exact().displacement),
                               traction_of(material, exact())};
    return result;
  }
};

/// Cook's membrane in plane strain, E = 1, F = 1: a trapezium clamped on the left, sheared on the right.
struct Cook {
  Material material;

  static domain::Boundary boundary() {
    return domain::Boundary(
        {{{0, 0}, {48, 44}, 2}, {{48, 44}, {48, 60}, 1}, {{48, 60}, {0, 44}, 3}, {{0, 44}, {0, 0}, 0}});
  }
  PlaneProblem problem() const {
    PlaneProblem result{{{boundary(), material}}, {}, {}};
    const auto zero = field([](Point2) { return Vector2{0, 0}; });
    for (int id = 0; id < 4; ++id)
      result.conditions[id] = {{loaded, loaded}, zero, nullptr};
    result.conditions[0].kind = {fixed, fixed};
    result.conditions[1].traction = [](std::span<const Point2>, std::span<const Vector2>, std::span<Vector2> t) {
      std::fill(t.begin(), t.end(), Vector2{0, 1. / 16});
    };
    return result;
  }
  /// u2 in the middle of the loaded edge.
  static double tip(const ParticleSolution &solution) {
    const Point2 x{48, 52};
    Vector2 u;
    solution.displacement({&x, 1}, {&u, 1});
    return u[1];
  }
};

struct MixedOptions {
  int order = 2;
  double test_radius = 1;
  double stabilisation = .2;
  weak_form::Subdomains subdomains = weak_form::Subdomains::shrunk;
};

inline ParticleSolution solve_mixed(const PlaneProblem &problem, const cloud::Particles<2> &particles,
                                    const MixedOptions &options) {
  mixed_form::Parameters parameters;
  parameters.test_function = kernels::Gauss(options.test_radius);
  parameters.test_radius = options.test_radius;
  parameters.subdomains = options.subdomains;
  parameters.stabilisation = options.stabilisation;
  return mixed_form::solve(problem, std::make_shared<const cloud::Particles<2>>(particles),
                           basis::make_ssph<2>(options.order, kernels::Gauss(options.order + 2)),
                           basis::make_ssph<2>(options.order - 1, kernels::Gauss(options.order + 1)), parameters);
}

/// Relative errors at the particles, root of the sum of squares: of displacement and of the pressure p = lambda div u.
struct MixedErrors {
  double displacement;
  double pressure;
};

inline MixedErrors errors_at_particles(const ParticleSolution &solution, const Material &material, const Exact &exact) {
  const auto points = solution.particles().positions();
  std::vector<Vector2> u(points.size());
  std::vector<double> p(points.size());
  solution.displacement(points, u);
  solution.pressure(points, p);
  double error_u = 0, norm_u = 0, error_p = 0, norm_p = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto v = exact.displacement(points[i]);
    const auto g = exact.gradient(points[i]);
    const double pressure = material.coupling() * (g[0] + g[3]);
    error_u += std::pow(u[i][0] - v[0], 2) + std::pow(u[i][1] - v[1], 2);
    norm_u += v[0] * v[0] + v[1] * v[1];
    error_p += std::pow(p[i] - pressure, 2);
    norm_p += pressure * pressure;
  }
  return {std::sqrt(error_u / norm_u), std::sqrt(error_p / norm_p)};
}

} // namespace plane_samples
