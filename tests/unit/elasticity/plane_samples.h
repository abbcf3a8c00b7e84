#pragma once

#include "meshless/basis/ssph.h"
#include "meshless/elasticity/strong_form/collocation.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"
#include "meshless/linear_algebra/gauss_legendre.h"
#include "unit/cloud/sample_clouds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Plane problems with known solutions on rectangles, and their errors, for the tests of meshless.
namespace plane_samples {

using namespace meshless;
using namespace meshless::elasticity;

/// u and its gradient (u1,1 u1,2 u2,1 u2,2); the body force if it is not zero.
struct Exact {
  std::function<Vector2(Point2)> displacement;
  std::function<std::array<double, 4>(Point2)> gradient;
  std::function<Vector2(Point2)> body_force;
};

inline Stress2 stress_of(const Material &d, const std::array<double, 4> &g) {
  return {d.axial() * g[0] + d.coupling() * g[3], d.coupling() * g[0] + d.axial() * g[3], d.shear() * (g[1] + g[2])};
}

inline VectorField field(const std::function<Vector2(Point2)> &f) {
  return [f](std::span<const Point2> points, std::span<Vector2> values) {
    std::transform(points.begin(), points.end(), values.begin(), f);
  };
}

inline TractionField traction_of(const Material &material, const Exact &exact) {
  return [=](std::span<const Point2> points, std::span<const Vector2> normals, std::span<Vector2> values) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto s = stress_of(material, exact.gradient(points[i]));
      values[i] = {s[0] * normals[i][0] + s[2] * normals[i][1], s[2] * normals[i][0] + s[1] * normals[i][1]};
    }
  };
}

/// The rectangle with the exact solution as data: `kinds[id]` for left, right, bottom, top.
using Kinds = std::array<std::array<ConditionKind, 2>, 4>;
inline constexpr auto fixed = ConditionKind::displacement;
inline constexpr auto loaded = ConditionKind::traction;
inline constexpr Kinds left_fixed{{{fixed, fixed}, {loaded, loaded}, {loaded, loaded}, {loaded, loaded}}};
inline constexpr Kinds all_fixed{{{fixed, fixed}, {fixed, fixed}, {fixed, fixed}, {fixed, fixed}}};
inline constexpr Kinds left_and_bottom_fixed{{{fixed, fixed}, {loaded, loaded}, {fixed, fixed}, {loaded, loaded}}};
/// Rollers: u1 on the left, u2 at the bottom, both free to slide.
inline constexpr Kinds rollers{{{fixed, loaded}, {loaded, loaded}, {loaded, fixed}, {loaded, loaded}}};

inline PlaneProblem rectangle_problem(const Point2 &low, const Point2 &high, const Material &material,
                                      const Exact &exact, const Kinds &kinds) {
  PlaneProblem problem{{{domain::rectangle(low, high), material}}, {}, {}};
  for (int id = 0; id < 4; ++id)
    problem.conditions[id] = {kinds[static_cast<std::size_t>(id)], field(exact.displacement),
                              traction_of(material, exact)};
  if (exact.body_force)
    problem.body_force = field(exact.body_force);
  return problem;
}

enum class Method { strong, weak1, weak2 };

inline std::string name_of(Method method) {
  return method == Method::strong ? "strong" : method == Method::weak1 ? "weak1" : "weak2";
}

struct Options {
  int order = 2;
  double support = 4;
  int quadrature_points = 10;
  double characteristic_length = 1;
  weak_form::IntegrationRule integration = weak_form::IntegrationRule::paper;
  weak_form::RepeatedRows repeated_rows = weak_form::RepeatedRows::copied;
  std::vector<strong_form::CornerRule> corner_rules{};
};

inline ParticleSolution solve(Method method, const PlaneProblem &problem, const cloud::Particles<2> &particles,
                              const Options &options) {
  auto shared = std::make_shared<const cloud::Particles<2>>(particles);
  std::shared_ptr<const basis::ShapeFunctions<2>> basis =
      basis::make_ssph<2>(options.order, kernels::Gauss(options.support));
  if (method == Method::strong)
    return strong_form::solve(problem, shared, basis, options.corner_rules);
  weak_form::Parameters parameters;
  parameters.derivatives = method == Method::weak1 ? DerivativeRule::direct : DerivativeRule::differentiated;
  parameters.quadrature_points = options.quadrature_points;
  parameters.integration = options.integration;
  parameters.repeated_rows = options.repeated_rows;
  parameters.characteristic_length = options.characteristic_length;
  return weak_form::solve(problem, shared, basis, parameters);
}

struct Errors {
  double displacement = 0; ///< relative L2 norm of the error
  double stress = 0;       ///< the same of all components
  double log10_E = 0;      ///< Batra & Zhang 2008 (4.4): relative difference of the two norms
};

/// n1 x n2 cells of 3 x 3 Gauss points on the rectangle.
inline Errors errors(const ParticleSolution &solution, const Material &material, const Exact &exact, const Point2 &low,
                     const Point2 &high, int n1, int n2) {
  const auto gauss = linear_algebra::gauss_legendre(3);
  std::vector<Point2> points;
  std::vector<double> weights;
  for (int i = 0; i < n1; ++i)
    for (int j = 0; j < n2; ++j)
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
          points.push_back({low[0] + (high[0] - low[0]) * (i + gauss.points[a]) / n1,
                            low[1] + (high[1] - low[1]) * (j + gauss.points[b]) / n2});
          weights.push_back(gauss.weights[a] * gauss.weights[b]);
        }
  std::vector<Vector2> u(points.size());
  std::vector<Stress2> s(points.size());
  solution.displacement(points, u);
  solution.stress(points, s);
  double error_u = 0, norm_u = 0, norm_found = 0, error_s = 0, norm_s = 0;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto exact_u = exact.displacement(points[q]);
    const auto exact_s = stress_of(material, exact.gradient(points[q]));
    for (std::size_t k = 0; k < 2; ++k) {
      error_u += weights[q] * (u[q][k] - exact_u[k]) * (u[q][k] - exact_u[k]);
      norm_u += weights[q] * exact_u[k] * exact_u[k];
      norm_found += weights[q] * u[q][k] * u[q][k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      error_s += weights[q] * (s[q][k] - exact_s[k]) * (s[q][k] - exact_s[k]);
      norm_s += weights[q] * exact_s[k] * exact_s[k];
    }
  }
  return {std::sqrt(error_u / norm_u), std::sqrt(error_s / norm_s),
          std::log10(std::abs(std::sqrt(norm_found / norm_u) - 1))};
}

/// Cantilever plate under a parabolic shear force, Batra & Zhang 2008, section 4.1: (4.2), (4.3).
/// Lengths in units of `metre`, stresses in units of `pascal`, the lower left corner at `origin`.
struct Cantilever {
  double metre = 1;
  double pascal = 1;
  Point2 origin{0, 0};

  double length() const { return 1 * metre; }
  double width() const { return .2 * metre; }
  Point2 high() const { return {origin[0] + length(), origin[1] + width()}; }
  Material material() const { return {226.9e9 * pascal, .33, PlaneModel::plane_stress}; }

  Exact exact() const {
    const double E = material().youngs_modulus();
    const double nu = material().poisson_ratio();
    const double F = 1e6 * pascal * metre; // force per thickness
    const double w = width();
    const double l = length() / width();
    const auto o = origin;
    return {[=](Point2 p) -> Vector2 {
              const double x = (p[0] - o[0]) / w, y = (p[1] - o[1]) / w;
              return {-2 * F / E * (y - .5) * (3 * x * (2 * l - x) + (2 + nu) * y * (y - 1)),
                      2 * F / E *
                          (x * x * (3 * l - x) + 3 * nu * (l - x) * (y - .5) * (y - .5) + (4 + 5 * nu) / 4 * x)};
            },
            [=](Point2 p) -> std::array<double, 4> {
              const double x = (p[0] - o[0]) / w, y = (p[1] - o[1]) / w;
              const double f = 2 * F / E / w;
              return {-f * (y - .5) * 6 * (l - x), -f * (3 * x * (2 * l - x) + (2 + nu) * (3 * y * y - 3 * y + .5)),
                      f * (6 * l * x - 3 * x * x - 3 * nu * (y - .5) * (y - .5) + (4 + 5 * nu) / 4),
                      f * 6 * nu * (l - x) * (y - .5)};
            },
            {}};
  }
  PlaneProblem problem() const { return rectangle_problem(origin, high(), material(), exact(), left_fixed); }
  cloud::Particles<2> particles(int n1, int n2) const {
    auto points = sample_clouds::grid<2>({n1, n2}, origin, high());
    auto h = cloud::smoothing_lengths_by_nearest<2>(points, 1);
    return {std::move(points), std::move(h)};
  }
  std::vector<strong_form::CornerRule> right_corners(strong_form::Quantity a, strong_form::Quantity b) const {
    return {{high(), {a, b}}, {{high()[0], origin[1]}, {a, b}}};
  }
  Errors errors_of(Method method, int n1, int n2, Options options) const {
    options.characteristic_length *= metre;
    const auto solution = solve(method, problem(), particles(n1, n2), options);
    return errors(solution, material(), exact(), origin, high(), 60, 12);
  }
};

} // namespace plane_samples
